#include "model/row_sample.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/fast_paths.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "expression/condition.hpp"
#include "numeric/rational.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kDrawnRows = 64;
constexpr std::int64_t kDrawnLanes = 32;
/// Smaller problems are done before another order has paid.
constexpr std::int64_t kFewCells = std::int64_t{1} << 16;
/// With more states to choose from there are too many choices to look at.
constexpr std::size_t kMostChosenFrom = 8;
/// Another order is taken if it promises work that is so many times less.
constexpr std::int64_t kWorthIt = 4;

/// Numbers that are the same in every run (Knuth's MMIX generator).
class Draw {
 public:
  std::int64_t below(std::int64_t count) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::int64_t>((state_ >> 33U) % static_cast<std::uint64_t>(count));
  }

 private:
  std::uint64_t state_ = 1;
};

std::int64_t cells_of(const ProblemSpec& spec, const std::vector<std::size_t>& states) {
  std::int64_t product = 1;
  for (const std::size_t i : states) {
    if (spec.states[i].grid.count > INT64_MAX / product) return INT64_MAX;
    product *= spec.states[i].grid.count;
  }
  return product;
}

/// Whether `state` is one on which a table depends, which is not only an offset.
bool distinguishes_rows(const std::vector<TableShape>& shapes, std::size_t state) {
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    const bool is_used = std::find(shapes[t].states.begin(), shapes[t].states.end(),
                                   static_cast<std::int32_t>(state)) != shapes[t].states.end();
    if (is_used && (t != state || !shapes[t].shift)) return true;
  }
  return false;
}

/// A grid point of one state.
struct Coordinate {
  std::size_t state;
  std::int64_t index;
  Interval value;
};

/// S at grid points.
class SafeAt {
 public:
  explicit SafeAt(const ProblemSpec& spec)
      : spec_(spec), decider_(spec.safe), index_(spec.states.size(), 0), value_(spec.slot_count()) {}

  [[nodiscard]] Coordinate coordinate(std::size_t state, std::int64_t index) const {
    return {state, index, enclose(point(state, index))};
  }
  void move_to(const std::vector<Coordinate>& coordinates) {
    for (const Coordinate& one : coordinates) {
      index_[one.state] = one.index;
      value_[spec_.state_slot(one.state)] = one.value;
    }
  }
  [[nodiscard]] Truth holds() {
    std::vector<RationalInterval> exact;
    return decider_.decide(std::span<const Interval>(value_), [&] {
      exact.resize(value_.size());
      for (std::size_t state = 0; state < index_.size(); ++state) {
        const Rational at = point(state, index_[state]);
        exact[spec_.state_slot(state)] = {.lower = at, .upper = at};
      }
      return std::span<const RationalInterval>(exact);
    });
  }

 private:
  [[nodiscard]] Rational point(std::size_t state, std::int64_t index) const {
    const GridSpec& grid = spec_.states[state].grid;
    return grid.first + grid.step * Rational(static_cast<long>(index));
  }

  const ProblemSpec& spec_;
  ConditionDecider decider_;
  std::vector<std::int64_t> index_;  ///< by state
  std::vector<Interval> value_;      ///< by slot
};

/// Work is counted in cells of rows that are computed; beyond half of the sample all are taken as
/// different.
std::int64_t work_of(const RowSample& sample) {
  return (2 * sample.different > sample.drawn ? sample.rows : sample.different) * sample.lanes;
}

std::vector<std::size_t> last_of(const std::vector<std::size_t>& order, std::size_t count) {
  return {order.end() - static_cast<std::ptrdiff_t>(count), order.end()};
}

/// The last states of the order that rows run along as it is.
std::vector<std::size_t> joined_states(const ProblemSpec& spec, const std::vector<std::size_t>& order,
                                       const std::vector<std::size_t>& movable) {
  std::size_t count = 0;
  while (count + 1 < order.size() && contains(movable, order[order.size() - 1 - count]) &&
         cells_of(spec, last_of(order, count + 1)) <= kMostJoinedLanes)
    ++count;
  return last_of(order, count);
}

}  // namespace

