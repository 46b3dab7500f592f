#include "model/row_sample.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/index.hpp"
#include "expression/condition.hpp"
#include "numeric/rational.hpp"

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

/// Whether `state` is one on which a table depends, its own by an offset apart.
bool tells_rows_apart(const std::vector<TableShape>& shapes, std::size_t state) {
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    const bool is_used = std::find(shapes[t].states.begin(), shapes[t].states.end(),
                                   static_cast<std::int32_t>(state)) != shapes[t].states.end();
    if (is_used && (t != state || !shapes[t].shift)) return true;
  }
  return false;
}

/// S at grid points.
class SafeAt {
 public:
  explicit SafeAt(const ProblemSpec& spec)
      : spec_(spec), decider_(spec.safe), exact_(spec.slot_count()), fast_(spec.slot_count()) {}

  void place(std::size_t state, std::int64_t index) {
    const GridSpec& grid = spec_.states[state].grid;
    const Rational point = grid.first + grid.step * Rational(static_cast<long>(index));
    exact_[state] = {.lower = point, .upper = point};
    fast_[state] = enclose(point);
  }
  [[nodiscard]] Truth holds() {
    return decider_.decide(std::span<const Interval>(fast_),
                           [&] { return std::span<const RationalInterval>(exact_); });
  }

 private:
  const ProblemSpec& spec_;
  ConditionDecider decider_;
  std::vector<RationalInterval> exact_;
  std::vector<Interval> fast_;
};

/// Work is counted in cells of rows that are worked out; beyond half of the sample all are taken as
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
                      const std::vector<std::size_t>& along) {
  std::vector<std::size_t> across;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!contains(along, i)) across.push_back(i);
  }
  RowSample result{.rows = cells_of(spec, across), .lanes = cells_of(spec, along)};
  result.drawn = std::min(result.rows, kDrawnRows);
  Draw draw;
  const auto any_place = [&](const std::vector<std::size_t>& states) {
    std::vector<std::int64_t> place;
    for (const std::size_t i : states) place.push_back(draw.below(spec.states[i].grid.count));
    return place;
  };
  std::vector<std::vector<std::int64_t>> lanes;
  for (std::int64_t k = 0; k < kDrawnLanes; ++k) lanes.push_back(any_place(along));
  SafeAt safe(spec);
  std::set<std::vector<std::int64_t>> found;
  for (std::int64_t k = 0; k < result.drawn; ++k) {
    const std::vector<std::int64_t> row = any_place(across);
    std::vector<std::int64_t> content;
    for (std::size_t i = 0; i < across.size(); ++i) {
      safe.place(across[i], row[i]);
      if (tells_rows_apart(shapes, across[i])) content.push_back(row[i]);
    }
    for (const std::vector<std::int64_t>& lane : lanes) {
      for (std::size_t i = 0; i < along.size(); ++i) safe.place(along[i], lane[i]);
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
  if (cells_of(spec, order) < kFewCells) return std::nullopt;
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
  std::int64_t least = work_of(sample_rows(spec, shapes, usual)) / kWorthIt;
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
    const std::int64_t work = work_of(sample_rows(spec, shapes, along));
    if (work > least || (best && work == least)) continue;
    least = work;
    best = std::move(along);
  }
  return best;
}

}  // namespace coordreq
