#include "reach/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "base/error.hpp"
#include "base/index.hpp"
#include "model/odometer.hpp"
#include "model/pieces.hpp"
#include "reach/affine_post.hpp"
#include "reach/cells_meeting.hpp"
#include "reach/stopped_row.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// Fills the table of one state: for each choice of parameters and inputs one affine row, then all cells.
class TableBuilder {
 public:
  TableBuilder(const SystemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
               std::size_t state)
      : spec_(spec),
        dynamics_(dynamics),
        abstraction_(abstraction),
        grid_(abstraction.grid),
        inputs_(abstraction.inputs),
        dependencies_(dynamics.dependencies(state)),
        table_(abstraction.tables[state]),
        tube_(abstraction.tubes.empty() ? nullptr : &abstraction.tubes[state]),
        post_{.grid = grid_, .moving = dependencies_.moving, .state = state},
        state_(state) {}

  std::optional<bool> build(ThreadTeam& team) {
    table_ = full_layout(spec_, dependencies_, state_, abstraction_);
    if (tube_ != nullptr) *tube_ = table_;
    return fill_all(team);
  }

  /// Only what no limit is felt by; the tables are there.
  void build_off_limits(ThreadTeam& team) {
    limits_ = Limits::ignored;
    fill_all(team);
  }

 private:
  std::optional<bool> fill_all(ThreadTeam& team) {
    post_.shift = table_.shift;
    std::atomic<bool> affine = true;
    std::atomic<bool> exact = true;
    const Odometer choices(choice_counts());
    team.for_each(choices.size(), 1, [&](ThreadTeam::Range range, int) {
      Odometer choice = choices;
      choice.seek(range.begin);
      for (std::int64_t i = range.begin; i < range.end && affine; ++i, choice.advance()) {
        const std::optional<bool> filled = fill(choice.indices());
        if (!filled) affine = false;
        if (filled && !*filled) exact = false;
      }
    });
    if (!affine) return std::nullopt;
    return exact.load();
  }

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
    if (dynamics_.has_limit(state_)) {
      const std::optional<StoppedRow> stopped = find_stopped(slots);
      if (tube_ != nullptr && limits_ == Limits::obeyed) {
        if (!stopped || !tells_tubes(*stopped)) return std::nullopt;
        fill_ends(*stopped, base);
        post_.fill(*tube_, base, [&](const auto& cell) { return between_ends(*stopped, cell).value(); });
        return false;
      }
      if (stopped) {
        fill_ends(*stopped, base);
        if (tube_ == nullptr) return true;
        narrow_tubes(*stopped, base);
      }
    }
    const std::optional<SampledRow> row = dynamics_.row(state_, slots, limits_);
    if (!row) return limits_ == Limits::ignored ? std::optional(false) : std::nullopt;
    AffinePost post = post_;
    if (limits_ == Limits::ignored) post.applies = is_off_limits(slots);
    if (grid_[state_].discrete) {
      fill_points(post, *row, slots, base);
    } else if (crosses_a_seam(*row)) {
      fill_pieces(post, *row, base);
    } else {
      fill_cells(post, *row, base);
    }
    if (tube_ == nullptr) return row->exact;
    fill_affine_tube(post, dynamics_.tube_rows(state_, slots, limits_).value(), base, *tube_);
    return row->exact;
  }

  /// Whether all states stay between their limits, and do not touch them, for whole cells and at all times.
  [[nodiscard]] std::function<bool(const std::vector<std::int64_t>&)> is_off_limits(
      const std::vector<Rational>& slots) const {
    std::vector<LimitedState> limited;
    for (const std::int32_t j : dependencies_.moving) {
      const GridDimension& dimension = grid_[at(j)];
      if (dimension.below != Outside::stop && dimension.above != Outside::stop) continue;
      const Dependencies& dependencies = dynamics_.dependencies(at(j));
      const AffinePost post{.grid = grid_, .moving = dependencies.moving, .state = at(j)};
      LimitedState& one = limited.emplace_back();
      for (const std::int32_t k : dependencies.moving) {
        const auto found = std::find(dependencies_.moving.begin(), dependencies_.moving.end(), k);
        one.positions.push_back(static_cast<std::size_t>(found - dependencies_.moving.begin()));
      }
      one.last = dimension.count - 1;
      const auto rows = dynamics_.tube_rows(at(j), slots, Limits::ignored);
      if (!rows) return [](const auto&) { return false; };
      for (const SampledRow& row : *rows) {
        one.lower.push_back(post.end_form(row, false, 0));
        one.upper.push_back(post.end_form(row, true, 0));
      }
    }
    return [limited](const std::vector<std::int64_t>& cell) {
      return std::all_of(limited.begin(), limited.end(),
                         [&](const LimitedState& one) { return one.stays(cell); });
    };
  }

  /// Where a state with limits is during a period, in steps from its first grid point.
  struct LimitedState {
    std::vector<std::size_t> positions;  ///< of what it depends on, among the moving states
    std::vector<IndexForm> lower;
    std::vector<IndexForm> upper;
    std::int64_t last = 0;

    [[nodiscard]] bool stays(const std::vector<std::int64_t>& cell) const {
      std::vector<std::int64_t> indices;
      for (const std::size_t position : positions) indices.push_back(cell[position]);
      return std::all_of(lower.begin(), lower.end(),
                         [&](const IndexForm& f) { return f.ceil(indices) > 0; }) &&
             std::all_of(upper.begin(), upper.end(),
                         [&](const IndexForm& f) { return f.floor(indices) < last; });
    }
  };

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

  void fill_pieces(const AffinePost& post, const SampledRow& row, std::int64_t base) {
    const GridDimension& target = grid_[state_];
    const bool attained = upper_end_attained(row);
    post.fill(table_, base, [&](const std::vector<std::int64_t>& cell) {
      std::optional<IndexRange> range;
      post.for_each_choice_of_pieces(cell, [&](const std::vector<Piece>& pieces) {
        const Piece values = post.from_pieces(row, pieces);
        const IndexRange next =
            cells_meeting(target, spec_.abstraction.cells, values.lower - target.measurement_error,
                          values.upper + target.measurement_error, attained);
        range = range ? merge_ranges(*range, next, target) : next;
      });
      return *range;
    });
  }

  /// Cell k is [k - 1/2, k + 1/2] in units of the step, without its upper end if half-open.
  void fill_cells(const AffinePost& post, const SampledRow& row, std::int64_t base) {
    const Rational half(1, 2);
    const bool closed = spec_.abstraction.cells == Cells::closed;
    const bool attained = closed || upper_end_attained(row);
    const IndexForm lower = end_form(row, false, closed ? Rational(-half) : half);
    const IndexForm upper = end_form(row, true, half);
    post.fill(table_, base, [&](const std::vector<std::int64_t>& cell) {
      const std::int64_t first = closed ? lower.ceil(cell) : lower.floor(cell);
      const std::int64_t last = attained ? upper.floor(cell) : upper.ceil(cell) - 1;
      return raw_range(grid_[state_], first, last);
    });
  }

  /// The row where limits hold integrators alone.
  [[nodiscard]] std::optional<StoppedRow> find_stopped(const std::vector<Rational>& slots) const {
    if (spec_.dynamics.time == Time::discrete || grid_[state_].discrete) return std::nullopt;
    return stopped_row(spec_, grid_, dependencies_, state_, slots);
  }

  void fill_ends(const StoppedRow& row, std::int64_t base) {
    const GridDimension& target = grid_[state_];
    post_.fill(table_, base, [&](const std::vector<std::int64_t>& cell) {
      Rational lower = row.lower - target.measurement_error;
      Rational upper = row.upper + target.measurement_error;
      bool attained = true;
      for (std::size_t j = 0; j < cell.size(); ++j) {
        const StoppedRow::Summand& summand = row.summands[j][static_cast<std::size_t>(cell[j])];
        lower += summand.lower;
        upper += summand.upper;
        attained = attained && summand.attained;
      }
      return cells_meeting(target, spec_.abstraction.cells, lower, upper, attained);
    });
  }

  /// Whether the state moves in one direction only, or is stopped itself, from all cells: then its ends tell
  /// its tubes, and nothing has to be enclosed.
  [[nodiscard]] bool tells_tubes(const StoppedRow& row) const {
    if (grid_[state_].periodic()) return false;
    if (row.is_stopped) return true;
    if (!row.rate) return false;
    Rational slowest = row.rate->first, fastest = row.rate->second;
    for (const std::vector<StoppedRow::Summand>& summands : row.summands) {
      const auto by_slowest = [](const auto& a, const auto& b) { return a.slowest < b.slowest; };
      const auto by_fastest = [](const auto& a, const auto& b) { return a.fastest < b.fastest; };
      slowest += std::min_element(summands.begin(), summands.end(), by_slowest)->slowest;
      fastest += std::max_element(summands.begin(), summands.end(), by_fastest)->fastest;
    }
    return slowest >= 0 || fastest <= 0;
  }

  void narrow_tubes(const StoppedRow& row, std::int64_t base) {
    if (grid_[state_].periodic() || !(row.is_stopped || row.rate)) return;
    post_.narrow(*tube_, base, [&](const auto& cell) { return between_ends(row, cell); });
  }

  /// A state that moves in one direction only is between its ends all the time, wherever limits stop others.
  [[nodiscard]] std::optional<IndexRange> between_ends(const StoppedRow& row,
                                                       const std::vector<std::int64_t>& cell) const {
    Rational lower = row.lower, upper = row.upper, slowest = 0, fastest = 0;
    for (std::size_t j = 0; j < cell.size(); ++j) {
      const StoppedRow::Summand& summand = row.summands[j][at(cell[j])];
      lower += summand.lower;
      upper += summand.upper;
      slowest += summand.slowest;
      fastest += summand.fastest;
    }
    const bool has_direction =
        row.is_stopped || row.rate->first + slowest >= 0 || row.rate->second + fastest <= 0;
    if (!has_direction) return std::nullopt;
    const auto& moving = dependencies_.moving;
    const auto found = std::find(moving.begin(), moving.end(), static_cast<std::int32_t>(state_));
    const Piece start =
        post_.pieces_of(state_, cell[static_cast<std::size_t>(found - moving.begin())]).front();
    return cells_covering(grid_[state_], std::min(start.lower, lower), std::max(start.upper, upper));
  }

  void fill_points(const AffinePost& post, const SampledRow& row, const std::vector<Rational>& slots,
                   std::int64_t base) {
    bool spread = row.lower != row.upper;
    for (std::size_t j = 0; j < row.coefficient.size(); ++j) {
      if (row.coefficient[j] != 0 && !grid_[at(dependencies_.moving[j])].discrete) spread = true;
    }
    const IndexForm form = end_form(row, false, 0);
    // All processes are to find the same fault.
    post.fill_and_check(table_, base, [&](const std::vector<std::int64_t>& cell) {
      if (spread || !form.integral(cell)) throw off_grid(row, slots, cell, spread);
      const std::int64_t index = form.floor(cell);
      return raw_range(grid_[state_], index, index);
    });
  }

  [[nodiscard]] SpecError off_grid(const SampledRow& row, const std::vector<Rational>& slots,
                                   const std::vector<std::int64_t>& cell, bool spread) const {
    std::string location;
    const auto append = [&](const std::string& name, const Rational& value) {
      location += fmt::format("{}{} = {}", location.empty() ? "" : ", ", name, to_text(value));
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
            location.empty() ? "" : " at ", location, to_text(target.first), to_text(target.step)),
        "/dynamics/equations/" + target.name);
  }

  const SystemSpec& spec_;
  const AffineDynamics& dynamics_;
  const Abstraction& abstraction_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const Dependencies& dependencies_;
  TransitionTable& table_;
  TransitionTable* tube_;  ///< null if not asked for
  AffinePost post_;
  std::size_t state_;
  Limits limits_ = Limits::obeyed;
};

}  // namespace

std::optional<bool> build_affine_table(const SystemSpec& spec, const AffineDynamics& dynamics,
                                       Abstraction& abstraction, std::size_t state, ThreadTeam& team) {
  return TableBuilder(spec, dynamics, abstraction, state).build(team);
}

void fill_cells_off_limits(const SystemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
                           std::size_t state, ThreadTeam& team) {
  if (dynamics.has_limit(state)) TableBuilder(spec, dynamics, abstraction, state).build_off_limits(team);
}

}  // namespace coordreq
