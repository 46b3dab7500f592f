#include "cell/state_query.hpp"

#include <utility>

#include "answers/field_table.hpp"
#include "answers/paths.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::vector<const Field*> query_fields(const ResultsReader& results) {
  std::vector<const Field*> fields;
  for (const Field& field : answer_fields(results.spec())) {
    if (!field.display.query.name.empty() && results.has(field.path))
      fields.push_back(&results.field(field.path));
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
  for (const char* const path : {paths::kSafe, paths::kInvariant, paths::kCollisionTime})
    read_values(path, block, answer);
  for (const Field* const field : query_fields_) read_values(field->path, block, answer);
  for (const AnswerPolicy& policy : controller_.policies()) {
    if (!policy.delay.empty()) read_values(policy.delay, block, answer);
    if (!policy.trigger.empty()) read_values(policy.trigger, block, answer);
    // In an aim that does not last the policy leaves all that coordination does (contract, section 5: P = C).
    const bool is_at_aim =
        !policy.aim.path.empty() && !policy.aim.lasts && answer.value(policy.aim.path) == 0;
    const std::size_t partitions = policy.is_by_agent ? 1 : results_.partitions().size();
    for (std::size_t p = 0; p < partitions; ++p) {
      const std::string& left = policy.is_on_request() ? policy.countdown() : policy.delay;
      const std::int32_t countdown = left.empty() ? 0 : answer.value(left, p);
      answer.actions[policy.name].push_back(is_at_aim ? controller_.actions(p, cell)
                                                      : controller_.actions(policy, p, cell, countdown));
    }
  }
  return answer;
}

void StateQuery::read_values(const std::string& path, const CellBlock& block, StateAnswer& answer) const {
  const Field& field = results_.field(path);
  std::vector<std::int32_t>& values = answer.values[path];
  const std::size_t entries = results_.leading_length(field);
  if (entries == 0) values = results_.values(field, std::nullopt, block);
  for (std::size_t i = 0; i < entries; ++i) values.push_back(results_.values(field, i, block).front());
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
