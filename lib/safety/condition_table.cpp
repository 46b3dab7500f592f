#include "safety/condition_table.hpp"

#include <algorithm>

#include "bitset/row_operations.hpp"
#include "safety/condition.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

RationalInterval exact_interval(const Rational& lower, const Rational& upper) {
  return {.lower = lower, .upper = upper};
}

Interval outward(const RationalInterval& q) {
  return {.lower = lower_double(q.lower), .upper = upper_double(q.upper)};
}

/// The box of every index of every variable, exactly and in doubles.
struct Boxes {
  std::vector<std::vector<RationalInterval>> exact;  // [slot][index]
  std::vector<std::vector<Interval>> fast;

  Boxes(const UniformGrid& grid, const InputSpace& inputs, Sampling sampling, const std::vector<bool>& used)
      : exact(grid.size() + inputs.size()), fast(exact.size()) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const Rational radius = sampling == Sampling::closed_cells ? grid[i].radius() : Rational(0);
      for (std::int64_t k = 0; used[i] && k < grid[i].count; ++k) {
        const Rational point = grid[i].point(k);
        exact[i].push_back(exact_interval(point - radius, point + radius));
      }
    }
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      for (std::size_t k = 0; used[grid.size() + i] && k < inputs[i].values.size(); ++k) {
        exact[grid.size() + i].push_back(exact_interval(inputs[i].values[k], inputs[i].values[k]));
      }
    }
    for (std::size_t slot = 0; slot < exact.size(); ++slot) {
      for (const RationalInterval& q : exact[slot]) fast[slot].push_back(outward(q));
    }
  }
};

/// Evaluates one bit of the table after the other; scratch of one thread.
class Filler {
 public:
  Filler(const Program& condition, const Boxes& boxes, const ConditionTable::Undecided& undecided)
      : decider_(condition),
        boxes_(boxes),
        undecided_(undecided),
        indices_(boxes.exact.size(), 0),
        fast_(boxes.exact.size()),
        exact_(boxes.exact.size()) {}

  void set(std::size_t slot, std::int64_t index) {
    indices_[slot] = index;
    fast_[slot] = boxes_.fast[slot][static_cast<std::size_t>(index)];
  }

  [[nodiscard]] bool holds() {
    const Truth truth = decider_.decide(std::span<const Interval>(fast_), [&] { return exact_box(); });
    return truth == Truth::undecided ? undecided_(indices_) : truth == Truth::yes;
  }

 private:
  std::span<const RationalInterval> exact_box() {
    for (std::size_t slot = 0; slot < exact_.size(); ++slot) {
      if (!boxes_.exact[slot].empty())
        exact_[slot] = boxes_.exact[slot][static_cast<std::size_t>(indices_[slot])];
    }
    return exact_;
  }

  ConditionDecider decider_;
  const Boxes& boxes_;
  const ConditionTable::Undecided& undecided_;
  std::vector<std::int64_t> indices_;
  std::vector<Interval> fast_;
  std::vector<RationalInterval> exact_;
};

}  // namespace

ConditionTable::ConditionTable(const Program& condition, const UniformGrid& grid, const InputSpace& inputs,
                               Sampling sampling, const Undecided& undecided, ThreadTeam& team)
    : grid_(&grid), input_space_(&inputs), state_stride_(grid.size(), 0), input_stride_(inputs.size(), 0) {
  std::vector<bool> used(grid.size() + inputs.size(), false);
  for (const std::uint32_t slot : condition.variables()) used[slot] = true;
  const std::size_t last = grid.size() - 1;

  std::int64_t rows = 1;
  for (std::size_t i = inputs.size(); i-- > 0;) {
    if (!used[grid.size() + i]) continue;
    inputs_.insert(inputs_.begin(), static_cast<std::int32_t>(i));
    input_stride_[i] = rows;
    rows *= inputs[i].count();
  }
  for (std::size_t i = last; i-- > 0;) {
    if (!used[i]) continue;
    states_.insert(states_.begin(), static_cast<std::int32_t>(i));
    state_stride_[i] = rows;
    rows *= grid[i].count;
  }
  bits_ = CellSet(rows, grid.row_length());

  const Boxes boxes(grid, inputs, sampling, used);
  const std::int64_t grain = std::max<std::int64_t>(1, 4096 / grid.row_length());
  team.for_each(rows, grain, [&](ThreadTeam::Range range, int) {
    Filler filler(condition, boxes, undecided);
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      for (const std::int32_t i : states_) filler.set(at(i), r / state_stride_[at(i)] % grid[at(i)].count);
      for (const std::int32_t i : inputs_) {
        filler.set(grid.size() + at(i), r / input_stride_[at(i)] % inputs[at(i)].count());
      }
      if (!used[last]) {
        if (filler.holds()) set_bits(bits_.row(r), 0, grid.row_length());
        continue;
      }
      for (std::int64_t k = 0; k < grid.row_length(); ++k) {
        filler.set(last, k);
        if (filler.holds()) set_bits(bits_.row(r), k, k + 1);
      }
    }
  });
}

std::int64_t ConditionTable::position(std::int64_t row, std::int64_t u) const {
  std::int64_t position = 0;
  for (const std::int32_t i : states_) {
    position += grid_->index(row * grid_->row_length(), at(i)) * state_stride_[at(i)];
  }
  for (const std::int32_t i : inputs_) position += input_space_->index(u, at(i)) * input_stride_[at(i)];
  return position;
}

std::span<const CellSet::Word> ConditionTable::row(std::int64_t row, std::int64_t u) const {
  return bits_.row(position(row, u));
}

}  // namespace coordreq
