#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "bitset/cell_set.hpp"
#include "safety/action_groups.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The controller C of an invariance set, contract "Controller": `maximal` C(x) = {u allowed : empty !=
/// f(x,u) subset of K}, `given` C(x) = {u allowed}; empty outside K. Never stored, computed row by row.
struct Controller {
  const RowEngine* engine = nullptr;
  const RowTarget* invariant = nullptr;
  Synthesis synthesis = Synthesis::maximal;
};

/// {x in the row : u in C(x)} for all u in one choice of groups.
/// REQUIRES: `out` has engine->row_words() words.
void controller_row(const Controller& controller, std::int64_t row, ActionGrouping::Tuples& tuple,
                    MutableRow out, RowEngine::Scratch& scratch);

/// The projections of C onto the classes of one partition: IND_C(x) is their product (paper, Eq. for mesh
/// networks). Held as one bit row for each group of actions of each class in each row of K.
class Projections {
 public:
  Projections(const Controller& controller, const ActionGrouping& grouping, ThreadTeam& team);

  [[nodiscard]] const ActionGrouping& grouping() const { return *grouping_; }
  /// {x in the row : group g of class c is in the projection of C(x)}; groups as ActionGrouping::group
  /// numbers them. REQUIRES: K has a cell in `row`.
  [[nodiscard]] ConstRow row(std::int64_t row, const RowGroups& groups, std::size_t c, std::uint32_t g) const;
  [[nodiscard]] bool has_row(std::int64_t row) const { return !rows_[static_cast<std::size_t>(row)].empty(); }

 private:
  void project(const Controller& controller, std::int64_t row, RowGroups& groups,
               RowEngine::Scratch& scratch);

  const ActionGrouping* grouping_;
  std::size_t words_;
  std::vector<std::vector<Word>> rows_;  ///< by row: groups of class 0, then of class 1, ...; empty outside K
};

}  // namespace coordreq
