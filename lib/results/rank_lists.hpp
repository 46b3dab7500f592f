#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "model/cell_order.hpp"
#include "ranks/ranks.hpp"
#include "ranks/row_share.hpp"
#include "results/element_owners.hpp"

namespace coordreq {

/// Elements of an array that one of several processes is to have, whoever knows them.
struct GatheredSegment {
  int taker = 0;
  std::uint64_t begin = 0;
  std::uint64_t count = 0;
  Bytes bytes = {};
};

/// Together: every process sends what it knows of segments to those who take them, and has the bytes of
/// those that it takes, in their order; the others are removed.
void gather_segments(Ranks& ranks, ThreadTeam& team, const ElementOwners& owners, const ResultArray& array,
                     std::vector<GatheredSegment>& segments);

/// Lists of cells that several processes make together: each sorts an equal run of the spec's cells, after
/// the others have sent in which lists these are.
class RankLists {
 public:
  /// Together. @param array with CellLists. @pre unchecked: the arguments outlive this object.
  RankLists(ThreadTeam& team, const RowShare& share, const CellOrder& order, const ResultArray& array);

  [[nodiscard]] const ElementOwners& owners() const { return *owners_; }
  /// The lists one after the other; elements that are not of this process are 0.
  /// @pre unchecked: this object outlives it.
  [[nodiscard]] ResultArray array() const;

 private:
  /// The first cell that a process sorts.
  [[nodiscard]] std::int64_t first_cell(int rank) const;
  /// [cell of its run] the list of each.
  [[nodiscard]] std::vector<std::uint32_t> gather(ThreadTeam& team, const CellOrder& order,
                                                  const CellLists& lists) const;
  void count(const std::vector<std::uint32_t>& list_of, std::size_t lists);
  template <class Index>
  void sort(const std::vector<std::uint32_t>& list_of);
  void fill(std::uint64_t begin, std::uint64_t count, std::byte* out) const;

  const RowShare& share_;
  ElementType type_;
  std::int64_t cells_;
  std::optional<ListOwners> owners_;
  std::vector<std::uint64_t> local_start_;  ///< [list] in sorted_
  std::vector<std::uint64_t> start_;        ///< [list] of the local run in the whole
  Bytes sorted_;                            ///< of the local run, list by list
};

}  // namespace coordreq
