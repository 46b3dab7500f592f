#include "reach/affine_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "base/error.hpp"
#include "model/pieces.hpp"
#include "reach/affine_post.hpp"
#include "reach/cells_meeting.hpp"
#include "reach/counter.hpp"
#include "reach/shift.hpp"
#include "reach/table_layout.hpp"
#include "reach/tube_table.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Fills the table of one state: for each choice of parameters and inputs one affine row, then all cells.
class TableBuilder {
 public:
  TableBuilder(const ProblemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
               std::size_t state)
      : spec_(spec),
        dynamics_(dynamics),
        grid_(abstraction.grid),
        inputs_(abstraction.inputs),
        dependencies_(dynamics.dependencies(state)),
        table_(abstraction.tables[state]),
        tube_(abstraction.tubes.empty() ? nullptr : &abstraction.tubes[state]),
        post_{grid_, dependencies_.moving, state},
        state_(state) {}

  std::optional<bool> build(ThreadTeam& team) {
    table_ = full_layout(spec_, dependencies_, state_, grid_, inputs_);
    post_.shift = table_.shift;
    if (tube_ != nullptr) *tube_ = table_;

    std::atomic<bool> affine = true;
    std::atomic<bool> exact = true;
    const Counter choices(choice_counts());
    team.for_each(choices.size(), 1, [&](ThreadTeam::Range range, int) {
      Counter choice = choices;
      choice.seek(range.begin);
      for (std::int64_t i = range.begin; i < range.end && affine; ++i, choice.next()) {
        const std::optional<bool> filled = fill(choice.indices());
        if (!filled) affine = false;
        if (filled && !*filled) exact = false;
      }
    });
    if (!affine) return std::nullopt;
    return exact.load();
  }

 private:
  [[nodiscard]] std::vector<std::int64_t> choice_counts() const {
    std::vector<std::int64_t> counts;
    for (const std::int32_t i : dependencies_.parameters) counts.push_back(post_.filled_count(at(i)));
    for (const std::int32_t i : dependencies_.inputs) counts.push_back(inputs_[at(i)].count());
    return counts;
  }

  std::optional<bool> fill(const std::vector<std::int64_t>& choice) {
    std::vector<Rational> slots(spec_.slot_count());
    std::int64_t base = 0;
    std::size_t position = 0;
    for (const std::int32_t i : dependencies_.parameters) {
      const std::int64_t k = choice[position++];
      slots[spec_.state_slot(at(i))] = grid_[at(i)].point(k);
      base += k * table_.state_stride[at(i)];
    }
    for (const std::int32_t i : dependencies_.inputs) {
      const std::int64_t k = choice[position++];
      slots[spec_.input_slot(at(i))] = inputs_[at(i)].values[static_cast<std::size_t>(k)];
      base += k * table_.input_stride[at(i)];
    }
    const std::optional<SampledRow> row = dynamics_.row(state_, slots);
    if (!row) return std::nullopt;
    if (grid_[state_].discrete) {
      fill_points(*row, slots, base);
    } else if (crosses_a_seam(*row)) {
      fill_pieces(*row, base);
    } else {
      fill_cells(*row, base);
    }
    if (tube_ != nullptr) fill_affine_tube(post_, dynamics_.tube_rows(state_, slots).value(), base, *tube_);
    return row->exact;
  }

  /// Lower or upper end of the post, measurement error included, plus `shift`.
  [[nodiscard]] IndexForm end_form(const SampledRow& row, bool upper, const Rational& shift) const {
    const Rational error = grid_[state_].measurement_error / grid_[state_].step;
    return post_.end_form(row, upper, shift + (upper ? error : Rational(-error)));
  }

  [[nodiscard]] bool upper_end_attained(const SampledRow& row) const {
    if (!row.exact) return true;  // the sound reading of an end that is only a bound
    for (std::size_t j = 0; j < row.coefficient.size(); ++j) {
      if (row.coefficient[j] > 0 && !grid_[at(dependencies_.moving[j])].discrete) return false;
    }
    return true;
  }

  /// The value jumps where a periodic state does, unless it is that state itself, turned a whole number of
  /// times.
  [[nodiscard]] bool crosses_a_seam(const SampledRow& row) const {
    for (std::size_t j = 0; j < row.coefficient.size(); ++j) {
      const std::size_t source = at(dependencies_.moving[j]);
      const bool follows = source == state_ && is_integer(row.coefficient[j]);
      if (grid_[source].periodic() && row.coefficient[j] != 0 && !follows) return true;
    }
    return false;
  }

