#include "answers/requirements/region.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "expression/condition.hpp"
#include "model/pieces.hpp"

namespace coordreq {
namespace {

using outward::kInfinity;

/// A closed range; nothing stands for an end that is infinite.
struct Extent {
  std::optional<Rational> lower, upper;

  [[nodiscard]] Interval enclosure() const {
    return {lower ? lower_double(*lower) : -kInfinity, upper ? upper_double(*upper) : kInfinity};
  }
  /// The whole line where an end is infinite.
  [[nodiscard]] RationalInterval exact() const {
    if (!lower || !upper) return {.bounded = false};
    return {.lower = *lower, .upper = *upper};
  }
};

/// All values that the state of a dimension can have while another one is outside.
Extent everywhere(const GridDimension& dimension) {
  if (dimension.periodic()) return {dimension.lower, dimension.upper};
  Extent range;
  if (!traits(dimension.below).is_open()) range.lower = pieces(dimension, 0).front().lower;
  if (!traits(dimension.above).is_open()) range.upper = pieces(dimension, dimension.count - 1).back().upper;
  return range;
}

/// The values that may be measured beyond a side.
Extent beyond(const GridDimension& dimension, bool above) {
  const Rational last = dimension.point(above ? dimension.count - 1 : 0);
  const bool is_lattice = dimension.discrete && dimension.measurement_error == 0;
  // A measurement error lets states inside the domain be measured outside.
  const Rational reach = is_lattice ? dimension.step : dimension.radius() - dimension.measurement_error;
  if (above) return {last + reach, std::nullopt};
  return {std::nullopt, last - reach};
}

/// Where to cut a range: near 0 first, then further out in steps that grow.
double cut_of(const Extent& extent) {
  const Interval range = extent.enclosure();
  if (range.lower == -kInfinity && range.upper == kInfinity) return 0.0;
  if (range.upper == kInfinity) return range.lower < 0.0 ? 0.0 : std::max(1.0, 4.0 * range.lower);
  if (range.lower == -kInfinity) return range.upper > 0.0 ? 0.0 : std::min(-1.0, 4.0 * range.upper);
  return range.lower / 2 + range.upper / 2;
}

/// Whether a condition may hold somewhere in an unbounded box. Natural evaluation in doubles decides most of
/// it; conditions on bounded states alone are decided exactly, for the region may end just where the domain
/// does.
class UnboundedSearch {
 public:
  static constexpr int kMostBoxes = 512;

  UnboundedSearch(const Program& condition, std::size_t states)
      : fast_(condition),
        exact_(condition),
        decider_(condition),
        variables_(condition.variables()),
        fast_box_(states),
        exact_box_(states) {}

  [[nodiscard]] bool may_hold(std::vector<Extent> box) {
    boxes_left_ = kMostBoxes;
    return visit(box, 0);
  }

 private:
  [[nodiscard]] bool visit(std::vector<Extent>& box, std::size_t cuts) {
    const Truth truth = decide(box);
    if (truth != Truth::undecided) return truth == Truth::yes;
    if (--boxes_left_ <= 0) return true;
    for (std::size_t tried = 0; tried < variables_.size(); ++tried) {
      Extent& range = box[variables_[(cuts + tried) % variables_.size()]];
      const double double_cut = cut_of(range);
      if (!std::isfinite(double_cut)) continue;
      const Rational cut = exact(double_cut);
      if ((range.lower && *range.lower >= cut) || (range.upper && cut >= *range.upper)) continue;
      const Extent whole = range;
      range.upper = cut;
      const bool below = visit(box, cuts + tried + 1);
      range = {cut, whole.upper};
      const bool result = below || visit(box, cuts + tried + 1);
      range = whole;
      return result;
    }
    return true;
  }

  [[nodiscard]] Truth decide(const std::vector<Extent>& box) {
    bool is_bounded = true;
    for (const std::uint32_t slot : variables_) {
      fast_box_[slot] = box[slot].enclosure();
      exact_box_[slot] = box[slot].exact();
      is_bounded = is_bounded && exact_box_[slot].bounded;
    }
    const auto exact_box = [this]() -> std::span<const RationalInterval> { return exact_box_; };
    if (is_bounded) return decider_.decide(fast_box_, exact_box);
    const Truth quick = fast_.condition(fast_box_);
    return quick == Truth::undecided ? exact_.condition(exact_box_) : quick;
  }

  Evaluator<Interval> fast_;
  Evaluator<RationalInterval> exact_;
  ConditionDecider decider_;
  std::vector<std::uint32_t> variables_;
  std::vector<Interval> fast_box_;
  std::vector<RationalInterval> exact_box_;
  int boxes_left_ = 0;
};

}  // namespace

std::optional<DomainSide> side_reached(const Program& where, const UniformGrid& grid) {
  std::vector<Extent> box;
  for (const GridDimension& dimension : grid.dimensions()) box.push_back(everywhere(dimension));
  UnboundedSearch search(where, grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    for (const bool above : {false, true}) {
      if (!traits(above ? grid[i].above : grid[i].below).blocks) continue;
      std::vector<Extent> outside = box;
      outside[i] = beyond(grid[i], above);
      if (search.may_hold(std::move(outside))) return DomainSide{i, above};
    }
  }
  return std::nullopt;
}

}  // namespace coordreq
