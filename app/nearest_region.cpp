#include "app/reports.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "export/tolerance_frontier.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Indices of the worst cell.
std::vector<std::int64_t> worst_index(const Json& state, const UniformGrid& grid) {
  std::vector<std::int64_t> index;
  for (const GridDimension& dimension : grid.dimensions()) {
    const double steps = (state[dimension.name].get<double>() - nearest_double(dimension.first)) /
                         nearest_double(dimension.step);
    index.push_back(std::clamp<std::int64_t>(std::llround(steps), 0, dimension.count - 1));
  }
  return index;
}

/// Whether there is a better and a worse side.
bool is_ordered(const GridDimension& dimension, const StateSpec& state) {
  return dimension.count > 1 && !dimension.periodic() && !state.discrete;
}

Json nearest_region(const Json& requirement, const ResultsReader& results) {
  const UniformGrid& grid = results.grid();
  const auto& partitions = results.partitions();
  const auto partition = std::find_if(partitions.begin(), partitions.end(), [&](const StoredPartition& one) {
    return one.name == requirement["partition"];
  });
  if (partition == partitions.end()) return {};
  const std::vector<std::int64_t> worst = worst_index(requirement["counterexample"]["state"], grid);
  Json found;
  std::int64_t least = INT64_MAX;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!is_ordered(grid[i], results.spec().states[i])) continue;
    for (const bool is_large_best : {true, false}) {
      ToleranceQuestion question{.partition = static_cast<std::size_t>(partition - partitions.begin()),
                                 .steps = requirement["min_delay"].get<std::int64_t>(),
                                 .axes = {{i, is_large_best}},
                                 .given = {}};
      for (std::size_t j = 0; j < grid.size(); ++j)
        if (j != i) question.given.push_back({j, worst[j]});
      const Tolerance tolerance = find_tolerance(results, question);
      if (tolerance.corners.empty()) continue;
      const std::int64_t distance = std::abs(tolerance.corners.front().front() - worst[i]);
      if (distance >= least) continue;
      least = distance;
      const Json answer = require_json(results, question, tolerance);
      found = {{"state", answer["over"][0]["state"]},
               {"best", answer["over"][0]["best"]},
               {"value", answer["corners"][0][0]}};
    }
  }
  return found;
}

}  // namespace

Json with_nearest_regions(const Json& summary, const std::string& results) {
  Json all = summary;
  std::optional<ResultsReader> reader;
  for (Json& entry : all["requirements"]) {
    if (entry["holds"] || entry["kind"] != "min_delay" || entry["min_delay"].is_null()) continue;
    if (entry["counterexample"].is_null() || entry["counterexample"]["state"].is_null()) continue;
    if (!reader) reader.emplace(results);
    entry["nearest"] = nearest_region(entry, *reader);
  }
  return all;
}

}  // namespace coordreq
