#include "answers/countdown/safe_sides.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

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

/// The position of a cell in a table, or in a term, under the first choice of its inputs.
std::int64_t first_position(const UniformGrid& grid, const TransitionTable& table,
                            const std::vector<std::int64_t>& state_stride, std::int64_t x) {
  std::int64_t position = 0;
  for (const std::int32_t i : table.states) {
    if (state_stride[at(i)] != 0) position += grid.index(x, at(i)) * state_stride[at(i)];
  }
  return position;
}

}  // namespace

SafeSides::SafeSides(const AnalysisContext& context)
    : abstraction_(*context.abstraction), engine_(*context.engine), grid_(abstraction_.grid) {
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    if (is_safe(grid_[i], false) || is_safe(grid_[i], true)) add(i);
  }
  choose_outward();
  for (Side& side : sides_) fill_ahead(side);
}

void SafeSides::make_ready(ThreadTeam& team) {
  for (Side& side : sides_) fill(side, team);
}

bool SafeSides::is_below(std::size_t dimension) const {
  return is_safe(grid_[dimension], false) && !is_safe(grid_[dimension], true);
}

bool SafeSides::knows_ahead() const {
  return std::ranges::none_of(sides_, [](const Side& side) { return side.ahead.empty(); });
}

void SafeSides::find_ahead(const RowPosition& position, ConstRow cells, MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  for (const Side& side : sides_) add_row(side, side.ahead, position, result);
  for (const Side& side : sides_) {
    const Word* const back = side.back.data() + choice(side, position) * side.words;
    for (std::size_t w = 0; w < result.size(); ++w) result[w] &= ~back[side.is_along ? w : 0];
  }
  for (std::size_t w = 0; w < result.size(); ++w) result[w] &= cells[w];
}

bool SafeSides::outward_leads_ahead(const RowPosition& position, ConstRow cells) const {
  bool all = true;
  for_each_bit(cells, [&](std::int64_t lane) {
    const std::int64_t x = position.row * grid_.row_length() + lane;
    std::int64_t further = 0;
    for (const Side& side : sides_) {
      const IndexRange raw = abstraction_.raw(side.dimension, x, outward_);
      if (passes(side.dimension, raw)) return;
      further += gain(side, x, raw);
    }
    all = all && further > 0;
  });
  return all;
}

void SafeSides::find_near(const RowPosition& position, ConstRow cells, MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  for (const Side& side : sides_) {
    if (!side.near.empty()) {
      add_row(side, side.near, position, result);
      continue;
    }
    for_each_bit(cells, [&](std::int64_t lane) {
      const Word bit = Word{1} << (lane % CellSet::kWordBits);
      if ((result[at(lane / CellSet::kWordBits)] & bit) != 0) return;
      if (is_near(side, position.row * grid_.row_length() + lane)) set_lane(lane, result.data());
    });
  }
  for (std::size_t w = 0; w < result.size(); ++w) result[w] &= cells[w];
}

void SafeSides::find_leaving_outward(const RowPosition& position, ConstRow cells, MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  for (const Side& side : sides_) {
    if (!side.outward.empty()) {
      add_row(side, side.outward, position, result);
      continue;
    }
    for_each_bit(cells, [&](std::int64_t lane) {
      if (leaves(side, position.row * grid_.row_length() + lane, outward_)) set_lane(lane, result.data());
    });
  }
  for (std::size_t w = 0; w < result.size(); ++w) result[w] &= cells[w];
}

void SafeSides::add_row(const Side& side, const std::vector<Word>& kept, const RowPosition& position,
                        MutableRow result) const {
  const Word* const row = kept.data() + choice(side, position) * side.words;
  for (std::size_t w = 0; w < result.size(); ++w) result[w] |= row[side.is_along ? w : 0];
}