  void fill_pieces(const SampledRow& row, std::int64_t base) {
    const GridDimension& target = grid_[state_];
    const bool attained = upper_end_attained(row);
    post_.fill(table_, base, [&](const std::vector<std::int64_t>& cell) {
      std::optional<IndexRange> range;
      post_.for_each_choice_of_pieces(cell, [&](const std::vector<Piece>& pieces) {
        const Piece values = post_.from_pieces(row, pieces);
        const IndexRange next =
            cells_meeting(target, spec_.abstraction.cells, values.lower - target.measurement_error,
                          values.upper + target.measurement_error, attained);
        range = range ? merge_ranges(*range, next, target) : next;
      });
      return *range;
    });
  }

  /// Cell k is [k - 1/2, k + 1/2] in units of the step, without its upper end if half-open.
  void fill_cells(const SampledRow& row, std::int64_t base) {
    const Rational half(1, 2);
    const bool closed = spec_.abstraction.cells == Cells::closed;
    const bool attained = closed || upper_end_attained(row);
    const IndexForm lower = end_form(row, false, closed ? Rational(-half) : half);
    const IndexForm upper = end_form(row, true, half);
    post_.fill(table_, base, [&](const std::vector<std::int64_t>& cell) {
      const std::int64_t first = closed ? lower.ceil(cell) : lower.floor(cell);
      const std::int64_t last = attained ? upper.floor(cell) : upper.ceil(cell) - 1;
      return IndexRange{saturate_index(first), saturate_index(last)};
    });
  }

  void fill_points(const SampledRow& row, const std::vector<Rational>& slots, std::int64_t base) {
    bool spread = row.lower != row.upper;
    for (std::size_t j = 0; j < row.coefficient.size(); ++j) {
      if (row.coefficient[j] != 0 && !grid_[at(dependencies_.moving[j])].discrete) spread = true;
    }
    const IndexForm form = end_form(row, false, 0);
    post_.fill(table_, base, [&](const std::vector<std::int64_t>& cell) {
      if (spread || !form.integral(cell)) throw off_grid(row, slots, cell, spread);
      const std::int32_t index = saturate_index(form.floor(cell));
      return IndexRange{index, index};
    });
  }

  [[nodiscard]] SpecError off_grid(const SampledRow& row, const std::vector<Rational>& slots,
                                   const std::vector<std::int64_t>& cell, bool spread) const {
    std::string place;
    const auto append = [&](const std::string& name, const Rational& value) {
      place += fmt::format("{}{} = {}", place.empty() ? "" : ", ", name, to_text(value));
    };
    Rational value = row.lower;
    for (std::size_t j = 0; j < cell.size(); ++j) {
      const GridDimension& source = grid_[at(dependencies_.moving[j])];
      append(source.name, source.point(cell[j]));
      value += row.coefficient[j] * source.point(cell[j]);
    }
    for (const std::int32_t i : dependencies_.parameters)
      append(grid_[at(i)].name, slots[spec_.state_slot(at(i))]);
    for (const std::int32_t i : dependencies_.inputs)
      append(inputs_[at(i)].name, slots[spec_.input_slot(at(i))]);
    const GridDimension& target = grid_[state_];
    return SpecError(
        fmt::format(
            "the next value of the discrete state '{}' {}{}{}, expected {} + k * {} with an integer k",
            target.name, spread ? "can be a whole interval" : "is " + to_text(value),
            place.empty() ? "" : " at ", place, to_text(target.first), to_text(target.step)),
        "/dynamics/equations/" + target.name);
  }

  const ProblemSpec& spec_;
  const AffineDynamics& dynamics_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const Dependencies& dependencies_;
  TransitionTable& table_;
  TransitionTable* tube_;  ///< null if not asked for
  AffinePost post_;
  std::size_t state_;
};

}  // namespace

std::optional<bool> build_affine_table(const ProblemSpec& spec, const AffineDynamics& dynamics,
                                       Abstraction& abstraction, std::size_t state, ThreadTeam& team) {
  return TableBuilder(spec, dynamics, abstraction, state).build(team);
}

}  // namespace coordreq
