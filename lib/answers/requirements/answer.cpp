#include "answers/requirements/answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/layers/delay_layers.hpp"
#include "answers/requirements/fields.hpp"
#include "answers/requirements/judge_requirements.hpp"

namespace coordreq {
namespace {

const char* end_word(EscapeEnd end) {
  switch (end) {
    case EscapeEnd::outside_safe_set:
      return "outside_safe_set";
    case EscapeEnd::left_domain:
      return "left_domain";
    case EscapeEnd::unsafe_between_samples:
      return "unsafe_between_samples";
    default:
      return "no_allowed_action";
  }
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

Json sample_json(const ResultPath& path, std::size_t sample, const ProblemSpec& spec) {
  const std::int32_t time = path.collision_time[sample];
  Json json;
  json["state"] = state_json(path, sample, spec);
  json["cell"] = path.cell[sample];
  json["delay"] = delay_json(path.delay[sample]);
  json["delay_status"] = delay_word(path.delay[sample]);
  json["collision_time"] = time == DelayLayers::kUnbounded ? Json() : Json(time);
  return json;
}

Json step_json(const ResultPath& path, std::size_t step, const ProblemSpec& spec) {
  Json json = sample_json(path, step, spec);
  json["action"] = path.phase[step] == EscapePhase::independent ? "independent" : "evasive";
  json["inputs"] = Json::object();
  for (const AgentSpec& agent : spec.agents) {
    Json& own = json["inputs"][agent.name] = Json::object();
    for (const std::int32_t i : agent.inputs) {
      const auto input = static_cast<std::size_t>(i);
      own[spec.inputs[input].name] = path.input[step * spec.inputs.size() + input];
    }
  }
  return json;
}

Json counterexample_json(const ResultRequirement& result, const ProblemSpec& spec) {
  if (result.path) return story_json(*result.path, spec);
  Json json;
  json["state"] = Json();
  json["steps"] = Json::array();
  json["end"] = "outside_domain";
  json["end_sample"] = Json();
  json["left_side"] = side_json(result.reached_side, spec);
  return json;
}

}  // namespace

Json story_json(const ResultPath& path, const ProblemSpec& spec) {
  Json json;
  json["state"] = state_json(path, 0, spec);
  json["steps"] = Json::array();
  for (std::size_t s = 0; s < path.steps(); ++s) json["steps"].push_back(step_json(path, s, spec));
  json["end"] = end_word(path.end);
  const bool stays = path.samples() > path.steps();
  json["end_sample"] = stays ? sample_json(path, path.steps(), spec) : Json();
  json["left_side"] = side_json(path.left_side, spec);
  return json;
}

Json delay_json(std::int32_t delay) {
  return delay < 0 || delay == DelayLayers::kUnbounded ? Json() : Json(delay);
}

const char* delay_word(std::int32_t delay) {
  if (delay == DelayLayers::kUnbounded) return "unbounded";
  return delay == DelayLayers::kOutsideSafe        ? "not_safe"
         : delay == DelayLayers::kOutsideInvariant ? "not_invariant"
                                                   : "steps";
}

Json requirement_json(const ResultRequirement& result, const RequirementSpec& asked,
                      const ProblemSpec& spec) {
  Json json;
  json["name"] = result.name;
  json["holds"] = result.holds;
  json["kind"] = asked.invariant ? "invariant" : "min_delay";
  json["partition"] =
      asked.partition ? Json(spec.coordination.partitions[static_cast<std::size_t>(*asked.partition)].name)
                      : Json();
  json["min_delay"] = asked.min_delay ? Json(*asked.min_delay) : Json();
  json["cells"] = result.cells;
  json["failing"] = result.failing;
  json["least_delay"] = delay_json(result.least_delay);
  json["least_delay_status"] = delay_word(result.least_delay);
  json["reaches_outside"] = side_json(result.reached_side, spec);
  json["counterexample"] = result.holds ? Json() : counterexample_json(result, spec);
  return json;
}

std::vector<Stage> requirements_checks(const ProblemSpec& spec) {
  if (spec.requirements.empty()) return {};
  return {{"regions",
           [](Answers& answers, const StageWork& work) { check_regions(answers.ground.spec, work.team); }}};
}

std::vector<Stage> requirements_stages(const ProblemSpec& spec) {
  if (spec.requirements.empty()) return {};
  return {{"requirements", [](Answers& answers, const StageWork& work) {
             answers.add(RequirementVerdicts{judge_requirements(answers, work.team)});
           }}};
}

void summarise_requirements(const Answers& answers, Json& summary, Json& /*work*/) {
  const ProblemSpec& spec = answers.ground.spec;
  summary["requirements"] = Json::array();
  const auto* const verdicts = answers.find<RequirementVerdicts>();
  for (std::size_t r = 0; r < spec.requirements.size(); ++r)
    summary["requirements"].push_back(
        requirement_json(verdicts->requirements[r], spec.requirements[r], spec));
}

void tell_requirements(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  info["requirements"] = Json::array();
  for (const ResultRequirement& own : read_requirement_values(spec, source)) {
    info["requirements"].push_back({{"name", own.name},
                                    {"holds", own.holds},
                                    {"cells", own.cells},
                                    {"failing", own.failing},
                                    {"least_delay", delay_json(own.least_delay)},
                                    {"least_delay_status", delay_word(own.least_delay)},
                                    {"counterexample_steps", own.path ? Json(own.path->steps()) : Json()}});
  }
}

MemoryNeed requirements_memory(const EngineSizes& sizes, int /*threads*/) {
  constexpr double kBytesOfFields = 13.0 * 1024;  // measured: those of one requirement, and the file's lists
  // What the writer keeps of objects, as far as it goes; measured with counterexamples for all of them.
  constexpr double kBytesOfObjects = 72.0 * 1024, kMostOfObjects = 32.0 * 1024 * 1024;
  constexpr double kUsualSamples = 16;  // of a counterexample
  const ProblemSpec& spec = sizes.model().spec();
  const auto count = static_cast<double>(spec.requirements.size());
  if (count == 0) return {};
  const auto numbers = static_cast<double>(spec.states.size() + spec.inputs.size() + 3);
  const double path = kUsualSamples * numbers * sizeof(double);
  return {.kept = count * (sizeof(ResultRequirement) + path),
          .work = 2 * sizes.set(),  // a region, and the table of its condition
          .written = count * (kBytesOfFields + path) + std::min(count * kBytesOfObjects, kMostOfObjects)};
}

}  // namespace coordreq
