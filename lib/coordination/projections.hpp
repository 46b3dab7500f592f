#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "bitset/cell_set.hpp"
#include "coordination/controller.hpp"
#include "safety/row_hull.hpp"

namespace coordreq {

/// The projections of C onto the classes of one partition: IND_C(x) is their product (paper, Eq. for mesh
/// networks). Held as one bit row for each group of actions of each class in each row of K, but for rows
/// where C(x) is all actions: deep inside K, that is most of them.
class Projections {
 public:
  Projections(const Controller& controller, const ActionGrouping& grouping, const RowHull& hull,
              ThreadTeam& team);

  [[nodiscard]] const ActionGrouping& grouping() const { return *grouping_; }
  /// {x in the row : group g of class c is in the projection of C(x)}; groups as ActionGrouping::group
  /// numbers them. REQUIRES: K has a cell in `row`, and not is_full(row).
  [[nodiscard]] ConstRow row(std::int64_t row, const RowGroups& groups, std::size_t c, std::uint32_t g) const;
  /// True if every action is in C(x) for all x of K in this row.
  [[nodiscard]] bool is_full(std::int64_t row) const { return rows_[static_cast<std::size_t>(row)].empty(); }

 private:
  template <class Level>
  class Builder;

  const ActionGrouping* grouping_;
  std::size_t words_;
  std::vector<std::vector<Word>> rows_;  ///< by row: groups of class 0, then of class 1, ...
};

}  // namespace coordreq
