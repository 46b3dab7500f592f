#include "spec/read_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "expression/tape_builder.hpp"
#include "spec/check_limits.hpp"
#include "spec/held_inputs.hpp"
#include "spec/json_document.hpp"
#include "spec/schema_violation.hpp"
#include "spec/scope.hpp"
#include "spec/sight.hpp"
#include "spec/silence.hpp"
#include "spec/spec_errors.hpp"
#include "spec/spec_parts.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// Before the schema: what another format means by its keys is not for this program to say.
void check_format(const Node& root) {
  if (!root.is_object() || !root.has("coordreq")) return;
  const Node format = root["coordreq"];
  if (!format.is_number() || format.token() == "1") return;
  throw SpecError("this program reads spec format 1, found " + format.token(), format.pointer());
}

/// Validates with the schema that is printed. @throws SpecError, SpecErrors naming place, found and expected
void check_schema(const JsonDocument& document) {
  ErrorList errors;
  for (const SchemaViolation& violation : find_spec_violations(document.value(), ErrorList::kMost))
    errors.attempt([&] { throw SpecError(violation.what, pointer_text(violation.pointer)); });
  errors.raise();
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool contains_word(std::string text, std::string_view term) {
  std::transform(text.begin(), text.end(), text.begin(), lower_case);
  for (std::size_t at = text.find(term); at != std::string::npos; at = text.find(term, at + 1)) {
    const std::size_t end = at + term.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) return true;
  }
  return false;
}

/// @pre unchecked: the schema knows the word
GoalThen then_of(const std::string& term) {
  for (const GoalThen then : {GoalThen::terminal, GoalThen::stay, GoalThen::come_back}) {
    if (term == goal_then_name(then)) return then;
  }
  return GoalThen::safe;
}

/// A condition alone, or with what comes after arrival.
void read_goal(const Scope& scope, const Node& goal, ProblemSpec& spec) {
  const bool has_then = goal.is_object();
  spec.goal = scope.expression(has_then ? goal["where"] : goal, ExpectedType::condition, Dependence::states);
  if (has_then) spec.goal_then = then_of(goal["then"].text());
}

/// All parts but the first few; a part that rests on another one is only read if that one is right.
void read_sections(const Scope& scope, const Node& root, ProblemSpec& spec) {
  ErrorList errors;
  errors.attempt([&] { spec.states = read_states(scope, root); });
  const bool has_inputs = errors.attempt([&] { spec.inputs = read_inputs(scope, root); });
  errors.attempt([&] { spec.disturbances = read_disturbances(scope, root); });
  const bool has_agents =
      has_inputs && errors.attempt([&] { spec.agents = read_agents(scope, root, spec.inputs); });
  Rational period;
  const bool has_period = errors.attempt([&] { period = read_period(scope, root); });
  errors.attempt([&] { spec.dynamics = read_dynamics(scope, root, period, spec.states); });
  errors.attempt(
      [&] { spec.safe = scope.expression(root["safe"], ExpectedType::condition, Dependence::states); });
  errors.attempt([&] {
    if (root.has("goal")) read_goal(scope, root["goal"], spec);
  });
  errors.attempt([&] { spec.abstraction = read_abstraction(root); });
  errors.attempt([&] { spec.controller = read_controller(scope, root); });
  const bool is_coordinated = has_agents && has_period && errors.attempt([&] {
    spec.coordination = read_coordination(scope, root, spec.agents, period);
    check_sight(spec);
  });
  errors.attempt([&] {
    if (has_agents && root.has("silence")) spec.silence = read_silence(scope, root, spec.agents);
  });
  if (is_coordinated) {
    errors.attempt([&] {
      if (root.has("network")) spec.network = read_network(scope, root, spec.agents, spec.coordination);
    });
    const bool is_risk_known = errors.attempt([&] {
      if (root.has("risk")) spec.risk = read_risk(scope, root, period, spec.network);
    });
    errors.attempt([&] {
      if (!is_risk_known) return;
      spec.requirements = read_requirements(scope, root, spec.agents, spec.coordination, spec.risk, period);
    });
  }
  errors.raise();
}

