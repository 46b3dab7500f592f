#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/action_groups.hpp"

namespace coordreq {

/// Visits all choices of one candidate group a class in one row; one class, by default the last, changes
/// fastest. Keeps its memory from row to row. One object a thread.
class TupleWalk {
 public:
  /// [class] Its groups to choose from.
  using Candidates = std::vector<std::span<const std::uint32_t>>;

  /// Goes to the first choice. @pre no class is without a candidate.
  /// @pre unchecked: the arguments outlive the walk
  void begin(const ActionGrouping& grouping, const RowPosition& position, const RowGroups& groups,
             const Candidates& candidates) {
    begin(grouping, position, groups, candidates, grouping.size() - 1);
  }
  void begin(const ActionGrouping& grouping, const RowPosition& position, const RowGroups& groups,
             const Candidates& candidates, std::size_t fastest);
  /// Goes to the next choice. @returns false after the last one
  bool next();

  /// Goes to the next choice of all classes but the fastest, with the first candidate of that one. @returns
  /// false after the last one
  bool next_of_others();

  /// Group chosen in class c.
  [[nodiscard]] std::uint32_t chosen(std::size_t c) const { return candidates_[c][position_[c]]; }
  /// Numbers of the slices, one for each of RowEngine::slices(), for PostReader::minimum.
  [[nodiscard]] std::span<const std::uint32_t> slice_ids();
  /// slice_ids() under all candidates of the fastest class, one after the other.
  [[nodiscard]] std::span<const std::uint32_t> all_slice_ids();
  /// Allowed cells of the row; empty if everything is allowed.
  [[nodiscard]] ConstRow allowed() const;

 private:
  void add_up(std::size_t from);
  void choose_fastest(std::size_t position);
  void find_ids(std::uint32_t* ids) const;

  const ActionGrouping* grouping_ = nullptr;
  Candidates candidates_;
  std::size_t sources_ = 0;                        ///< tables of slices, and one more if there is `allow`
  std::vector<std::vector<std::int64_t>> offset_;  ///< [class][position of the candidate * sources_ + source]
  std::vector<std::size_t> order_;                 ///< classes, the fastest last
  std::vector<std::int64_t> sum_;      ///< [classes added up, in order_ * sources_ + source], bases first
  std::vector<std::size_t> position_;  ///< [class]
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint32_t> all_ids_;
};

/// Which groups of each class are candidates.
enum class GroupChoice : std::uint8_t { minimal, maximal, all };
void choose_groups(const RowGroups& groups, GroupChoice choice, TupleWalk::Candidates& candidates);

}  // namespace coordreq
