#include "answers/silence/silent_actions.hpp"

#include <algorithm>

#include "answers/invariance/answer.hpp"
#include "answers/invariance/safe_set.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "engine/action_sources.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Classes = std::vector<std::vector<std::int32_t>>;
using Tables = std::vector<std::optional<PairTable>>;

Tables tables_of(const AnalysisContext& context, const AgentRules& rules, ThreadTeam& team) {
  Tables tables(rules.conditions.size());
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (!rules.conditions[i]) continue;
    tables[i] = permitted_pairs({*rules.conditions[i], "the condition",
                                 member_pointer("/silence/" + rules.key, context.spec.agents[i].name)},
                                context.spec, *context.abstraction, team, context.shared_rows());
  }
  return tables;
}

std::vector<InputClass> inputs_of(const AnalysisContext& context, const Classes& classes) {
  std::vector<InputClass> result;
  for (const std::vector<std::int32_t>& agents : classes)
    result.push_back(class_of(context.spec, context.abstraction->inputs, agents));
  return result;
}

/// The sources of the engine, then the rules in the order of the agents.
std::vector<ActionSource> sources_of(const AnalysisContext& context, const Tables& tables) {
  std::vector<ActionSource> sources = action_sources(*context.engine);
  for (const std::optional<PairTable>& table : tables) {
    if (table) sources.push_back(source_of(*table, context.abstraction->inputs));
  }
  return sources;
}

SilentRules rules_of(const AgentRules& rules, const Classes& classes, const Tables& tables,
                     std::size_t sources, const CellSet& cells,
                     std::vector<std::atomic<std::int64_t>>& without_action) {
  SilentRules result{.cells = &cells,
                     .classes = {},
                     .tables = std::vector<const PairTable*>(sources, nullptr),
                     .without_action = &without_action};
  std::vector<std::size_t> source_of_agent(tables.size());
  auto next = static_cast<std::size_t>(
      std::ranges::count_if(tables, [](const auto& table) { return table.has_value(); }));
  next = sources - next;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (!tables[i]) continue;
    source_of_agent[i] = next;
    result.tables[next++] = &*tables[i];
  }
  for (const std::vector<std::int32_t>& agents : classes) {
    ClassRules& class_rules = result.classes.emplace_back();
    class_rules.agent = at(agents.front());
    for (const std::int32_t i : agents) {
      const bool has_rule = rules.conditions[at(i)].has_value();
      if (!has_rule && !class_rules.asks_controller) class_rules.agent = at(i);
      class_rules.asks_controller = class_rules.asks_controller || !has_rule;
      if (!tables[at(i)]) continue;
      class_rules.sources.push_back(source_of_agent[at(i)]);
      class_rules.agents.push_back(at(i));
    }
  }
  return result;
}

}  // namespace

SilentActions::SilentActions(const Answers& answers, const AgentRules& rules, const Classes& classes,
                             const CellSet& cells, ThreadTeam& team)
    : tables(tables_of(answers.context, rules, team)),
      without_action(rules.conditions.size()),
      grouping(*answers.context.engine, inputs_of(answers.context, classes),
               sources_of(answers.context, tables), team),
      projections(answers.get<NonterminalController>().controller, grouping, team,
                  rules_of(rules, classes, tables, grouping.sources().size(), cells, without_action)) {}

RuleModes::RuleModes(const Answers& answers, const std::vector<const PartitionSpec*>& partitions,
                     ThreadTeam& team) {
  const ProblemSpec& spec = answers.context.spec;
  REQUIRES(spec.silence.has_value());
  for (const PartitionSpec* const partition : partitions) {
    projections_.push_back(nullptr);
    if (partition->classes.size() < 2) continue;
    actions_.emplace_back(answers, AgentRules{spec.silence->actions, "actions"}, partition->classes,
                          *answers.get<NonterminalController>().controller.invariant, team);
    projections_.back() = &actions_.back().projections;
  }
}

double silent_bytes(const EngineSizes& sizes, const std::vector<InputClass>& classes) {
  const SilenceSpec& silence = *sizes.model().spec().silence;
  double tables = 0;
  for (const auto* const rules : {&silence.actions, &silence.then}) {
    double rule_tables = 0;
    for (const std::optional<Program>& rule : *rules) rule_tables += rule ? 2 * sizes.condition(*rule) : 0;
    tables = std::max(tables, rule_tables);
  }
  double masks = sizes.set();  // the set of cells where a class has no action
  for (const InputClass& input_class : classes)
    masks += sizes.set() * static_cast<double>(input_class.actions());
  return tables + masks;
}

std::vector<std::vector<std::int32_t>> agents_alone(const ProblemSpec& spec) {
  Classes classes;
  for (std::size_t i = 0; i < spec.agents.size(); ++i) classes.push_back({static_cast<std::int32_t>(i)});
  return classes;
}

}  // namespace coordreq
