#include "results/readable_content.hpp"

#include <string>

namespace coordreq::sample {
namespace {

std::string spec_text(const Options& options) {
  const auto upper = [&options](std::size_t i, double first, double step) {
    return std::to_string(first + step * static_cast<double>(options.points[i] - 1));
  };
  return R"json({
  "coordreq": 1,
  "name": "sample",
  "states": [
    { "name": "x1", "lower": -1, "upper": )json" +
         upper(0, -1, 0.125) + R"json(, "step": 0.125, "unit": "m" },
    { "name": "x2", "lower": 0, "upper": )json" +
         upper(1, 0, 0.5) + R"json(, "step": 0.5, "unit": "seconds" },
    { "name": "heading", "lower": 0, "upper": )json" +
         upper(2, 0, 1) + R"json(, "step": 1 } ],
  "inputs": [
    { "name": "u1", "lower": -2, "upper": 2, "step": 1, "unit": "m/second" },
    { "name": "u2", "values": [-1, 0, 3], "unit": "rad" },
    { "name": "u3", "values": [0, 1] } ],
  "agents": [ { "name": "a", "inputs": ["u1"] }, { "name": "b", "inputs": ["u2"] },
              { "name": "c", "inputs": ["u3"] } ],
  "dynamics": { "time": "discrete", "period": 0.25, "unit": "seconds",
                "equations": { "x1": "x1 + u1", "x2": "4", "heading": "heading + u2 + u3" } },
  "safe": "x1 <= 1",
  "coordination": { "connection_delay": 2,
                    "partitions": [ { "name": "alone", "classes": [] }, { "classes": [["b", "c"]] } ] } }
)json";
}

}  // namespace

ResultContent readable_content(const Options& options) {
  ResultContent content = make_content(options);
  content.spec_text = spec_text(options);
  content.axes.push_back({"u3", "", {0, 1}, std::nullopt, false});
  if (!options.with_extras) return content;
  const std::uint64_t cells = cell_count(options);
  for (ResultPartition& partition : content.partitions) {
    // As many bounds as layers and one; all cells of the list in the first layer but one in the last.
    partition.layers->start.assign(partition.layer_sizes.size() + 1, cells / 2 - 1);
    partition.layers->start.front() = 0;
    partition.layers->start.back() = cells / 2;
  }
  content.partitions[1].actions[1].inputs = {"u2", "u3"};
  content.partitions[1].actions[1].actions = 6;
  content.controller->inputs = {"u1", "u2", "u3"};
  content.controller->actions = 30;
  content.abstraction.push_back({"heading", {"heading", "u2", "u3"}, {}, {}});
  for (std::uint64_t i = 0; i < options.points[2] * 6; ++i) {
    content.abstraction.back().first.push_back(static_cast<std::int32_t>(i) - 9);
    content.abstraction.back().last.push_back(static_cast<std::int32_t>(i));
  }
  return content;
}

}  // namespace coordreq::sample
