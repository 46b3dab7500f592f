#include "analysis/advice.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "cell/random_stream.hpp"
#include "expression/evaluate.hpp"
#include "model/input_space.hpp"
#include "numeric/interval.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Indices of a state: first, ..., last.
struct Run {
  std::int64_t first = 0, last = 0;
};
using CellBox = std::vector<Run>;  ///< [state]

/// Values of all slots on boxes of cells. Boxes are closed, and hold the errors of measurement.
class Slots {
 public:
  Slots(const SystemSpec& spec, const UniformGrid& grid) : grid_(grid) {
    slots_.resize(spec.states.size());
    for (const InputSpec& input : spec.inputs) {
      const auto [least, most] = std::minmax_element(input.values.begin(), input.values.end());
      slots_.push_back(hull(*least, *most));
    }
    for (const DisturbanceSpec& disturbance : spec.disturbances)
      slots_.push_back(hull(disturbance.lower, disturbance.upper));
  }

  const std::vector<Interval>& of(const CellBox& box) {
    for (std::size_t i = 0; i < box.size(); ++i) {
      const GridDimension& dimension = grid_[i];
      if (dimension.below == Outside::periodic && box[i].first == 0) {
        // The first cell has a half at each end of the period.
        slots_[i] = hull(dimension.first, dimension.point(dimension.count));
        continue;
      }
      const Rational margin = dimension.radius() + dimension.measurement_error;
      const Rational low =
          dimension.point(box[i].first) - (stops(dimension.below, box[i].first, 0) ? 0 : margin);
      const Rational high = dimension.point(box[i].last) +
                            (stops(dimension.above, box[i].last, dimension.count - 1) ? 0 : margin);
      slots_[i] = hull(low, high);
    }
    return slots_;
  }

 private:
  static Interval hull(const Rational& low, const Rational& high) {
    constexpr const Interval* kTag = nullptr;
    return {from_rational(kTag, low).lower, from_rational(kTag, high).upper, true};
  }
  /// Nothing is beyond a limit that stops the state.
  static bool stops(Outside rule, std::int64_t index, std::int64_t end) {
    return traits(rule).stops && index == end;
  }

  const UniformGrid& grid_;
  std::vector<Interval> slots_;
};

/// Halves boxes of cells depth first, as long as there is work left.
class Halving {
 public:
  enum class End : std::uint8_t { found, none, out_of_work };

  /// @param boxes so many are looked at
  Halving(const UniformGrid& grid, std::int64_t boxes) : grid_(grid), left_(boxes) {}

  /// Whether a cell is what is looked for. @param may_hold whether a box may hold such a cell
  /// @param is_one called with single cells @param slots those along which boxes are halved
  End search(const std::vector<std::uint32_t>& slots, const std::function<bool(const CellBox&)>& may_hold,
             const std::function<bool(const CellBox&)>& is_one) {
    std::vector<CellBox> open(1);
    for (std::size_t i = 0; i < grid_.size(); ++i) open.front().push_back({0, grid_[i].count - 1});
    while (!open.empty()) {
      if (left_-- <= 0) return End::out_of_work;
      CellBox box = std::move(open.back());
      open.pop_back();
      if (!may_hold(box)) continue;
      const std::size_t i = longest(box, slots);
      if (i == box.size()) {
        if (is_one(box)) return End::found;
        continue;
      }
      CellBox upper = box;
      upper[i].first = std::midpoint(box[i].first, box[i].last) + 1;
      box[i].last = upper[i].first - 1;
      open.push_back(std::move(upper));
      open.push_back(std::move(box));
    }
    return End::none;
  }

 private:
  /// The state with most indices among those given; none if all have one.
  static std::size_t longest(const CellBox& box, const std::vector<std::uint32_t>& slots) {
    std::size_t found = box.size();
    std::int64_t most = 0;
    for (const std::uint32_t slot : slots) {
      if (slot < box.size() && box[slot].last - box[slot].first > most) {
        found = slot;
        most = box[slot].last - box[slot].first;
      }
    }
    return found;
  }

  const UniformGrid& grid_;
  std::int64_t left_;
};

/// Posts of single cells, as many as there is work for.
class SomePosts {
 public:
  SomePosts(const Model& model, const UniformGrid& grid, std::int64_t most, ThreadTeam& team)
      : grid_(grid),
        inputs_(make_input_space(model.spec())),
        posts_(model.spec(), grid, inputs_, team, std::nullopt),
        most_(most) {}

  [[nodiscard]] bool has_work_left() const { return posts_.entries_built() < most_; }
  /// Computes the posts of a cell. @throws SpecError
  void compute(std::int64_t cell) { posts_.move_to(cell); }
  /// Those of the first cell of a box.
  void compute(const CellBox& box) {
    std::int64_t cell = 0;
    for (std::size_t i = 0; i < box.size(); ++i) cell += box[i].first * grid_.stride(i);
    compute(cell);
  }

 private:
  const UniformGrid& grid_;
  InputSpace inputs_;
  CellPosts posts_;
  std::int64_t most_;
};

/// Computes posts of cells where an equation may be undefined.
void look_at_equations(const ProblemSpec& spec, Slots& slots, Halving& halving, SomePosts& posts) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const UpdateSpec* const update = spec.dynamics.update(i);
    if (update != nullptr && update->past) continue;
    const Program& equation = update != nullptr ? update->value : spec.dynamics.equations[i];
    Evaluator<Interval> range(equation);
    static_cast<void>(halving.search(
        equation.variables(), [&](const CellBox& box) { return !range.number(slots.of(box)).total; },
        [&](const CellBox& box) {
          posts.compute(box);
          return !posts.has_work_left();
        }));
  }
}

}  // namespace

Warnings look_ahead(const Model& model, std::int64_t posts, ThreadTeam& team) {
  constexpr std::int64_t kBoxes = 10;  // an evaluation is much cheaper than a post
  const ProblemSpec& spec = model.spec();
  const UniformGrid grid = make_grid(spec);
  Slots slots(spec, grid);
  Warnings found;
  Evaluator<Interval> safe(spec.safe);
  const Halving::End end =
      Halving(grid, kBoxes * posts)
          .search(
              spec.safe.variables(),
              [&](const CellBox& box) { return safe.condition(slots.of(box)) != Truth::no; },
              [](const CellBox& /*box*/) { return true; });
  if (end == Halving::End::none)
    found.push_back({"empty", "/safe", "the safe set is empty: no state of the domain satisfies 'safe'"});
  const auto is_sum = [](const TableShape& shape) { return shape.sum; };
  if (std::ranges::any_of(model.shapes(), is_sum)) return found;
  SomePosts some(model, grid, posts, team);
  Halving halving(grid, kBoxes * posts);
  look_at_equations(spec, slots, halving, some);
  RandomStream draw(0, 0, RandomStream::Purpose::start);
  // Tables may have fewer entries than there is work for.
  for (std::int64_t k = 0; k < posts && some.has_work_left(); ++k)
    some.compute(static_cast<std::int64_t>(draw.below(static_cast<std::uint64_t>(grid.cells()))));
  return found;
}

}  // namespace coordreq