void SafeSides::find_leaving(std::size_t side, std::size_t input_choice, const RowPosition& position,
                             ConstRow cells, MutableRow result) const {
  std::fill(result.begin(), result.end(), 0);
  const Side& chosen = sides_[side];
  const std::int64_t u = chosen.input_choices[input_choice], first = position.row * grid_.row_length();
  if (!chosen.is_along) {
    if (passes(chosen.dimension, abstraction_.raw(chosen.dimension, first, u)))
      std::copy(cells.begin(), cells.end(), result.begin());
    return;
  }
  const TransitionTable& table = abstraction_.tables[chosen.dimension];
  std::vector<std::int64_t> inputs(abstraction_.inputs.size()), states(grid_.size());
  for (std::size_t j = 0; j < inputs.size(); ++j) inputs[j] = abstraction_.inputs.index(u, j);
  for (std::size_t i = 0; i < states.size(); ++i) states[i] = grid_.index(first, i);
  // Along rows of one dimension nothing but its index changes.
  const bool is_simple = grid_.across() + 1 == grid_.size();
  for_each_bit(cells, [&](std::int64_t lane) {
    if (is_simple) states.back() = lane;
    const auto state = [&](std::size_t i) { return is_simple ? states[i] : grid_.index(first + lane, i); };
    if (passes(chosen.dimension,
               table.range(chosen.dimension, state, [&](std::size_t j) { return inputs[j]; })))
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
  side.input_choices = numbers(counts, strides);
  counts.clear();
  strides.clear();
  for (std::size_t j = 0; j < abstraction_.inputs.size(); ++j) {
    if (std::ranges::find(table.inputs, static_cast<std::int32_t>(j)) != table.inputs.end()) continue;
    counts.push_back(abstraction_.inputs[j].count());
    strides.push_back(abstraction_.inputs.stride(j));
  }
  side.rests = numbers(counts, strides);
  if (table.is_sum()) add_choices(side);
  side.is_along =
      std::any_of(table.states.begin(), table.states.end(), [&](auto j) { return at(j) >= grid_.across(); });
  side.words = side.is_along ? engine_.row_words() : 1;
}

void SafeSides::add_choices(Side& side) const {
  const TransitionTable& table = abstraction_.tables[side.dimension];
  std::vector<std::int64_t> counts, counts_of_base, strides_of_base;
  std::vector<std::vector<std::int64_t>> strides(table.terms.size() + 1);
  for (const std::int32_t j : table.inputs) {
    const std::int64_t count = abstraction_.inputs[at(j)].count();
    if (std::ranges::all_of(table.terms, [&](const auto& term) { return term.input_stride[at(j)] == 0; })) {
      counts_of_base.push_back(count);
      strides_of_base.push_back(table.input_stride[at(j)]);
      continue;
    }
    counts.push_back(count);
    strides.front().push_back(table.input_stride[at(j)]);
    for (std::size_t t = 0; t < table.terms.size(); ++t)
      strides[t + 1].push_back(table.terms[t].input_stride[at(j)]);
  }
  side.of_base = numbers(counts_of_base, strides_of_base);
  Odometer choice(counts);
  do {
    for (const std::vector<std::int64_t>& one : strides)
      side.of_terms.push_back(
          std::inner_product(one.begin(), one.end(), choice.indices().begin(), std::int64_t{0}));
  } while (choice.advance());
}

void SafeSides::choose_outward() {
  outward_ = abstraction_.inputs.count() - 1;
  const RowShare::Range local = local_rows(engine_.share(), engine_.rows());
  if (local.begin == local.end) return;
  std::int64_t x = (local.begin + (local.end - local.begin) / 2) * grid_.row_length();
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
  const std::int64_t count = choices(side);
  if (count == 0) return;
  side.near.assign(at(count) * side.words, 0);
  side.outward = side.near;
  team.for_each(count, 16, [&](ThreadTeam::Range range, int) {
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      const std::int64_t first = first_cell(side, k);
      const std::size_t position = at(k) * side.words;
      fill_row(side, first, side.near.data() + position, [&](std::int64_t x) { return is_near(side, x); });
      fill_row(side, first, side.outward.data() + position,
               [&](std::int64_t x) { return leaves(side, x, outward_); });
    }
  });
}

void SafeSides::fill_ahead(Side& side) const {
  const TransitionTable& table = abstraction_.tables[side.dimension];
  const std::int64_t count = table.is_sum() ? 0 : choices(side);
  side.ahead.assign(at(count) * side.words, 0);
  side.back = side.ahead;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t first = first_cell(side, k);
    const std::size_t position = at(k) * side.words;
    fill_row(side, first, side.ahead.data() + position,
             [&](std::int64_t x) { return least_gain(side, x) > 0; });
    fill_row(side, first, side.back.data() + position,
             [&](std::int64_t x) { return least_gain(side, x) < 0; });
  }
}