RowSample sample_rows(const ProblemSpec& spec, const std::vector<TableShape>& shapes,
                      const std::vector<std::size_t>& along, std::int64_t most) {
  REQUIRES(std::ranges::all_of(along, [&](std::size_t state) { return state < spec.states.size(); }));
  std::vector<std::size_t> across;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!contains(along, i)) across.push_back(i);
  }
  RowSample result{.rows = cells_of(spec, across), .lanes = cells_of(spec, along)};
  result.drawn = std::min(result.rows, kDrawnRows);
  Draw draw;
  SafeAt safe(spec);
  const auto draw_coordinates = [&](const std::vector<std::size_t>& states) {
    std::vector<Coordinate> coordinates;
    for (const std::size_t i : states)
      coordinates.push_back(safe.coordinate(i, draw.below(spec.states[i].grid.count)));
    return coordinates;
  };
  std::vector<std::vector<Coordinate>> lanes;
  for (std::int64_t k = 0; k < kDrawnLanes; ++k) lanes.push_back(draw_coordinates(along));
  std::set<std::vector<std::int64_t>> found;
  for (std::int64_t k = 0; k < result.drawn && std::ssize(found) <= most; ++k) {
    const std::vector<Coordinate> row = draw_coordinates(across);
    safe.move_to(row);
    std::vector<std::int64_t> content;
    for (const Coordinate& one : row) {
      if (distinguishes_rows(shapes, one.state)) content.push_back(one.index);
    }
    for (const std::vector<Coordinate>& lane : lanes) {
      safe.move_to(lane);
      content.push_back(static_cast<std::int64_t>(safe.holds()));
    }
    found.insert(std::move(content));
  }
  result.different = static_cast<std::int64_t>(found.size());
  return result;
}

std::optional<std::vector<std::size_t>> find_similar_rows(const ProblemSpec& spec,
                                                          const std::vector<TableShape>& shapes,
                                                          const std::vector<std::size_t>& order) {
  if (!fast_paths().similar_rows || cells_of(spec, order) < kFewCells) return std::nullopt;
  std::vector<std::size_t> movable;  // in the order that is given
  for (const std::size_t i : order) {
    const bool leads = std::any_of(shapes.begin(), shapes.end(), [&](const TableShape& shape) {
      return &shape != &shapes[i] && std::find(shape.states.begin(), shape.states.end(),
                                               static_cast<std::int32_t>(i)) != shape.states.end();
    });
    if (shapes[i].shift && !shapes[i].sum && spec.states[i].grid.count > 1 && !leads) movable.push_back(i);
  }
  const std::vector<std::size_t> usual = joined_states(spec, order, movable);
  if (usual.size() < 2 || movable.size() > kMostChosenFrom) return std::nullopt;
  std::int64_t least = work_of(sample_rows(spec, shapes, usual, kDrawnRows / 2)) / kWorthIt;
  std::optional<std::vector<std::size_t>> best;
  // The last of the order is the last of those to choose from, too, and is always taken.
  const std::size_t choices = std::size_t{1} << (movable.size() - 1);
  for (std::size_t choice = 1; choice < choices; ++choice) {
    std::vector<std::size_t> along;
    for (std::size_t k = 0; k + 1 < movable.size(); ++k) {
      if ((choice >> k & 1U) != 0) along.push_back(movable[k]);
    }
    along.push_back(movable.back());
    if (along.size() == order.size() || cells_of(spec, along) > kMostJoinedLanes) continue;
    const std::int64_t most = std::min(kDrawnRows / 2, least / cells_of(spec, along));
    const std::int64_t work = work_of(sample_rows(spec, shapes, along, most));
    if (work > least || (best && work == least)) continue;
    least = work;
    best = std::move(along);
  }
  return best;
}

}  // namespace coordreq
