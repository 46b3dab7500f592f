#pragma once

#include <vector>

#include "engine/action_groups.hpp"
#include "engine/cell_set.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Whether `allow` names inputs of several agents: only then can it forbid joint inputs whose actions it
/// permits to each agent.
[[nodiscard]] bool allow_joins_agents(const ProblemSpec& spec);

/// Whether agents who act independently may do together what `allow` forbids.
[[nodiscard]] bool may_forbid_choices(const ProblemSpec& spec);

/// {x : the product of the sets from which the classes choose at x holds a joint input that `allow` forbids}.
/// Such a joint input counts as blocked (contract, "Layers"): where classes act independently, each may take
/// its action of some permitted joint input, and all together a forbidden one. Joint inputs that a controller
/// file does not list are not forbidden.
///
/// Joint inputs in C(x) are never forbidden, and products of projections only where `allow` joins inputs of
/// several classes: so beside posts only these cells need to be found.
class ForbiddenChoices {
 public:
  /// @param grouping of a partition; outlives this object, as its engine does
  /// @param by_rules classes choose by rules of their own, which may permit what `allow` does not
  ForbiddenChoices(const ActionGrouping& grouping, ThreadTeam& team, bool by_rules = false);

  /// The buffers of one thread.
  struct Workspace {
    RowGroups groups;
    std::vector<std::vector<Word>> masks;  ///< [class] one row for each group that `allow` distinguishes
    std::vector<std::vector<Word>>
        open;  ///< [class] the cells where the choices of the classes up to it are possible
    std::vector<std::uint8_t> joined;
  };

  /// Finds the cells of a row.
  /// @param groups of the partition's grouping
  /// @param masks [class][group * words + word]: the cells in whose projection a group is
  /// @param found a row of bits; all 0 if there are no such cells
  /// @returns whether there are such cells
  bool find(const RowPosition& position, const RowGroups& groups, const std::vector<std::vector<Word>>& masks,
            Workspace& work, std::vector<Word>& found) const;

 private:
  void join_groups(std::size_t c, const ActionGroups& groups, const std::vector<Word>& masks,
                   Workspace& work) const;
  void add(std::size_t c, std::int64_t position, Workspace& work, std::vector<Word>& found) const;

  const PairTable* permitted_ = nullptr;  ///< null: no choice can be forbidden
  std::vector<ActionGrouping> pairs_;  ///< one grouping of the same classes by `permitted_` alone; or empty
};

}  // namespace coordreq
