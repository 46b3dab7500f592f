#include "cell/least_steps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "base/requires.hpp"
#include "cell/state_reader.hpp"
#include "model/locate.hpp"
#include "model/outside.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr const char* kLabel = "pair";

std::string label_of(const StateReader& reader, std::int64_t row) {
  for (const StateReader::Extra& extra : reader.extra()) {
    if (extra.name == kLabel && !extra.text().empty()) return extra.text();
  }
  return std::to_string(row);
}

std::vector<std::string> other_names(const StateReader& reader) {
  std::vector<std::string> names = reader.extra_names();
  std::erase(names, kLabel);
  return names;
}

}  // namespace

std::int32_t steps_of_pair(const ResultsReader& results, const Field& field, std::size_t partition,
                           const std::vector<Rational>& state, const std::string& where) {
  REQUIRES(field.kind == FieldKind::steps && field.axes.front() == "/partition");
  const UniformGrid& grid = results.grid();
  std::int64_t cell = 0;
  bool has_left_safely = false, is_unsafe = false;
  const Location location = locate(grid, state);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::int64_t k = location.index[i];
    const std::int64_t top = grid[i].count - 1;
    if (k < 0 || k > top) {
      const OutsideTraits& side = traits(k < 0 ? grid[i].below : grid[i].above);
      is_unsafe = is_unsafe || side.blocks;
      has_left_safely = has_left_safely || side.arrives;
    }
    cell += std::clamp<std::int64_t>(k, 0, top) * grid.stride(i);
  }
  if (location.kind == Location::Kind::off_grid) {
    const std::size_t i = location.dimension;
    throw UsageError(
        fmt::format("{} = {} is not a value of this discrete state", grid[i].name, to_text(state[i])), where);
  }
  if (is_unsafe) return kOutsideSafe;
  if (has_left_safely) return kUnbounded;
  return results.values(field, partition, one_cell(grid, cell)).front();
}

LeastSteps least_steps(const ResultsReader& results, const Field& field, std::size_t partition,
                       std::istream& pairs, const std::string& source, std::optional<std::int32_t> at_least,
                       const std::function<void(const std::vector<std::string>&)>& report) {
  StateReader reader(pairs, state_names(results.spec()), source);
  LeastSteps found;
  if (at_least) found.below = 0;
  report(other_names(reader));
  while (const std::optional<std::vector<Rational>> state = reader.next()) {
    report(other_names(reader));
    ++found.pairs;
    const std::int32_t steps = steps_of_pair(results, field, partition, *state, reader.location());
    if (found.pairs == 1 || steps < found.least) {
      found.least = steps;
      found.pair = label_of(reader, found.pairs);
    }
    if (at_least && steps < *at_least) ++*found.below;
  }
  if (found.pairs == 0)
    throw UsageError("no pairs, expected a line of column names and a line for each", source);
  return found;
}

}  // namespace coordreq