/// Gives memories their numbers among the variables. They need the states, and whether conditions are asked
/// of centres.
void number_memories(const Node& root, MemoryReader& memory) {
  if (memory.names().empty()) return;
  const AbstractionSpec abstraction = read_abstraction(root);
  if (abstraction.between_samples) {
    throw SpecError("'between_samples' together with 'memory' is not supported yet",
                    "/abstraction/between_samples");
  }
  memory.look_at(read_states(Scope(root, memory), root), abstraction.safe);
  static_cast<void>(Scope(root, memory));
  memory.settle();
}

/// A requirement is about what is kept at first, unless it says otherwise.
void begin_at_first_values(ProblemSpec& spec) {
  for (RequirementSpec& requirement : spec.requirements) {
    const std::vector<std::uint32_t> mentioned = requirement.where.variables();
    TapeBuilder tape;
    TapeBuilder::Index where = tape.merge(requirement.where);
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      if (!spec.dynamics.is_kept(i) || contains(mentioned, i)) continue;
      where = tape.apply(Operator::logical_and, where,
                         tape.apply(Operator::equal, tape.variable(spec.state_slot(i)), tape.constant(0)));
    }
    std::string text = requirement.where.text;
    requirement.where = tape.extract(where);
    requirement.where.text = std::move(text);
  }
}

}  // namespace

std::string read_unit(const Node& object) {
  if (!object.has("unit")) return {};
  const Node unit = object["unit"];
  if (contains_word(unit.text(), "since")) {
    throw SpecError(
        fmt::format("expected a unit without the word 'since', found {}", quote_text(unit.text())),
        unit.pointer());
  }
  return unit.text();
}

std::int64_t read_integer(const Node& node) {
  return node.integer();
}

std::int64_t read_steps_of_time(const Scope& scope, const Node& time, const Rational& period,
                                StepRounding rounding) {
  constexpr std::int64_t kMostSteps = 2'147'483'646;
  const Rational value = scope.time(time);
  if (value < 0) throw SpecError("expected a time >= 0, found " + to_text(value), time.pointer());
  const Rational periods = value / period;
  const std::int64_t steps = rounding == StepRounding::up ? ceil_to_int(periods) : floor_to_int(periods);
  if (steps > kMostSteps) {
    throw SpecError(
        fmt::format("expected a time of at most {} periods, found {}", kMostSteps, to_text(value)),
        time.pointer());
  }
  return steps;
}

std::int32_t index_of_name(const Node& name, const std::vector<std::string>& known, const std::string& kind) {
  const auto found = std::find(known.begin(), known.end(), name.text());
  if (found != known.end()) return static_cast<std::int32_t>(found - known.begin());
  throw SpecError(
      fmt::format("{} is not {}{}", quote_text(name.text()), kind, suggestion(name.text(), known)),
      name.pointer());
}

void check_new_name(const Node& name, const std::vector<std::string>& known, const std::string& kind) {
  if (std::find(known.begin(), known.end(), name.text()) == known.end()) return;
  throw SpecError(fmt::format("the {} {} is listed twice", kind, quote_text(name.text())), name.pointer());
}

std::string goal_then_name(GoalThen then) {
  switch (then) {
    case GoalThen::terminal:
      return "over";
    case GoalThen::stay:
      return "stay";
    case GoalThen::come_back:
      return "return";
    case GoalThen::safe:
      break;
  }
  return "safe";
}

ProblemSpec read_spec(std::string text, std::string_view source) {
  const JsonDocument written = JsonDocument::parse(text, source);
  check_format(written.root());
  check_schema(written);
  const JsonDocument document = with_held_inputs(written, text, source);
  const Node root = document.root();
  MemoryReader memory(root);
  number_memories(root, memory);
  const Scope scope(root, memory);
  ProblemSpec spec;
  spec.text = std::move(text);
  spec.name = root["name"].text();
  spec.description = root.text_or("description", "");
  spec.output = read_output(root);
  read_sections(scope, root, spec);
  if (memory.names().empty()) {
    check_silence(spec);
    return spec;
  }
  memory.add_to(spec);
  check_silence(spec);
  check_cell_count(spec.states);
  begin_at_first_values(spec);
  return spec;
}

}  // namespace coordreq
