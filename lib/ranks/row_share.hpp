#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "ranks/ranks.hpp"

namespace coordreq {

/// Which rows of a grid are whose, and which ones of others a rank holds beside its local ones: its *ghost
/// rows*, which the posts of local rows can meet. Rows keep the numbers that they have in the whole grid.
class RowShare {
 public:
  using Range = ThreadTeam::Range;

  /// @param bounds rank r owns the rows [bounds[r], bounds[r + 1])
  /// @pre unchecked: `ranks` outlives this object.
  RowShare(Ranks& ranks, std::vector<std::int64_t> bounds);

  [[nodiscard]] Ranks& ranks() const { return *ranks_; }
  [[nodiscard]] Range local() const { return run_of(ranks_->rank()); }
  [[nodiscard]] Range run_of(int rank) const {
    return {bounds_[static_cast<std::size_t>(rank)], bounds_[static_cast<std::size_t>(rank) + 1]};
  }
  [[nodiscard]] int owner(std::int64_t row) const {
    return static_cast<int>(std::upper_bound(bounds_.begin() + 1, bounds_.end() - 1, row) - bounds_.begin()) -
           1;
  }

  /// Together: chooses the ghost rows. @param is_reachable [row] not 0 for the rows that posts of local rows
  /// can meet
  void set_ghosts(const std::vector<std::uint8_t>& is_reachable);
  /// The rows of this rank and its ghost rows, ascending.
  [[nodiscard]] const std::vector<Range>& held() const { return held_; }

  /// A rank whose ghost rows are rows of this one, or vice versa.
  struct Peer {
    int rank = 0;
    std::vector<Range> sent;      ///< local rows that it holds too
    std::vector<Range> received;  ///< rows local to it that are held here
  };
  [[nodiscard]] const std::vector<Peer>& peers() const { return peers_; }

 private:
  Ranks* ranks_;
  std::vector<std::int64_t> bounds_;
  std::vector<Range> held_;
  std::vector<Peer> peers_;
};

/// The rows that a rank holds beside its local ones, ascending.
[[nodiscard]] std::vector<RowShare::Range> ghost_rows(const RowShare& share);

/// The rows that a rank owns, or all of them. @param share null: there is one process
[[nodiscard]] inline RowShare::Range local_rows(const RowShare* share, std::int64_t rows) {
  return share == nullptr ? RowShare::Range{0, rows} : share->local();
}

/// The rows that a rank holds, or all of them, ascending.
[[nodiscard]] inline std::vector<RowShare::Range> held_rows(const RowShare* share, std::int64_t rows) {
  return share == nullptr ? std::vector<RowShare::Range>{{0, rows}} : share->held();
}

/// Calls `body(range, worker)` in blocks of at most `grain` rows for the rows that a rank owns. @param share
///   null: for all rows
void for_each_local_row(ThreadTeam& team, const RowShare* share, std::int64_t rows, std::int64_t grain,
                        const ThreadTeam::Body& body);
/// for_each_local_row() for the rows that a rank holds, its ghost rows included. @param grain as many as all
///   rows: one run after the other
void for_each_held_row(ThreadTeam& team, const RowShare* share, std::int64_t rows, std::int64_t grain,
                       const ThreadTeam::Body& body);
/// Calls `body(range, worker)` in blocks of at most `grain` rows for the rows of `runs`.
void for_each_row_of(ThreadTeam& team, const std::vector<RowShare::Range>& runs, std::int64_t grain,
                     const ThreadTeam::Body& body);

/// The sum over all ranks of a number that each of them has found. @param share null: `local` alone
[[nodiscard]] inline std::int64_t sum_of_all(const RowShare* share, std::int64_t local) {
  return share == nullptr ? local : share->ranks().sum(local);
}

}  // namespace coordreq
