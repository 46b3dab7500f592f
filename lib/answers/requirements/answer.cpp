#include "answers/requirements/answer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <nlohmann/json.hpp>

#include "answers/checking/all_checks.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/requirements/judge_requirements.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"

namespace coordreq {
namespace {

const char* end_label(PathEnd end) {
  constexpr std::array<const char*, 11> kLabels{
      "outside_safe_set",  "left_domain",     "unsafe_between_samples",
      "no_allowed_action", "arrived",         "never_arrives",
      "time_lost",         "not_allowed",     "too_risky",
      "no_common_action",  "no_silent_action"};
  return kLabels[static_cast<std::size_t>(end)];
}

const char* phase_label(PathPhase phase) {
  constexpr std::array<const char*, 6> kLabels{"independent", "evasive", "together",
                                               "approaching", "silent",  "afterwards"};
  return kLabels[static_cast<std::size_t>(phase)];
}

/// Adds a risk, and the bits of the float32.
void put_risk(Json& json, const std::string& key, double risk) {
  json[key] = risk;
  json[key + "_status"] = "number";
}

/// Adds a value of a requirement; INT32_MAX means silence without bound, or a goal that is never reached.
void put_value(Json& json, const std::string& key, RequirementKind kind, std::int32_t value,
               const ProblemSpec& spec) {
  if (traits(kind).is_probability) return put_risk(json, key, double{std::bit_cast<float>(value)});
  const bool is_no_end = kind == RequirementKind::min_silence && value == kOutsideInvariant && spec.silence &&
                         spec.silence->has_then();
  const bool is_never = kind == RequirementKind::max_arrival && value == kUnbounded;
  json[key] = delay_json(value);
  json[key + "_status"] = is_never    ? "goal_cannot_be_forced"
                          : is_no_end ? "not_in_silence_set"
                                      : delay_label(value);
}

Json side_json(const std::optional<ResultSide>& side, const ProblemSpec& spec) {
  if (!side) return {};
  return {{"state", spec.states[side->state].name}, {"side", side->above ? "above" : "below"}};
}

Json state_json(const ResultPath& path, std::size_t sample, const ProblemSpec& spec) {
  Json json = Json::object();
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    json[spec.states[i].name] = path.state[sample * spec.states.size() + i];
  return json;
}

Json sample_json(const ResultPath& path, std::size_t sample, RequirementKind kind, const ProblemSpec& spec) {
  const std::int32_t time = path.collision_time[sample];
  Json json;
  json["state"] = state_json(path, sample, spec);
  json["cell"] = path.cell[sample];
  put_value(json, traits(kind).value, kind, path.delay[sample], spec);
  json["collision_time"] = time == kUnbounded ? Json() : Json(time);
  return json;
}

Json step_json(const ResultPath& path, std::size_t step, RequirementKind kind, const ProblemSpec& spec) {
  Json json = sample_json(path, step, kind, spec);
  json["action"] = phase_label(path.phase[step]);
  json["inputs"] = Json::object();
  for (const AgentSpec& agent : spec.agents) {
    Json& entry = json["inputs"][agent.name] = Json::object();
    for (const std::int32_t i : agent.inputs) {
      const auto input = static_cast<std::size_t>(i);
      entry[spec.inputs[input].name] = path.input[step * spec.inputs.size() + input];
    }
  }
  return json;
}

Json counterexample_json(const ResultRequirement& result, RequirementKind kind, const ProblemSpec& spec) {
  Json json;
  if (result.path) {
    json = path_json(*result.path, kind, spec);
    if (traits(kind).is_probability) put_risk(json["end_sample"], traits(kind).value, result.risk);
    return json;
  }
  json["state"] = Json();
  json["steps"] = Json::array();
  json["end"] = "outside_domain";
  json["end_sample"] = Json();
  json["left_side"] = side_json(result.reached_side, spec);
  json["proven"] = json["seen"] = Json();
  return json;
}

}  // namespace

namespace {

/// The number of steps for which the grid proves that the system stays in the set in which agents go on as
/// they are, or else in S.
std::int64_t proven_steps(const ResultPath& path) {
  if (path.phase.front() != PathPhase::afterwards)
    return path.delay.front() < 0 ? path.collision_time.front() : path.delay.front();
  // A step for which agents have no action leaves the set, too.
  return static_cast<std::int64_t>(path.steps()) + (path.end == PathEnd::no_silent_action ? 1 : 0);
}

/// "regions", if there are requirements: refuses a region that meets no cell.
std::vector<Stage> requirements_checks(const ProblemSpec& spec) {
  if (spec.requirements.empty()) return {};
  return {{"regions",
           [](Answers& answers, const StageWork& work) { check_regions(answers.context.spec, work.team); }}};
}

/// Adds RequirementVerdicts, if there are requirements: "requirements".
std::vector<Stage> requirements_stages(const ProblemSpec& spec) {
  if (spec.requirements.empty()) return {};
  return {{"requirements", [](Answers& answers, const StageWork& work) {
             answers.add(RequirementVerdicts{judge_requirements(answers, work.team)});
           }}};
}

void summarise_requirements(const Answers& answers, Json& summary, Json& /*work*/) {
  const ProblemSpec& spec = answers.context.spec;
  summary["requirements"] = Json::array();
  const auto* const verdicts = answers.find<RequirementVerdicts>();
  for (std::size_t r = 0; r < spec.requirements.size(); ++r)
    summary["requirements"].push_back(
        requirement_json(verdicts->requirements[r], spec.requirements[r], spec));
}

/// Fails if verdicts and counterexamples do not fit together.
void examine_requirements(const ProblemSpec& spec, const FieldSource& source) {
  static_cast<void>(read_requirement_values(spec, source));
}

void describe_requirements(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  info["requirements"] = Json::array();
  const std::vector<ResultRequirement> results = read_requirement_values(spec, source);
  for (std::size_t r = 0; r < results.size(); ++r) {
    const ResultRequirement& requirement = results[r];
    const RequirementKind kind = spec.requirements[r].kind;
    Json& json = info["requirements"].emplace_back(Json{{"name", requirement.name},
                                                        {"holds", requirement.holds},
                                                        {"cells", requirement.cells},
                                                        {"failing", requirement.failing}});
    if (traits(kind).is_probability) {
      put_risk(json, traits(kind).worst(), requirement.risk);
    } else {
      put_value(json, traits(kind).worst(), kind, requirement.least_delay, spec);
    }
    json["counterexample_steps"] = requirement.path ? Json(requirement.path->steps()) : Json();
  }
}

MemoryNeed requirements_memory(const EngineSizes& sizes, int /*threads*/) {
  constexpr double kBytesOfFields =
      13.0 * 1024;  // measured: fields of one requirement, and their entries in lists of the file
  // Memory that the HDF5 writer keeps for objects, and its limit; measured with counterexamples for all
  // requirements.
  constexpr double kBytesOfObjects = 72.0 * 1024, kMostOfObjects = 32.0 * 1024 * 1024;
  constexpr double kUsualSamples = 16;  // samples of a counterexample
  const ProblemSpec& spec = sizes.model().spec();
  const auto count = static_cast<double>(spec.requirements.size());
  if (count == 0) return {};
  const auto numbers = static_cast<double>(spec.states.size() + spec.inputs.size() + 3);
  const double path = kUsualSamples * numbers * sizeof(double);
  // find_showing_order(): levels a second time, the numbers of rounds, and sets.
  const double order = spec.is_goal_lasting() ? sizes.levels() + sizes.cells() * sizeof(std::uint32_t) +
                                                    3 * sizes.set() + sizes.wave(1)
                                              : 0;
  return {.kept = count * (sizeof(ResultRequirement) + path),
          .work = 2 * sizes.set() + order,  // a region, and the table of its condition
          .written = count * (kBytesOfFields + path) + std::min(count * kBytesOfObjects, kMostOfObjects)};
}

}  // namespace

const char* delay_label(std::int32_t delay) {
  if (delay == kUnbounded) return "unbounded";
  return delay == kOutsideWinning     ? "goal_cannot_be_forced"
         : delay == kOutsideSafe      ? "not_safe"
         : delay == kOutsideInvariant ? "not_invariant"
                                      : "steps";
}

Json path_json(const ResultPath& path, RequirementKind kind, const ProblemSpec& spec) {
  Json json;
  json["state"] = state_json(path, 0, spec);
  json["steps"] = Json::array();
  for (std::size_t s = 0; s < path.steps(); ++s) json["steps"].push_back(step_json(path, s, kind, spec));
  json["end"] = end_label(path.end);
  const bool stays = path.samples() > path.steps();
  json["end_sample"] = stays ? sample_json(path, path.steps(), kind, spec) : Json();
  json["left_side"] = side_json(path.left_side, spec);
  const bool is_followed = path.seen != ResultPath::kNotFollowed;
  json["proven"] = is_followed ? Json(proven_steps(path)) : Json();
  json["seen"] = path.seen > 0 ? Json(path.seen) : Json();
  return json;
}

Json delay_json(std::int32_t delay) {
  return delay < 0 || delay == kUnbounded ? Json() : Json(delay);
}

Json requirement_json(const ResultRequirement& result, const RequirementSpec& requirement,
                      const ProblemSpec& spec) {
  Json json;
  json["name"] = result.name;
  json["holds"] = result.holds;
  json["kind"] = traits(requirement.kind).key;
  json["partition"] =
      requirement.partition
          ? Json(spec.coordination.partitions[static_cast<std::size_t>(*requirement.partition)].name)
          : Json();
  json["min_delay"] = Json();
  const bool is_risk = traits(requirement.kind).is_probability;
  if (is_risk) {
    json[traits(requirement.kind).key] = nearest_double(requirement.risk);
    json["per"] = requirement.per.empty() ? Json() : Json(requirement.per);
  } else if (requirement.kind != RequirementKind::invariant) {
    json[traits(requirement.kind).key] = requirement.steps;
  }
  json["cells"] = result.cells;
  json["failing"] = result.failing;
  if (is_risk) {
    put_risk(json, traits(requirement.kind).worst(), result.risk);
  } else {
    put_value(json, traits(requirement.kind).worst(), requirement.kind, result.least_delay, spec);
  }
  json["reaches_outside"] = side_json(result.reached_side, spec);
  json["counterexample"] = result.holds ? Json() : counterexample_json(result, requirement.kind, spec);
  return json;
}

const Answer requirements_answer = {.checks = requirements_checks,
                                    .stages = requirements_stages,
                                    .memory = requirements_memory,
                                    .fields = requirement_fields,
                                    .fill = fill_requirement_fields,
                                    .summarise = summarise_requirements,
                                    .examine = examine_requirements,
                                    .describe = describe_requirements,
                                    .check = check_requirements,
                                    .check_memory = requirements_check_memory};

}  // namespace coordreq
