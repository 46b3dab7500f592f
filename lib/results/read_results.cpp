#include "results/read_results.hpp"

#include "results/results_reader.hpp"
#include "spec/unit_text.hpp"

namespace coordreq {
namespace {

ResultInfo::Axis axis_of(const std::string& name, const std::string& unit, const Rational& first,
                         const Rational& last, std::uint64_t points) {
  return {name, unit.empty() ? "" : udunits_spelling(unit), points, nearest_double(first),
          nearest_double(last)};
}

void add_axes(const ProblemSpec& spec, ResultInfo& info) {
  info.cells = 1;
  for (const StateSpec& state : spec.states) {
    const GridSpec& grid = state.grid;
    const Rational length = grid.step * Rational(static_cast<long>(grid.count - 1));
    info.states.push_back(axis_of(state.name, state.unit, grid.first, Rational(grid.first + length),
                                  static_cast<std::uint64_t>(grid.count)));
    info.cells *= info.states.back().points;
  }
  for (const InputSpec& input : spec.inputs) {
    info.inputs.push_back(
        axis_of(input.name, input.unit, input.values.front(), input.values.back(), input.values.size()));
  }
}

void add_attributes(const StoredAttributes& attributes, ResultInfo& info) {
  info.name = attributes.title;
  info.coordreq_version = attributes.coordreq_version;
  info.git_sha1 = attributes.git_sha1;
  info.spec_sha256 = attributes.spec_sha256;
  info.guarantee = attributes.guarantee;
  info.period = attributes.period;
  info.period_unit = attributes.period_unit;
  info.controller_sha256 = attributes.controller_sha256;
  info.safe_cells = attributes.safe_cells;
  info.invariant_cells = attributes.invariant_cells;
  info.connection_delay = attributes.connection_delay;
}

ResultInfo::Coalition coalition_of(const ResultsReader& results) {
  ResultInfo::Coalition coalition{.horizon = *results.spec().coordination.horizon,
                                  .cells = results.attributes().coalition_cells,
                                  .critical_pairs = {}};
  const std::vector<std::int64_t>& cells = results.attributes().critical_pair_cells;
  for (std::size_t i = 0; i < cells.size(); ++i)
    coalition.critical_pairs.emplace_back(results.pairs()[i], cells[i]);
  return coalition;
}

}  // namespace

ResultInfo read_info(const std::string& path, std::optional<std::uint64_t> max_memory) {
  const ResultsReader results(path, max_memory);
  const ProblemSpec& spec = results.spec();
  ResultInfo info{.path = path};
  add_attributes(results.attributes(), info);
  add_axes(spec, info);
  for (const StoredPartition& partition : results.partitions())
    info.partitions.push_back({partition.name, partition.fixed_point_index, partition.layer_sizes});
  if (results.has_coalition()) info.coalition = coalition_of(results);
  for (std::size_t mode = 0; mode < results.attributes().network_cells.size(); ++mode)
    info.modes.push_back({spec.network->modes[mode].name, results.attributes().network_cells[mode]});
  info.requirements = results.requirements();
  info.datasets = results.datasets();
  return info;
}

}  // namespace coordreq
