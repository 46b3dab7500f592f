#include "answers/requirements/region.hpp"

#include <algorithm>
#include <vector>

#include "expression/evaluate.hpp"
#include "model/pieces.hpp"

namespace coordreq {
namespace {

using outward::kInfinity;

/// All values that the state of a dimension can have while another one is outside.
Interval everywhere(const GridDimension& dimension) {
  if (dimension.periodic()) return {lower_double(dimension.lower), upper_double(dimension.upper)};
  Interval range{-kInfinity, kInfinity};
  if (!traits(dimension.below).is_open()) range.lower = lower_double(pieces(dimension, 0).front().lower);
  if (!traits(dimension.above).is_open()) {
    range.upper = upper_double(pieces(dimension, dimension.count - 1).back().upper);
  }
  return range;
}

/// The values that may be measured beyond a side.
Interval beyond(const GridDimension& dimension, bool above) {
  const Rational last = dimension.point(above ? dimension.count - 1 : 0);
  const bool is_lattice = dimension.discrete && dimension.measurement_error == 0;
  // A measurement error lets states inside the domain be measured outside.
  const Rational reach = is_lattice ? dimension.step : dimension.radius() - dimension.measurement_error;
  if (above) return {lower_double(last + reach), kInfinity};
  return {-kInfinity, upper_double(last - reach)};
}

/// Where to cut a range: near 0 first, then further out in steps that grow.
double cut_of(const Interval& range) {
  if (range.lower == -kInfinity && range.upper == kInfinity) return 0.0;
  if (range.upper == kInfinity) return range.lower < 0.0 ? 0.0 : std::max(1.0, 4.0 * range.lower);
  if (range.lower == -kInfinity) return range.upper > 0.0 ? 0.0 : std::min(-1.0, 4.0 * range.upper);
  return range.lower / 2 + range.upper / 2;
}

/// Whether a condition may hold somewhere in an unbounded box.
class UnboundedSearch {
 public:
  static constexpr int kMostBoxes = 512;

  explicit UnboundedSearch(const Program& condition)
      : evaluator_(condition), variables_(condition.variables()) {}

  [[nodiscard]] bool may_hold(std::vector<Interval> box) {
    boxes_left_ = kMostBoxes;
    return visit(box, 0);
  }

 private:
  [[nodiscard]] bool visit(std::vector<Interval>& box, std::size_t cuts) {
    const Truth truth = evaluator_.condition(box);
    if (truth != Truth::undecided) return truth == Truth::yes;
    if (--boxes_left_ <= 0) return true;
    for (std::size_t tried = 0; tried < variables_.size(); ++tried) {
      Interval& range = box[variables_[(cuts + tried) % variables_.size()]];
      const double cut = cut_of(range);
      if (!(range.lower < cut && cut < range.upper)) continue;
      const Interval whole = range;
      range.upper = cut;
      const bool below = visit(box, cuts + tried + 1);
      range = {cut, whole.upper};
      const bool result = below || visit(box, cuts + tried + 1);
      range = whole;
      return result;
    }
    return true;
  }

  Evaluator<Interval> evaluator_;
  std::vector<std::uint32_t> variables_;
  int boxes_left_ = 0;
};

}  // namespace

std::optional<DomainSide> side_reached(const Program& where, const UniformGrid& grid) {
  std::vector<Interval> box;
  for (const GridDimension& dimension : grid.dimensions()) box.push_back(everywhere(dimension));
  UnboundedSearch search(where);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    for (const bool above : {false, true}) {
      if (!traits(above ? grid[i].above : grid[i].below).blocks) continue;
      std::vector<Interval> outside = box;
      outside[i] = beyond(grid[i], above);
      if (search.may_hold(std::move(outside))) return DomainSide{i, above};
    }
  }
  return std::nullopt;
}

}  // namespace coordreq
