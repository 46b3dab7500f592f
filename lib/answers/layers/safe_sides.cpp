#include "answers/layers/safe_sides.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

/// A side is looked at once for many rows if so many have a choice of states in common, at least.
constexpr std::int64_t kFewestRowsOfChoice = 8;

bool is_safe(const GridDimension& dimension, bool above) {
  return traits(above ? dimension.above : dimension.below).is_only_safe();
}

void set_lane(std::int64_t lane, Word* row) {
  row[lane / CellSet::kWordBits] |= Word{1} << (lane % CellSet::kWordBits);
}

/// The sums of index times stride, for all choices of indices; the last one is the fastest.
std::vector<std::int64_t> numbers(const std::vector<std::int64_t>& counts,
                                  const std::vector<std::int64_t>& strides) {
  std::vector<std::int64_t> result;
  Odometer indices(counts);
  do {
    std::int64_t number = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) number += indices.indices()[k] * strides[k];
    result.push_back(number);
  } while (indices.advance());
  return result;
}

}  // namespace

SafeSides::SafeSides(const AnalysisContext& context, ThreadTeam& team)
    : abstraction_(*context.abstraction), engine_(*context.engine), grid_(abstraction_.grid) {
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    if (is_safe(grid_[i], false) || is_safe(grid_[i], true)) add(i);
  }
  choose_outward();
  for (Side& side : sides_) fill(side, team);
}

bool SafeSides::is_below(std::size_t dimension) const {
  return is_safe(grid_[dimension], false) && !is_safe(grid_[dimension], true);
}

void SafeSides::find_near(const RowPlace& place, ConstRow cells, MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  for (const Side& side : sides_) {
    if (!side.near.empty()) {
      add_row(side, side.near, place, result);
      continue;
    }
    for_each_bit(cells, [&](std::int64_t lane) {
      if (is_near(side, place.row * grid_.row_length() + lane)) set_lane(lane, result.data());
    });
  }
  for (std::size_t w = 0; w < result.size(); ++w) result[w] &= cells[w];
}

void SafeSides::find_leaving_outward(const RowPlace& place, ConstRow cells, MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  for (const Side& side : sides_) {
    if (!side.outward.empty()) {
      add_row(side, side.outward, place, result);
      continue;
    }
    for_each_bit(cells, [&](std::int64_t lane) {
      if (leaves(side, place.row * grid_.row_length() + lane, outward_)) set_lane(lane, result.data());
    });
  }
  for (std::size_t w = 0; w < result.size(); ++w) result[w] &= cells[w];
}

void SafeSides::add_row(const Side& side, const std::vector<Word>& kept, const RowPlace& place,
                        MutableRow result) const {
  const Word* const row = kept.data() + choice(side, place) * side.words;
  for (std::size_t w = 0; w < result.size(); ++w) result[w] |= row[side.is_along ? w : 0];
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
  side.parts = numbers(counts, strides);
  counts.clear();
  strides.clear();
  for (std::size_t j = 0; j < abstraction_.inputs.size(); ++j) {
    if (std::ranges::find(table.inputs, static_cast<std::int32_t>(j)) != table.inputs.end()) continue;
    counts.push_back(abstraction_.inputs[j].count());
    strides.push_back(abstraction_.inputs.stride(j));
  }
  side.rests = numbers(counts, strides);
  side.is_along =
      std::any_of(table.states.begin(), table.states.end(), [&](auto j) { return at(j) >= grid_.across(); });
  side.words = side.is_along ? engine_.row_words() : 1;
}

void SafeSides::choose_outward() {
  outward_ = abstraction_.inputs.count() - 1;
  const RowShare::Range own = own_rows(engine_.share(), engine_.rows());
  if (own.begin == own.end) return;
  std::int64_t x = (own.begin + (own.end - own.begin) / 2) * grid_.row_length();
  bool is_first = true;
  engine_.posts().shape.for_each_run([&](std::int64_t begin, std::int64_t count) {
    if (std::exchange(is_first, false)) x += begin + count / 2;
  });
  for (const Side& side : sides_) {
    const auto reach = [&](std::int64_t u) -> std::int64_t {
      const IndexRange raw = abstraction_.raw(side.dimension, x, u);
      return is_below(side.dimension) ? -raw.first : raw.last;
    };
    for (const std::int32_t j : side.inputs) {
      const std::int64_t stride = abstraction_.inputs.stride(at(j));
      const std::int64_t least = outward_ - abstraction_.inputs.index(outward_, at(j)) * stride;
      const std::int64_t greatest = least + (abstraction_.inputs[at(j)].count() - 1) * stride;
      const std::int64_t further = reach(least) - reach(greatest);
      outward_ = further > 0 || (further == 0 && is_below(side.dimension)) ? least : greatest;
    }
  }
}

void SafeSides::fill(Side& side, ThreadTeam& team) const {
  const RowSlices& slices = engine_.slices()[side.dimension];
  const std::int64_t choices = slices.size() / slices.input_combinations;
  if (choices * kFewestRowsOfChoice > engine_.rows()) return;
  side.near.assign(at(choices) * side.words, 0);
  side.outward = side.near;
  team.for_each(choices, 16, [&](ThreadTeam::Range range, int) {
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      const std::int64_t first = first_cell(side, k);
      const std::size_t position = at(k) * side.words;
      fill_row(side, first, side.near.data() + position, [&](std::int64_t x) { return is_near(side, x); });
      fill_row(side, first, side.outward.data() + position,
               [&](std::int64_t x) { return leaves(side, x, outward_); });
    }
  });
}

std::int64_t SafeSides::first_cell(const Side& side, std::int64_t choice) const {
  const RowSlices& slices = engine_.slices()[side.dimension];
  const std::int64_t position = choice * slices.input_combinations + slices.before;
  std::int64_t row = 0;
  for (std::size_t i = 0; i < grid_.across(); ++i) {
    const std::int64_t stride = slices.state_stride[i];
    if (stride > 0) row += position / stride % grid_[i].count * grid_.row_stride(i);
  }
  return row * grid_.row_length();
}

template <class Test>
void SafeSides::fill_row(const Side& side, std::int64_t first, Word* row, const Test& test) const {
  if (!side.is_along) {
    if (test(first)) *row = ~Word{0};
    return;
  }
  engine_.posts().shape.for_each_run([&](std::int64_t begin, std::int64_t count) {
    for (std::int64_t lane = begin; lane < begin + count; ++lane) {
      if (test(first + lane)) set_lane(lane, row);
    }
  });
}

std::size_t SafeSides::choice(const Side& side, const RowPlace& place) const {
  const RowSlices& slices = engine_.slices()[side.dimension];
  return at(slices.base(place) / slices.input_combinations);
}

bool SafeSides::is_near(const Side& side, std::int64_t x) const {
  const TransitionTable& table = abstraction_.tables[side.dimension];
  if (table.is_sum())
    return std::ranges::any_of(side.parts, [&](std::int64_t part) { return leaves(side, x, part); });
  const auto state = [&](std::size_t i) { return grid_.index(x, i); };
  return passes(side.dimension, table.around_inputs(side.dimension, state, side.parts.size()));
}

bool SafeSides::passes(std::size_t dimension, IndexRange raw) const {
  const GridDimension& target = grid_[dimension];
  return (raw.first < 0 && is_safe(target, false)) || (raw.last >= target.count && is_safe(target, true));
}

}  // namespace coordreq
