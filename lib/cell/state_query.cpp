#include "cell/state_query.hpp"

#include <utility>

#include "spec/problem_spec.hpp"

namespace coordreq {

std::vector<const Field*> asked_fields(const ResultsReader& results) {
  std::vector<const Field*> fields;
  for (const Field& field : results.fields()) {
    if (!field.shown.asked.empty()) fields.push_back(&field);
  }
  return fields;
}

StateAnswer StateQuery::at(std::vector<Rational> state) {
  StateAnswer answer;
  answer.location = locate(results_.grid(), state);
  answer.state = std::move(state);
  if (answer.location.kind != Location::Kind::cell) return answer;
  const std::int64_t cell = answer.location.cell;
  const CellBlock block = one_cell(results_.grid(), cell);
  answer.safe = results_.safe(block).front() != 0;
  answer.invariant = results_.invariant(block).front() != 0;
  answer.collision_time = results_.collision_time(block).front();
  for (std::size_t p = 0; p < results_.partitions().size(); ++p) {
    answer.partitions.push_back({.delay = results_.delay(p, block).front(),
                                 .trigger = results_.trigger(p, block).front(),
                                 .actions = controller_.actions(p, cell),
                                 .approach = {}});
    if (results_.spec().goal) answer.partitions.back().approach = approach_at(p, cell);
  }
  if (results_.has_coalition()) answer.coalition = coalition_at(block);
  if (const auto& network = results_.spec().network) {
    for (const std::uint8_t safe : results_.network_safe(0, network->modes.size(), block))
      answer.safe_modes.push_back(safe != 0);
  }
  if (results_.spec().coordination.convention) answer.convention = controller_.convention(cell);
  for (const Field* const field : asked_fields(results_))
    answer.others.push_back(results_.values(*field, std::nullopt, block).front());
  return answer;
}

StateAnswer::Approach StateQuery::approach_at(std::size_t partition, std::int64_t cell) {
  const CellBlock block = one_cell(results_.grid(), cell);
  const auto value = [&](const char* path) {
    return results_.values(results_.field(path), partition, block).front();
  };
  return {.delay = value("/approach_delay"),
          .trigger = value("/approach_trigger"),
          .actions = controller_.approach_actions(partition, cell)};
}

StateAnswer::Coalition StateQuery::coalition_at(const CellBlock& block) const {
  StateAnswer::Coalition result{.partition = results_.coalition(block).front()};
  for (std::size_t pair = 0; pair < results_.pairs().size(); ++pair) {
    if (results_.critical_pair(pair, block).front() != 0) result.critical_pairs.push_back(pair);
  }
  return result;
}

CellBox box_of_cell(const UniformGrid& grid, std::int64_t cell) {
  CellBox box;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Rational centre = grid[i].point(grid.index(cell, i));
    box.centre.push_back(centre);
    box.lower.push_back(centre - grid[i].radius());
    box.upper.push_back(centre + grid[i].radius());
  }
  return box;
}

}  // namespace coordreq
