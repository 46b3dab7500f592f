#include "verify/flow_extremes.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

/// -1, 0 or 1: which way the state goes; 2: not only one.
int direction(const Arb& change) {
  if (change.is_zero()) return 0;
  if (change.is_nonnegative()) return 1;
  return change.is_nonpositive() ? -1 : 2;
}

class RangeFinder {
 public:
  RangeFinder(FlowExtremes& flow, std::size_t state, const SpanBox& box)
      : field_(flow.field()),
        flow_(flow),
        state_(state),
        box_(box),
        variable_(field_.variables()[state]),
        share_(flow.duration_of_step()) {
    result_.lower = box[variable_].lower.lower();
    result_.upper = box[variable_].upper.upper();
  }

  FlowRange run() {
    const std::vector<TubeStep>& steps = flow_.steps();
    for (std::size_t begin = 0, end = 0; begin < steps.size(); begin = end) {
      const int trend = direction(change(begin));
      end = begin + 1;
      while (trend != 2 && end < steps.size() && direction(change(end)) == trend) ++end;
      visit(begin, end, trend);
    }
    result_.stays_above_start = keeps(1) || is_wall(false);
    result_.stays_below_start = keeps(-1) || is_wall(true);
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Arb& change(std::size_t step) const { return flow_.steps()[step].change[state_]; }

  void visit(std::size_t begin, std::size_t end, int trend) {
    if (trend == 0) return;
    if (trend == 2) {
      const Arb moved = share_ * change(begin);
      look(begin, moved.lower(), moved.upper());
    }
    look(end, Arb(), Arb());
  }

  void look(std::size_t steps, const Arb& down, const Arb& up) {
    const Extreme least = flow_.extreme_after(steps, state_, false);
    const Extreme greatest = flow_.extreme_after(steps, state_, true);
    result_.lower = lesser(result_.lower, (least.bound + down).lower());
    result_.upper = greater(result_.upper, (greatest.bound + up).upper());
    if (steps == 0) return;
    if (least.attained)
      result_.low = result_.low ? lesser(*result_.low, least.attained->upper()) : least.attained->upper();
    if (greatest.attained)
      result_.high =
          result_.high ? greater(*result_.high, greatest.attained->lower()) : greatest.attained->lower();
  }

  [[nodiscard]] bool keeps(int trend) const {
    const std::vector<TubeStep>& steps = flow_.steps();
    return std::all_of(steps.begin(), steps.end(), [&](const TubeStep& step) {
      const int sign = direction(step.change[state_]);
      return sign == 0 || sign == trend;
    });
  }

  /// Whether the state cannot get to where its derivative does not point: had it done so, it would have moved
  /// against its derivative since it was last inside.
  [[nodiscard]] bool is_wall(bool above) {
    return std::all_of(flow_.steps().begin(), flow_.steps().end(), [&](const TubeStep& step) {
      ArbBox beyond = step.tube;
      beyond[variable_] =
          above ? hull(box_[variable_].upper, greater(box_[variable_].upper, step.tube[variable_].upper()))
                : hull(box_[variable_].lower, lesser(box_[variable_].lower, step.tube[variable_].lower()));
      const Arb trend = field_.value(state_, beyond);
      return trend.is_finite() && (above ? trend.is_nonpositive() : trend.is_nonnegative());
    });
  }

  SeriesField& field_;
  FlowExtremes& flow_;
  std::size_t state_;
  const SpanBox& box_;
  std::uint32_t variable_;
  const Arb& share_;
  FlowRange result_;
};

}  // namespace

std::optional<FlowRange> range_during_period(FlowExtremes& flow, std::size_t state, const SpanBox& box,
                                             const Effort& effort) {
  if (!flow.enclose(box, effort)) return std::nullopt;
  FlowRange range = RangeFinder(flow, state, box).run();
  if (!range.lower.is_finite() || !range.upper.is_finite()) return std::nullopt;
  return range;
}

}  // namespace coordreq
