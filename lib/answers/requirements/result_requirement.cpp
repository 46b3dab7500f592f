#include "answers/requirements/result_requirement.hpp"

#include <algorithm>
#include <bit>

#include "answers/requirements/risk_limit.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::optional<ResultSide> side_of_number(std::int64_t number) {
  if (number == 0) return std::nullopt;
  return ResultSide{static_cast<std::size_t>((number - 1) / 2), number % 2 == 0};
}

std::vector<std::int32_t> narrow(const std::vector<std::int64_t>& values) {
  return {values.begin(), values.end()};
}

ResultPath read_path(const FieldSource& source, std::size_t requirement) {
  const auto path = [requirement](const char* name) { return counterexample_path(requirement, name); };
  const std::vector<std::int64_t> cells = source.integers(path("cell"));
  ResultPath result{.cell = {cells.begin(), cells.end()},
                    .state = source.numbers(path("state")),
                    .delay = narrow(source.integers(path("delay"))),
                    .collision_time = narrow(source.integers(path("collision_time")))};
  if (source.has(path("step"))) {
    result.input = source.numbers(path("input"));
    for (const std::int64_t phase : source.integers(path("phase")))
      result.phase.push_back(static_cast<PathPhase>(phase));
  }
  const std::size_t samples = result.samples(), steps = result.steps();
  if (steps != samples && steps + 1 != samples) {
    source.fail("found " + std::to_string(steps) + " steps between " + std::to_string(samples) + " samples",
                counterexample_path(std::to_string(requirement)));
  }
  return result;
}

/// Reads the greatest risk of a region.
void take_risk(const RequirementSpec& spec, double risk, const FieldSource& source,
               ResultRequirement& requirement) {
  const auto number = static_cast<float>(risk);
  if (!(number >= 0) || number > 1) source.fail("no probability", counterexample_path("risk"));
  requirement.is_risk = true;
  requirement.least_delay = std::bit_cast<std::int32_t>(number);
  requirement.risk = compared_risk(spec, requirement.least_delay, source.number("/risk", "rate"));
}

}  // namespace

bool is_followed(RequirementKind kind) {
  return kind == RequirementKind::min_delay || kind == RequirementKind::invariant ||
         kind == RequirementKind::min_silence;
}

std::string counterexample_path(const std::string& name) {
  return "/counterexample/" + name;
}

std::string counterexample_path(std::size_t requirement, const std::string& name) {
  return counterexample_path(std::to_string(requirement) + "/" + name);
}

std::vector<ResultRequirement> read_requirement_values(const ProblemSpec& spec, const FieldSource& source) {
  if (spec.requirements.empty()) return {};
  const auto of_each = [&source](const char* name) { return source.integers(counterexample_path(name)); };
  const auto holds = of_each("holds"), cells = of_each("cells"), failing = of_each("failing");
  const auto delays = of_each("least_delay"), reached = of_each("reached_side");
  const auto ends = of_each("end"), left = of_each("left_side"), seen = of_each("seen");
  const std::vector<double> risks =
      spec.risk ? source.numbers(counterexample_path("risk")) : std::vector<double>();
  std::vector<ResultRequirement> result;
  for (std::size_t r = 0; r < spec.requirements.size(); ++r) {
    ResultRequirement& requirement =
        result.emplace_back(ResultRequirement{.name = spec.requirements[r].name,
                                              .holds = holds[r] != 0,
                                              .cells = static_cast<std::uint64_t>(cells[r]),
                                              .failing = static_cast<std::uint64_t>(failing[r]),
                                              .least_delay = static_cast<std::int32_t>(delays[r]),
                                              .reached_side = side_of_number(reached[r])});
    const bool has_path = source.has(counterexample_path(r, "sample"));
    if (ends[r] == 0 && left[r] != 0)
      source.fail("a side without a counterexample", counterexample_path("left_side"));
    if (ends[r] == 0 && seen[r] != ResultPath::kNotFollowed)
      source.fail("followed without a counterexample", counterexample_path("seen"));
    if (has_path != (ends[r] != 0))
      source.fail("an end without a counterexample, or the other way round", counterexample_path("end"));
    const bool is_risk = spec.requirements[r].kind == RequirementKind::max_risk;
    if (is_risk && delays[r] != 0)
      source.fail("a delay where a risk is asked for", counterexample_path("least_delay"));
    if (is_risk) take_risk(spec.requirements[r], risks[r], source, requirement);
    if (spec.risk && !requirement.is_risk && risks[r] != 0)
      source.fail("a risk where none is asked for", counterexample_path("risk"));
    if (!has_path) continue;
    requirement.path = read_path(source, r);
    if (is_risk) {
      std::vector<std::int32_t>& path_delays = requirement.path->delay;
      if (std::ranges::any_of(path_delays, [](std::int32_t delay) { return delay != 0; }))
        source.fail("a delay where a risk is asked for", counterexample_path(r, "delay"));
      std::ranges::fill(path_delays, requirement.least_delay);
    }
    requirement.path->end = static_cast<PathEnd>(ends[r] - 1);
    requirement.path->left_side = side_of_number(left[r]);
    requirement.path->seen = static_cast<std::int32_t>(seen[r]);
  }
  return result;
}

}  // namespace coordreq
