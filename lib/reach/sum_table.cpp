#include "reach/tables.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "base/index.hpp"
#include "ranks/divided_loop.hpp"
#include "reach/box_choices.hpp"
#include "reach/scaled_number.hpp"
#include "reach/shift.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// Number of terms of at most kLargestTerm steps each that stay below the 2^30 that TransitionTable promises.
constexpr std::size_t kMostTerms = 14;

/// The table of one state of a group.
class SumTable {
 public:
  SumTable(const SystemSpec& spec, const TableShape& shape, const AffinePart& part, Abstraction& abstraction,
           std::size_t state)
      : grid_(abstraction.grid),
        part_(part),
        target_(grid_[state]),
        table_(abstraction.tables[state]),
        state_(state),
        step_(enclose(target_.step)),
        closed_(spec.abstraction.cells == Cells::closed) {
    // In discrete time Phi has one row, that of the state.
    const auto row = std::find(part.states.begin(), part.states.end(), static_cast<std::int32_t>(state));
    row_ = spec.dynamics.time == Time::discrete ? 0 : static_cast<std::size_t>(row - part.states.begin());
    table_ = sum_layout(spec, shape, part, state, abstraction.grid, abstraction.inputs);
  }

  [[nodiscard]] const TransitionTable& table() const { return table_; }
  [[nodiscard]] std::size_t state() const { return state_; }

  /// @param difference whether `value` is that of the next value less the present one
  /// @returns false if it is too large
  bool add_base(std::size_t entry, bool first, const Interval& value, bool difference) {
    const Interval origin = difference ? Interval{0.0, 0.0} : enclose(target_.first);
    const Interval error = enclose(target_.measurement_error) / step_;
    Interval ends = (value - origin) / step_ + Interval{-error.upper, error.upper};
    if (table_.shift) {
      // The sum leaves out the state itself, within its cell; the half step is added as an integer.
      if (!difference) return false;
      ends = ends + Interval{-error.upper, error.upper};
    }
    const std::int64_t half = table_.shift && !target_.discrete ? kHalfStep : 0;
    const auto lower = scaled_below(ends.lower);
    const auto upper = scaled_above(ends.upper);
    if (!lower || !upper) return false;
    const std::int64_t low = *lower - half + first_index_bias();
    const std::int64_t high = *upper + half + last_index_bias();
    std::int64_t& base_lower = table_.base_lower[entry];
    std::int64_t& base_upper = table_.base_upper[entry];
    base_lower = first ? low : std::min(base_lower, low);
    base_upper = first ? high : std::max(base_upper, high);
    return true;
  }

  /// Together: takes in the bases that other processes have filled.
  void join(Ranks* ranks) {
    join_segments(ranks, std::span(table_.base_lower));
    join_segments(ranks, std::span(table_.base_upper));
  }

  /// Fills in all terms for one choice of what Phi depends on. @returns false if one is too large
  bool add_terms(const AffineCoefficients& coefficients, const std::vector<std::int64_t>& choice) {
    for (TransitionTerm& term : table_.terms) {
      const auto column = std::find(part_.states.begin(), part_.states.end(), term.state);
      const Interval phi =
          coefficients.phi(row_, static_cast<std::size_t>(column - part_.states.begin())) / step_;
      std::int64_t position = 0;
      std::size_t v = 0;
      for (const std::int32_t i : part_.parameters) position += choice[v++] * term.state_stride[at(i)];
      for (const std::int32_t i : part_.inputs) position += choice[v++] * term.input_stride[at(i)];
      const GridDimension& source = grid_[at(term.state)];
      const Rational reach = source.radius() + source.measurement_error;
      for (std::int64_t k = 0; k < source.count; ++k) {
        const Interval cell = enclose(source.point(k) - reach, source.point(k) + reach);
        const auto lower = scaled_below((phi * cell).lower);
        const auto upper = scaled_above((phi * cell).upper);
        if (!lower || !upper) return false;
        const auto entry = static_cast<std::size_t>(position + k);
        term.lower[entry] = *lower;
        term.upper[entry] = *upper;
      }
    }
    return true;
  }

 private:
  // Cell k is [k - 1/2, k + 1/2] in units of the step, without its upper end if half-open. With these added
  // the indices are the integer parts: closed, ceil(lower - 1/2) and floor(upper + 1/2); half-open,
  // floor(lower + 1/2), and the last one as if the upper end were attained, but for a shift, where it is not.
  [[nodiscard]] std::int64_t first_index_bias() const { return closed_ ? kHalfStep - 1 : kHalfStep; }
  [[nodiscard]] std::int64_t last_index_bias() const {
    return !closed_ && table_.shift ? kHalfStep - 1 : kHalfStep;
  }

  const UniformGrid& grid_;
  const AffinePart& part_;
  const GridDimension& target_;
  TransitionTable& table_;
  std::size_t state_;
  std::size_t row_ = 0;
  Interval step_;
  bool closed_;
};

class SumTables {
 public:
  SumTables(const SystemSpec& spec, const std::vector<TableShape>& shapes, const AffinePart& part,
            Abstraction& abstraction, const std::vector<std::size_t>& states)
      : spec_(spec),
        part_(part),
        abstraction_(abstraction),
        enclosure_(spec, shapes[states.front()], states, true) {
    for (const std::size_t state : states) {
      tables_.emplace_back(spec, shapes[state], part, abstraction, state);
    }
    const TransitionTable& layout = tables_.front().table();
    for (const std::int32_t j : layout.states) {
      if (contains(part.states, j)) {
        if (!layout.shift || at(j) != states.front()) enclosure_.set(spec.state_slot(at(j)), {0.0, 0.0});
        continue;
      }
      const GridDimension& dimension = abstraction.grid[at(j)];
      rest_.add_state(dimension, spec.state_slot(at(j)), dimension.count);
      strides_.push_back(layout.state_stride[at(j)]);
    }
    for (const std::int32_t j : layout.inputs) {
      rest_.add_input(abstraction.inputs[at(j)], spec.input_slot(at(j)));
      strides_.push_back(layout.input_stride[at(j)]);
    }
  }