std::int64_t SafeSides::choices(const Side& side) const {
  const RowSlices& slices = engine_.slices()[side.dimension];
  const std::int64_t count = slices.size() / slices.input_combinations;
  const std::int64_t looks =
      count * (side.is_along ? grid_.row_length() : 1) * std::ssize(side.input_choices);
  return looks > engine_.rows() * grid_.row_length() ? 0 : count;
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

std::size_t SafeSides::choice(const Side& side, const RowPosition& position) const {
  const RowSlices& slices = engine_.slices()[side.dimension];
  return at(slices.base(position) / slices.input_combinations);
}

bool SafeSides::is_near(const Side& side, std::int64_t x) const {
  const TransitionTable& table = abstraction_.tables[side.dimension];
  const auto state = [&](std::size_t i) { return grid_.index(x, i); };
  return passes(side.dimension, table.is_sum()
                                    ? around_sums(side, x)
                                    : table.around_inputs(side.dimension, state, side.input_choices.size()));
}

IndexRange SafeSides::around_sums(const Side& side, std::int64_t x) const {
  const TransitionTable& table = abstraction_.tables[side.dimension];
  const std::int64_t base = first_position(grid_, table, table.state_stride, x) - table.before;
  std::vector<std::int64_t> positions;  // in each term
  for (const TransitionTerm& term : table.terms)
    positions.push_back(first_position(grid_, table, term.state_stride, x));
  std::int64_t lower = INT64_MAX, upper = INT64_MIN;
  for (std::size_t k = 0; k < side.of_terms.size(); k += table.terms.size() + 1) {
    const std::int64_t* const lowers = table.base_lower.data() + base + side.of_terms[k];
    const std::int64_t* const uppers = table.base_upper.data() + base + side.of_terms[k];
    std::int64_t least = INT64_MAX, greatest = INT64_MIN;
    for (const std::int64_t other : side.of_base) {
      least = std::min(least, lowers[other]);
      greatest = std::max(greatest, uppers[other]);
    }
    for (std::size_t t = 0; t < table.terms.size(); ++t) {
      const std::size_t position = at(positions[t] + side.of_terms[k + 1 + t]);
      least += table.terms[t].lower[position];
      greatest += table.terms[t].upper[position];
    }
    lower = std::min(lower, least);
    upper = std::max(upper, greatest);
  }
  const std::int64_t offset =
      table.shift ? grid_.index(x, side.dimension) << TransitionTable::kFractionBits : 0;
  return TransitionTable::sum_range(lower + offset, upper + offset);
}

std::int64_t SafeSides::least_gain(const Side& side, std::int64_t x) const {
  const TransitionTable& table = abstraction_.tables[side.dimension];
  REQUIRES(!table.is_sum());
  const std::size_t first = at(first_position(grid_, table, table.state_stride, x) - table.before);
  IndexRange common = table.entries[first];
  for (std::size_t k = 1; k < side.input_choices.size(); ++k) {
    common.first = std::max(common.first, table.entries[first + k].first);
    common.last = std::min(common.last, table.entries[first + k].last);
  }
  return gain(side, x, table.shift ? moved(common, grid_.index(x, side.dimension)) : common);
}

bool SafeSides::passes(std::size_t dimension, IndexRange raw) const {
  const GridDimension& target = grid_[dimension];
  return (raw.first < 0 && is_safe(target, false)) || (raw.last >= target.count && is_safe(target, true));
}

}  // namespace coordreq
