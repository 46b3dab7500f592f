#include "choices/forbidden_choices.hpp"

#include <algorithm>
#include <cstdint>

#include "engine/action_sources.hpp"
#include "engine/row_engine.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

bool allow_joins_agents(const ProblemSpec& spec) {
  if (!spec.controller.allow) return false;
  const std::vector<std::uint32_t> used = spec.controller.allow->variables();
  const auto is_used = [&](std::int32_t i) {
    return std::ranges::binary_search(used, spec.input_slot(static_cast<std::size_t>(i)));
  };
  return std::ranges::count_if(spec.agents, [&](const AgentSpec& agent) {
           return std::ranges::any_of(agent.inputs, is_used);
         }) > 1;
}

bool may_forbid_choices(const ProblemSpec& spec) {
  return allow_joins_agents(spec) || (spec.silence && spec.controller.allow);
}

ForbiddenChoices::ForbiddenChoices(const ActionGrouping& grouping, ThreadTeam& team, bool by_rules) {
  const RowEngine& engine = grouping.engine();
  if (engine.permitted() == nullptr) return;
  const ActionSource source = source_of(*engine.permitted(), engine.abstraction().inputs);
  std::vector<InputClass> classes;
  std::size_t joined = 0;
  for (std::size_t c = 0; c < grouping.size(); ++c) {
    classes.push_back(grouping[c]);
    joined += std::ranges::any_of(source.inputs, [&](std::int32_t i) { return grouping[c].contains(i); });
  }
  if (joined < 2 && !by_rules) return;
  permitted_ = engine.permitted();
  pairs_.emplace_back(engine, classes, std::vector<ActionSource>{source}, team);
}

bool ForbiddenChoices::find(const RowPosition& position, const RowGroups& groups,
                            const std::vector<std::vector<Word>>& masks, Workspace& work,
                            std::vector<Word>& found) const {
  if (permitted_ == nullptr) return false;
  const ActionGrouping& pairs = pairs_.front();
  pairs.group(position, work.groups);
  work.masks.resize(pairs.size());
  work.open.resize(pairs.size() + 1);
  for (std::size_t c = 0; c < pairs.size(); ++c) join_groups(c, *groups.classes[c], masks[c], work);
  work.open.front().assign(found.size(), ~Word{0});
  std::ranges::fill(found, Word{0});
  add(0, pairs.sources().front().base(position), work, found);
  return any_set(found);
}

/// Joins the masks of the actions that `allow` does not distinguish.
void ForbiddenChoices::join_groups(std::size_t c, const ActionGroups& groups, const std::vector<Word>& masks,
                                   Workspace& work) const {
  const ActionGroups& class_groups = *work.groups.classes[c];
  const std::size_t words = pairs_.front().engine().row_words();
  work.masks[c].assign(class_groups.size() * words, 0);
  work.joined.assign(class_groups.size() * groups.size(), 0);
  for (std::size_t a = 0; a < class_groups.group_of.size(); ++a) {
    const std::size_t to = class_groups.group_of[a], from = groups.group_of[a];
    std::uint8_t& is_joined = work.joined[to * groups.size() + from];
    for (std::size_t w = 0; is_joined == 0 && w < words; ++w)
      work.masks[c][to * words + w] |= masks[from * words + w];
    is_joined = 1;
  }
}

/// Adds the forbidden choices of class c and the classes after it, given the choices of the classes before.
/// @param position in the table, of the choices before
void ForbiddenChoices::add(std::size_t c, std::int64_t position, Workspace& work,
                           std::vector<Word>& found) const {
  const std::vector<Word>& open = work.open[c];
  if (c == work.masks.size()) {
    const ConstRow permitted = permitted_->row(position);
    for (std::size_t w = 0; w < found.size(); ++w) found[w] |= open[w] & ~permitted[w];
    return;
  }
  const ActionGroups& groups = *work.groups.classes[c];
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<Word>& next = work.open[c + 1];
    next.resize(found.size());
    Word any = 0;
    for (std::size_t w = 0; w < found.size(); ++w)
      any |= next[w] = open[w] & work.masks[c][g * found.size() + w] & ~found[w];
    if (any != 0)
      add(c + 1, position + pairs_.front().contribution(c, 0, groups.representative[g]), work, found);
  }
}

}  // namespace coordreq