  bool build(ThreadTeam& team, Ranks* ranks) { return fill_terms(team) && fill_bases(team, ranks); }

 private:
  bool fill_terms(ThreadTeam& team) {
    std::vector<std::int64_t> counts;
    for (const std::int32_t j : part_.parameters) counts.push_back(abstraction_.grid[at(j)].count);
    for (const std::int32_t j : part_.inputs) counts.push_back(abstraction_.inputs[at(j)].count());
    const Odometer all(counts);
    std::atomic<bool> found = true;
    team.for_each(all.size(), 8, [&](ThreadTeam::Range range, int) {
      AffineCoefficients coefficients(spec_, part_, tables_.front().state());
      Odometer choice = all;
      choice.seek(range.begin);
      for (std::int64_t i = range.begin; i < range.end && found; ++i, choice.advance()) {
        if (!fill_terms(coefficients, choice.indices())) found = false;
      }
    });
    return found;
  }

  bool fill_terms(AffineCoefficients& coefficients, const std::vector<std::int64_t>& choice) {
    std::size_t v = 0;
    for (const std::int32_t j : part_.parameters) {
      const Rational value = abstraction_.grid[at(j)].point(choice[v++]);
      coefficients.set(spec_.state_slot(at(j)), enclose(value));
    }
    for (const std::int32_t j : part_.inputs) {
      const Rational& value = abstraction_.inputs[at(j)].values[static_cast<std::size_t>(choice[v++])];
      coefficients.set(spec_.input_slot(at(j)), enclose(value));
    }
    if (!coefficients.enclose()) return false;
    return std::all_of(tables_.begin(), tables_.end(),
                       [&](SumTable& table) { return table.add_terms(coefficients, choice); });
  }

  bool fill_bases(ThreadTeam& team, Ranks* ranks) {
    std::vector<StateEnclosure> enclosures(static_cast<std::size_t>(team.size()), enclosure_);
    const Odometer all = rest_.odometer();
    std::atomic<bool> found = true;
    for_each_divided(ranks, team, all.size(), 4, [&](ThreadTeam::Range range, int worker) {
      Odometer choice = all;
      choice.seek(range.begin);
      for (std::int64_t i = range.begin; i < range.end && found; ++i, choice.advance()) {
        if (!fill_base(choice.indices(), enclosures[static_cast<std::size_t>(worker)])) found = false;
      }
    });
    if (ranks != nullptr) found = ranks->sum(found ? 0 : 1) == 0;
    if (!found) return false;
    for (SumTable& table : tables_) table.join(ranks);
    return true;
  }

  bool fill_base(const std::vector<std::int64_t>& choice, StateEnclosure& enclosure) {
    std::int64_t entry = 0;
    for (std::size_t v = 0; v < strides_.size(); ++v) entry += choice[v] * strides_[v];
    bool found = true;
    bool first = true;
    rest_.for_each_piece(choice, enclosure, [&](const std::vector<std::int64_t>&) {
      enclosure.enclose();
      for (SumTable& table : tables_) {
        const StateEnclosure::Result result = enclosure.result(table.state());
        found = found && result.status == StateEnclosure::Status::ok &&
                table.add_base(static_cast<std::size_t>(entry), first, result.value, enclosure.shifts());
      }
      first = false;
    });
    return found;
  }

  const SystemSpec& spec_;
  const AffinePart& part_;
  const Abstraction& abstraction_;
  StateEnclosure enclosure_;
  std::vector<SumTable> tables_;
  BoxChoices rest_;  ///< all choices of what the base depends on
  std::vector<std::int64_t> strides_;
};

}  // namespace

std::vector<std::int32_t> summed_states(const SystemSpec& spec, const Dependencies& dependencies,
                                        const AffinePart& part, std::size_t state) {
  const auto index = static_cast<std::int32_t>(state);
  const StateSpec& target = spec.states[state];
  if (target.discrete || target.below == Outside::periodic) return {};
  // In continuous time the rows of Phi are those of A.
  if (spec.dynamics.time == Time::continuous && !contains(part.states, index)) return {};
  const bool shift = is_shift(spec, dependencies, state);
  if (shift && !contains(part.states, index)) return {};
  std::vector<std::int32_t> result;
  for (const std::int32_t j : part.states) {
    if (!(shift && j == index)) result.push_back(j);
  }
  const auto too_long = [](const StateSpec& any) {
    return static_cast<double>(any.grid.count) > kLargestTerm;
  };
  if (result.size() > kMostTerms || std::any_of(spec.states.begin(), spec.states.end(), too_long)) return {};
  return result;
}

bool build_sum_tables(const SystemSpec& spec, const std::vector<TableShape>& shapes, Abstraction& abstraction,
                      const std::vector<std::size_t>& states, ThreadTeam& team, Ranks* ranks) {
  const AffinePart part = find_affine_part(spec, shapes[states.front()], states.front());
  return SumTables(spec, shapes, part, abstraction, states).build(team, ranks);
}

}  // namespace coordreq
