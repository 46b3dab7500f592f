#include "answers/layers/safe_sides.hpp"

#include <algorithm>
#include <atomic>

#include "base/index.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

/// A side is looked at once for many rows if so many have a choice of states in common, at least.
constexpr std::int64_t kFewestRowsOfChoice = 8;
constexpr std::int64_t kNoRow = -1;

bool is_safe(const GridDimension& dimension, bool above) {
  return traits(above ? dimension.above : dimension.below).is_only_safe();
}

void set_lane(std::int64_t lane, Word* row) {
  row[lane / CellSet::kWordBits] |= Word{1} << (lane % CellSet::kWordBits);
}

}  // namespace

SafeSides::SafeSides(const AnalysisContext& context, const CellSet& cells, ThreadTeam& team)
    : abstraction_(*context.abstraction), engine_(*context.engine), grid_(abstraction_.grid) {
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    if (is_safe(grid_[i], false) || is_safe(grid_[i], true)) add(i);
  }
  for (Side& side : sides_) fill(side, cells, team);
}

std::size_t SafeSides::part_of(std::size_t side, std::int64_t u) const {
  std::int64_t part = 0;
  for (const std::int32_t j : sides_[side].inputs)
    part = part * abstraction_.inputs[at(j)].count() + abstraction_.inputs.index(u, at(j));
  return at(part);
}

void SafeSides::find_near(const RowPlace& place, ConstRow cells, MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  for (const Side& side : sides_) {
    if (side.near.empty()) {
      for_each_bit(cells, [&](std::int64_t lane) {
        if (is_near(side, place.row * grid_.row_length() + lane)) set_lane(lane, result.data());
      });
      continue;
    }
    const Word* const near = side.near.data() + choice(side, place) * side.words;
    for (std::size_t w = 0; w < result.size(); ++w) result[w] |= near[side.is_along ? w : 0];
  }
  for (std::size_t w = 0; w < result.size(); ++w) result[w] &= cells[w];
}

void SafeSides::find_leaving(std::size_t side, std::size_t part, const RowPlace& place, ConstRow cells,
                             MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  const Side& own = sides_[side];
  const std::int64_t u = own.parts[part], first = place.row * grid_.row_length();
  if (!own.is_along) {
    if (passes(own.dimension, abstraction_.raw(own.dimension, first, u)))
      std::copy(cells.begin(), cells.end(), result.begin());
    return;
  }
  const TransitionTable& table = abstraction_.tables[own.dimension];
  std::vector<std::int64_t> inputs(abstraction_.inputs.size()), states(grid_.size());
  for (std::size_t j = 0; j < inputs.size(); ++j) inputs[j] = abstraction_.inputs.index(u, j);
  for (std::size_t i = 0; i < states.size(); ++i) states[i] = grid_.index(first, i);
  // Along rows of one dimension nothing but its index changes.
  const bool is_simple = grid_.across() + 1 == grid_.size();
  for_each_bit(cells, [&](std::int64_t lane) {
    if (is_simple) states.back() = lane;
    const auto state = [&](std::size_t i) { return is_simple ? states[i] : grid_.index(first + lane, i); };
    if (passes(own.dimension, table.range(own.dimension, state, [&](std::size_t j) { return inputs[j]; })))
      set_lane(lane, result.data());
  });
}

void SafeSides::add(std::size_t i) {
  Side& side = sides_.emplace_back();
  side.dimension = i;
  const TransitionTable& table = abstraction_.tables[i];
  side.inputs = table.inputs;
  std::vector<std::int64_t> counts, strides;
  for (const std::int32_t j : table.inputs) {
    counts.push_back(abstraction_.inputs[at(j)].count());
    strides.push_back(abstraction_.inputs.stride(at(j)));
  }
  Odometer inputs(counts);
  do {
    std::int64_t part = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) part += inputs.indices()[k] * strides[k];
    side.parts.push_back(part);
  } while (inputs.advance());
  side.is_along =
      std::any_of(table.states.begin(), table.states.end(), [&](auto j) { return at(j) >= grid_.across(); });
  side.words = side.is_along ? engine_.row_words() : 1;
}

void SafeSides::fill(Side& side, const CellSet& cells, ThreadTeam& team) const {
  const RowSlices& slices = engine_.slices()[side.dimension];
  const std::int64_t choices = slices.size() / slices.input_combinations;
  if (choices * kFewestRowsOfChoice > engine_.rows()) return;
  // Any row that has a choice will do, so it does not matter which thread is the last to write.
  std::vector<std::int64_t> row_of(at(choices), kNoRow);
  for_each_own_row(team, engine_.share(), engine_.rows(), 256, [&](ThreadTeam::Range range, int) {
    for (RowPlace place(grid_, range.begin); place.row < range.end; place.advance(grid_)) {
      if (any_set(cells.row(place.row)))
        std::atomic_ref(row_of[choice(side, place)]).store(place.row, std::memory_order_relaxed);
    }
  });
  side.near.assign(at(choices) * side.words, 0);
  team.for_each(choices, 16, [&](ThreadTeam::Range range, int) {
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      if (row_of[at(k)] != kNoRow) fill_row(side, row_of[at(k)], side.near.data() + at(k) * side.words);
    }
  });
}

void SafeSides::fill_row(const Side& side, std::int64_t row, Word* near) const {
  const std::int64_t first = row * grid_.row_length();
  if (!side.is_along) {
    if (is_near(side, first)) *near = ~Word{0};
    return;
  }
  engine_.posts().shape.for_each_run([&](std::int64_t begin, std::int64_t count) {
    for (std::int64_t lane = begin; lane < begin + count; ++lane) {
      if (is_near(side, first + lane)) set_lane(lane, near);
    }
  });
}

std::size_t SafeSides::choice(const Side& side, const RowPlace& place) const {
  const RowSlices& slices = engine_.slices()[side.dimension];
  return at(slices.base(place) / slices.input_combinations);
}

bool SafeSides::is_near(const Side& side, std::int64_t x) const {
  const TransitionTable& table = abstraction_.tables[side.dimension];
  if (table.is_sum()) {
    return std::any_of(side.parts.begin(), side.parts.end(), [&](std::int64_t part) {
      return passes(side.dimension, abstraction_.raw(side.dimension, x, part));
    });
  }
  const auto state = [&](std::size_t i) { return grid_.index(x, i); };
  return passes(side.dimension, table.around_inputs(side.dimension, state, side.parts.size()));
}

bool SafeSides::passes(std::size_t dimension, IndexRange raw) const {
  const GridDimension& target = grid_[dimension];
  return (raw.first < 0 && is_safe(target, false)) || (raw.last >= target.count && is_safe(target, true));
}

}  // namespace coordreq
