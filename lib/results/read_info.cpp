#include "results/read_info.hpp"

#include <nlohmann/json.hpp>

#include "answers/plan.hpp"
#include "answers/step_codes.hpp"
#include "base/json.hpp"
#include "model/outside.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"
#include "spec/set_value.hpp"
#include "spec/units.hpp"

namespace coordreq {
namespace {

Json axis_json(const std::string& name, const std::string& unit, std::int64_t points, const Rational& first,
               const Rational& last) {
  return {{"name", name},
          {"unit", unit.empty() ? "" : udunits_spelling(unit)},
          {"points", points},
          {"first", nearest_double(first)},
          {"last", nearest_double(last)}};
}

void add_header(const ResultsReader& results, Json& info) {
  const StoredAttributes& attributes = results.attributes();
  info["file"] = results.path();
  info["name"] = attributes.title;
  info["coordreq_version"] = attributes.coordreq_version;
  info["git_sha1"] = attributes.git_sha1;
  info["spec_sha256"] = attributes.spec_sha256;
  if (!attributes.controller_sha256.empty()) info["controller_sha256"] = attributes.controller_sha256;
  info["guarantee"] = attributes.guarantee;
  info["period"] = attributes.period;
  info["period_unit"] = attributes.period_unit;
  info["connection_delay"] = attributes.connection_delay;
}

void add_axes(const ResultsReader& results, Json& info) {
  info["states"] = Json::array();
  for (std::size_t i = 0; i < results.grid().size(); ++i) {
    const StateSpec& state = results.spec().states[i];
    const GridSpec& grid = state.grid;
    info["states"].push_back(axis_json(state.name, state.unit, grid.count, grid.first, grid.last()));
    info["states"].back()["outside"] = {{"below", outside_name(state.below)},
                                        {"above", outside_name(state.above)}};
  }
  info["inputs"] = Json::array();
  for (const InputSpec& input : results.spec().inputs) {
    const auto points = static_cast<std::int64_t>(input.values.size());
    info["inputs"].push_back(
        axis_json(input.name, input.unit, points, input.values.front(), input.values.back()));
  }
  info["cells"] = results.grid().cells();
}

void add_best_states(const ResultsReader& results, Json& info) {
  if (!is_looked_at(results)) return;
  for (const AnswerPolicy& policy : headline_policies(results.spec())) {
    const std::vector<StoredPartition> sizes =
        read_partition_values(results.spec(), results, policy.kind->prefix());
    for (std::size_t p = 0; p < sizes.size(); ++p) {
      Json& entry = info["partitions"][p];
      (policy.name.empty() ? entry : entry[policy.name])["best_state"] =
          best_state_json(results, policy, p, sizes[p]);
    }
  }
}

}  // namespace

bool is_looked_at(const ResultsReader& results) {
  const std::size_t arrays = results.partitions().size() * headline_policies(results.spec()).size();
  return results.grid().cells() <= kMostCellsLookedAt / static_cast<std::int64_t>(arrays);
}

std::int64_t best_cell(const ResultsReader& results, const AnswerPolicy& policy, std::size_t p,
                       const StoredPartition& sizes) {
  const bool is_finite = sizes.layer_sizes.size() > 2;
  if (sizes.truncated() || (!is_finite && sizes.layer_sizes.back() == 0)) return -1;
  return first_largest(results.grid(), [&](const CellBlock& block) {
    std::vector<std::int32_t> steps = results.values(policy.kind->layered, p, block);
    for (std::int32_t& value : steps) {
      if (!is_finite && value != kUnbounded) value = -1;
    }
    return steps;
  });
}

Json best_state_json(const ResultsReader& results, const AnswerPolicy& policy, std::size_t p,
                     const StoredPartition& sizes) {
  const UniformGrid& grid = results.grid();
  const std::int64_t cell = best_cell(results, policy, p, sizes);
  if (cell < 0) return {};
  Json json = Json::object();
  for (std::size_t i = 0; i < grid.size(); ++i)
    json[grid[i].name] = nearest_double(grid[i].point(grid.index(cell, i)));
  return json;
}

Json read_info(const ResultsReader& results) {
  Json info;
  add_header(results, info);
  add_axes(results, info);
  for (const Answer& answer : all_answers()) {
    if (answer.describe != nullptr) answer.describe(results.spec(), results, info);
  }
  add_best_states(results, info);
  info["datasets"] = results.datasets();
  info["spec"] = parse_json(without_comments(results.spec().text));
  return info;
}

}  // namespace coordreq
