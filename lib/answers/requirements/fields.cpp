#include "answers/countdown/delay_layers.hpp"
#include "answers/field_parts.hpp"
#include "answers/requirements/answer.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "answers/step_codes.hpp"
#include "base/thread_team.hpp"
#include "choices/forbidden_choices.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"

namespace coordreq {
namespace {

constexpr FieldSection kSection = FieldSection::requirements;

template <class Variable>
std::vector<std::string> names_of(const std::vector<Variable>& variables) {
  std::vector<std::string> names;
  for (const Variable& variable : variables) names.push_back(variable.name);
  return names;
}

/// "x [m], v [m/s]": units stand in the long name, since CF has one unit a dataset.
template <class Variable>
std::string component_text(const std::vector<Variable>& variables) {
  std::string text;
  for (const Variable& variable : variables) {
    text += (text.empty() ? "" : ", ") + variable.name;
    if (!variable.unit.empty()) text += " [" + variable.unit + "]";
  }
  return text;
}

Field list(const std::string& path, const std::string& axis, ElementType type, const std::string& long_name,
           std::int64_t least, std::int64_t most, std::vector<FieldFlag> meanings = {}) {
  Field field{.path = path,
              .section = kSection,
              .types = {type},
              .axes = {axis},
              .least = least,
              .most = most,
              .attributes = described(long_name)};
  if (!meanings.empty()) field.attributes.push_back(flags(std::move(meanings)));
  return field;
}

Field table(const std::string& path, std::vector<std::string> axes, const std::string& long_name) {
  return {.path = path,
          .section = kSection,
          .types = {ElementType::float64},
          .axes = std::move(axes),
          .attributes = {{"long_name", long_name}}};
}

std::vector<FieldFlag> delay_flags(const ProblemSpec& spec) {
  std::vector<FieldFlag> result = {{-2, "not_safe"}, {-1, "not_invariant"}, {kLargestValue, "unbounded"}};
  if (spec.goal) result.insert(result.begin(), {kOutsideWinning, "goal_cannot_be_forced"});
  return result;
}

/// The least value of a delay in a requirement: delays are those of safety, approach delays or arrivals, by
/// its kind.
std::int64_t least_delay(const ProblemSpec& spec) {
  return spec.goal ? kOutsideWinning : kOutsideSafe;
}

std::vector<FieldFlag> end_flags(const ProblemSpec& spec) {
  std::vector<FieldFlag> result = {{0, "none"},
                                   {1, "outside_safe_set"},
                                   {2, "left_domain"},
                                   {3, "unsafe_between_samples"},
                                   {4, "no_allowed_action"}};
  if (spec.goal) result.insert(result.end(), {{5, "arrived"}, {6, "never_arrives"}, {7, "time_lost"}});
  if (may_forbid_choices(spec)) result.push_back({8, "not_allowed"});
  if (spec.risk) result.push_back({9, "too_risky"});
  if (has_limited_sight(spec)) result.push_back({10, "no_common_action"});
  if (spec.silence) result.push_back({11, "no_silent_action"});
  return result;
}

std::vector<FieldFlag> phase_flags(const ProblemSpec& spec) {
  std::vector<FieldFlag> result = {{0, "independent"}, {1, "evasive"}};
  if (spec.goal) result.insert(result.end(), {{2, "together"}, {3, "approaching"}});
  if (spec.silence) result.push_back({4, "silent"});
  if (spec.silence && spec.silence->has_then()) result.push_back({5, "afterwards"});
  return result;
}

/// The sides of the domain, numbered: 0 for none, then below and above of each state.
std::vector<FieldFlag> side_flags(const ProblemSpec& spec) {
  std::vector<FieldFlag> result = {{0, "none"}};
  for (const StateSpec& state : spec.states) {
    for (const char* side : {"below_", "above_"})
      result.push_back({static_cast<std::int64_t>(result.size()), side + state.name});
  }
  return result;
}

std::int32_t side_number(const std::optional<ResultSide>& side) {
  return side ? static_cast<std::int32_t>(2 * side->state) + (side->above ? 2 : 1) : 0;
}

void add_verdicts(Fields& fields, const ProblemSpec& spec) {
  const std::string axis = counterexample_path("requirement");
  const auto sides = static_cast<std::int64_t>(2 * spec.states.size());
  const auto add = [&](const std::string& name, ElementType type, const std::string& long_name,
                       std::int64_t least, std::int64_t most, std::vector<FieldFlag> meanings = {}) {
    fields.push_back(
        list(counterexample_path(name), axis, type, long_name, least, most, std::move(meanings)));
  };
  add("holds", ElementType::uint8, "verdict", 0, 1, {{0, "fails"}, {1, "holds"}});
  add("cells", ElementType::uint64, "cells that may meet the region", 0, kLargestValue);
  add("failing", ElementType::uint64, "cells of the region that fail", 0, kLargestValue);
  add("least_delay", ElementType::int32, "least delay of the cells of the region", least_delay(spec),
      kLargestValue, delay_flags(spec));
  if (spec.risk)
    fields.push_back(table(counterexample_path("risk"), {axis}, "greatest risk of the cells of the region"));
  add("reached_side", ElementType::int32, "side of the domain beyond which the region may reach", 0, sides,
      side_flags(spec));
  const std::vector<FieldFlag> ends = end_flags(spec);
  add("end", ElementType::uint8, "how the counterexample ends", 0, ends.back().value, ends);
  add("left_side", ElementType::int32, "unsafe side of the domain through which the last action leads", 0,
      sides, side_flags(spec));
  add("seen", ElementType::int32, "steps after which the system itself leaves", ResultPath::kNotLeft,
      kLargestValue, {{ResultPath::kNotLeft, "not_left"}, {ResultPath::kNotFollowed, "not_followed"}});
}

void add_path(Fields& fields, const ProblemSpec& spec, std::size_t requirement) {
  const auto path = [requirement](const char* name) { return counterexample_path(requirement, name); };
  const std::uint64_t cells = cell_count(spec);
  const std::string sample = path("sample");
  const std::string step = path("step");
  // A way visits every cell at most once by layers, and once by collision times.
  Field samples = number_scale(sample, kSection, 1, 2 * cells + 2, "number of the sample");
  Field steps = number_scale(step, kSection, 1, 2 * cells + 2, "number of the step");
  samples.scale->is_optional = steps.scale->is_optional = true;
  fields.push_back(std::move(samples));
  fields.push_back(list(path("cell"), sample, ElementType::uint64, "row-major linear index of the cell", 0,
                        static_cast<std::int64_t>(cells) - 1));
  fields.push_back(table(path("state"), {sample, counterexample_path("state_name")},
                         "centre of the cell: " + component_text(spec.states)));
  fields.push_back(list(path("delay"), sample, ElementType::int32, "delay of the cell", least_delay(spec),
                        kLargestValue, delay_flags(spec)));
  fields.push_back(list(path("collision_time"), sample, ElementType::int32, "collision time of the cell", 0,
                        kLargestValue, {{0, "not_safe"}, {kLargestValue, "never"}}));
  fields.push_back(std::move(steps));
  fields.push_back(table(path("input"), {step, counterexample_path("input_name")},
                         "joint input: " + component_text(spec.inputs)));
  const std::vector<FieldFlag> phases = phase_flags(spec);
  fields.push_back(list(path("phase"), step, ElementType::uint8, "what the joint input is taken from", 0,
                        phases.back().value, phases));
}

/// Adds a field with one value for each requirement.
template <class Value, class Get>
void add_of_each(FieldValues& values, const std::vector<ResultRequirement>& requirements,
                 const std::string& name, ElementType type, const Get& get) {
  std::vector<Value> list;
  for (const ResultRequirement& requirement : requirements)
    list.push_back(static_cast<Value>(get(requirement)));
  values.entries[counterexample_path(name)].array = owned_array(type, std::move(list));
}

void add_path_values(const ResultPath& path, std::size_t requirement, FieldValues& values) {
  const auto set = [&](const char* name, ElementType type, auto list) {
    values.entries[counterexample_path(requirement, name)].array = owned_array(type, std::move(list));
  };
  values.lengths[counterexample_path(requirement, "sample")] = path.samples();
  set("cell", ElementType::uint64, path.cell);
  set("state", ElementType::float64, path.state);
  set("delay", ElementType::int32, path.delay);
  set("collision_time", ElementType::int32, path.collision_time);
  if (path.steps() == 0) return;
  values.lengths[counterexample_path(requirement, "step")] = path.steps();
  set("input", ElementType::float64, path.input);
  std::vector<std::uint8_t> phases;
  for (const PathPhase phase : path.phase) phases.push_back(static_cast<std::uint8_t>(phase));
  set("phase", ElementType::uint8, std::move(phases));
}

}  // namespace

/// Verdicts, and the counterexamples of those that fail: each in a group of its own, by its position among
/// the requirements.
Fields requirement_fields(const ProblemSpec& spec) {
  if (spec.requirements.empty()) return {};
  Fields fields = {name_scale(counterexample_path("requirement"), kSection, names_of(spec.requirements),
                              "name of the requirement")};
  add_verdicts(fields, spec);
  fields.push_back(
      name_scale(counterexample_path("state_name"), kSection, names_of(spec.states), "name of the state"));
  fields.push_back(
      name_scale(counterexample_path("input_name"), kSection, names_of(spec.inputs), "name of the input"));
  for (std::size_t r = 0; r < spec.requirements.size(); ++r) add_path(fields, spec, r);
  return fields;
}

/// Fills in the values of these fields.
void fill_requirement_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const auto* const verdicts = answers.find<RequirementVerdicts>();
  if (verdicts == nullptr) return;
  const std::vector<ResultRequirement>& requirements = verdicts->requirements;
  using R = const ResultRequirement&;
  add_of_each<std::uint8_t>(values, requirements, "holds", ElementType::uint8,
                            [](R r) { return r.holds ? 1 : 0; });
  add_of_each<std::uint64_t>(values, requirements, "cells", ElementType::uint64, [](R r) { return r.cells; });
  add_of_each<std::uint64_t>(values, requirements, "failing", ElementType::uint64,
                             [](R r) { return r.failing; });
  // A requirement about risk has no delay: 0.
  add_of_each<std::int32_t>(values, requirements, "least_delay", ElementType::int32,
                            [](R r) { return r.is_risk ? 0 : r.least_delay; });
  if (answers.context.spec.risk) {
    add_of_each<double>(values, requirements, "risk", ElementType::float64,
                        [](R r) { return r.is_risk ? probability_of(r.least_delay) : 0.0; });
  }
  add_of_each<std::int32_t>(values, requirements, "reached_side", ElementType::int32,
                            [](R r) { return side_number(r.reached_side); });
  add_of_each<std::uint8_t>(values, requirements, "end", ElementType::uint8,
                            [](R r) { return r.path ? static_cast<int>(r.path->end) + 1 : 0; });
  add_of_each<std::int32_t>(values, requirements, "left_side", ElementType::int32,
                            [](R r) { return side_number(r.path ? r.path->left_side : std::nullopt); });
  add_of_each<std::int32_t>(values, requirements, "seen", ElementType::int32,
                            [](R r) { return r.path ? r.path->seen : ResultPath::kNotFollowed; });
  for (std::size_t r = 0; r < requirements.size(); ++r) {
    if (!requirements[r].path) continue;
    ResultPath path = *requirements[r].path;
    if (requirements[r].is_risk) path.delay.assign(path.samples(), 0);
    add_path_values(path, r, values);
  }
}

}  // namespace coordreq
