#pragma once

#include <vector>

#include "engine/action_groups.hpp"
#include "engine/cell_set.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// `allow` names inputs of several agents: only then can it forbid what each of them may do by itself.
[[nodiscard]] bool allow_joins_agents(const ProblemSpec& spec);

/// Agents who act by themselves may do together what `allow` forbids.
[[nodiscard]] bool may_forbid_choices(const ProblemSpec& spec);

/// {x : the product of what the classes choose from at x holds a joint input that `allow` forbids}. Such a
/// joint input counts as blocked (contract, "Layers"): where classes act by themselves, each may take its
/// part of something permitted, and all together what is not. What a controller file does not list is not
/// forbidden.
///
/// Joint inputs of single controllers never are, and products of their projections only where `allow` joins
/// inputs of several classes: so this is all that is to be asked besides posts.
class ForbiddenChoices {
 public:
  /// @param grouping of a partition; outlives this object, as its engine does
  /// @param by_rules classes choose by rules of their own, which may permit what `allow` does not
  ForbiddenChoices(const ActionGrouping& grouping, ThreadTeam& team, bool by_rules = false);

  /// What one thread works with.
  struct Workspace {
    RowGroups groups;
    std::vector<std::vector<Word>> masks;  ///< [class] a row a group of those told apart by `allow`
    std::vector<std::vector<Word>> open;  ///< [class] where what the classes up to it have chosen is possible
    std::vector<std::uint8_t> joined;
  };

  /// Finds the cells of a row in lanes.
  /// @param groups of the partition's grouping
  /// @param masks [class][group * words + word]: the cells in whose projection a group is
  /// @param found a row; all zeros where there are none
  /// @returns whether there are any
  bool find(const RowPlace& place, const RowGroups& groups, const std::vector<std::vector<Word>>& masks,
            Workspace& work, std::vector<Word>& found) const;

 private:
  void join_groups(std::size_t c, const ActionGroups& groups, const std::vector<Word>& masks,
                   Workspace& work) const;
  void add(std::size_t c, std::int64_t position, Workspace& work, std::vector<Word>& found) const;

  const PairTable* permitted_ = nullptr;  ///< null: no choice can be forbidden
  std::vector<ActionGrouping> pairs_;     ///< one, of the same classes by `permitted_` alone; or none
};

}  // namespace coordreq
