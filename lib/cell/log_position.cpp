#include "cell/log_position.hpp"

#include <algorithm>

#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

void add_new(std::vector<std::int64_t>& list, std::int64_t index) {
  if (std::find(list.begin(), list.end(), index) == list.end()) list.push_back(index);
}

std::int64_t nearest_index(const GridDimension& dimension, const Rational& value) {
  return floor_to_int((value - dimension.first) / dimension.step + Rational(1, 2));
}

/// A value of a discrete state that is as good as one of its grid is that one.
Rational snapped(const GridDimension& dimension, const Rational& value) {
  if (!dimension.discrete) return value;
  const Rational point = dimension.point(nearest_index(dimension, value));
  return abs(value - point) <= LogLocator::slack(value, dimension.step) ? point : value;
}

}  // namespace

LogLocator::LogLocator(const SystemSpec& spec, CellPosts& posts) : spec_(spec), posts_(posts) {
  for (const GridDimension& dimension : posts.grid().dimensions())
    axes_.emplace_back(std::vector<GridDimension>{dimension});
}

Rational LogLocator::slack(const Rational& value, const Rational& step) {
  static const Rational kShare(1, 10'000'000);
  const Rational most = step / 4;  // of values that are large beside their step
  return std::min<Rational>(most, kShare * std::max<Rational>(abs(value), step));
}

LogPosition LogLocator::position(const LogRow& row, const std::vector<std::int64_t>& before) {
  const UniformGrid& grid = posts_.grid();
  const std::vector<Indices> kept = kept_after(row, before);
  LogPosition position{.state = row.state};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!row.is_given[i]) position.state[i] = grid[i].point(kept.front()[i]);
    position.state[i] = snapped(grid[i], position.state[i]);
    position.indices.push_back(indices(i, position.state[i]));
  }
  position.location = locate(grid, position.state);
  for (const Indices& indices : kept) add_cells(position, row.is_given, indices);
  return position;
}

LogLocator::Indices LogLocator::indices(std::size_t i, const Rational& value) const {
  const GridDimension& dimension = posts_.grid()[i];
  const auto index = [&](const Rational& near) { return locate(axes_[i], std::span(&near, 1)); };
  const Location location = index(value);
  if (location.kind == Location::Kind::off_grid) return {};
  Indices found = location.index;
  if (dimension.discrete) return found;
  const Rational off = slack(value, dimension.step);
  add_new(found, index(value - off).index.front());
  add_new(found, index(value + off).index.front());
  return found;
}

/// [alternative][dimension] indices of what memories keep, where the log does not say them.
std::vector<LogLocator::Indices> LogLocator::kept_after(const LogRow& row,
                                                        const std::vector<std::int64_t>& before) {
  std::vector<Indices> kept;
  for (const std::int64_t cell : before) {
    Indices alternative(row.state.size(), 0);
    posts_.move_to(cell);
    for (std::size_t i = 0; i < alternative.size(); ++i) {
      if (!row.is_given[i]) alternative[i] = posts_.raw(i, 0).first;
    }
    if (std::find(kept.begin(), kept.end(), alternative) == kept.end())
      kept.push_back(std::move(alternative));
  }
  if (kept.empty()) kept.emplace_back(row.state.size(), 0);
  return kept;
}

void LogLocator::add_cells(LogPosition& position, const std::vector<bool>& is_given,
                           const Indices& kept) const {
  const UniformGrid& grid = posts_.grid();
  Indices cells = {0};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Indices& indices = is_given[i] ? position.indices[i] : Indices{kept[i]};
    Indices longer;
    for (const std::int64_t cell : cells) {
      for (const std::int64_t k : indices) {
        if (k >= 0 && k < grid[i].count) longer.push_back(cell + k * grid.stride(i));
      }
    }
    cells = std::move(longer);
  }
  for (const std::int64_t cell : cells) add_new(position.cells, cell);
}

}  // namespace coordreq
