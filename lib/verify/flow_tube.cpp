#include "verify/flow_tube.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

constexpr Work kOfHeldEnd = 40;

/// The extreme derivative over a face that is cut where its bound is farthest off.
Arb extreme_change(SeriesField& field, std::size_t i, const SpanBox& face,
                   const std::optional<ArbMatrix>& slopes, bool greatest, int pieces) {
  std::optional<std::vector<Arb>> row;
  if (slopes) {
    row.emplace();
    for (std::size_t j = 0; j < field.variables().size(); ++j) row->push_back((*slopes)(i, j));
  }
  const Extreme whole = extreme_of(field, i, face, row, greatest);
  const auto worst = std::max_element(whole.excess.begin(), whole.excess.end());
  if (pieces <= 1 || worst == whole.excess.end() || *worst <= 0.0) return whole.bound;
  const std::uint32_t slot = field.variables()[static_cast<std::size_t>(worst - whole.excess.begin())];
  SpanBox half = face;
  half[slot].upper = face[slot].middle();
  Arb found = extreme_change(field, i, half, field.jacobian(all_of(half)), greatest, pieces / 2);
  half[slot] = {half[slot].upper, face[slot].upper};
  const Arb other = extreme_change(field, i, half, field.jacobian(all_of(half)), greatest, pieces / 2);
  if (!found.is_finite() || !other.is_finite()) return whole.bound;
  found = greatest ? greater(found, other) : lesser(found, other);
  if (!whole.bound.is_finite()) return found;
  return greatest ? lesser(found, whole.bound) : greater(found, whole.bound);
}

class StepMaker {
 public:
  StepMaker(SeriesField& field, const std::vector<StopLimits>& limits, const Arb& duration, int pieces)
      : field_(field), limits_(limits), duration_(duration), pieces_(pieces) {}

  std::optional<TubeStep> make(const SpanBox& start) {
    field_.add_work(work_of_step(start));
    std::optional<Tube> tube = picard_tube(field_, all_of(start), duration_, limits_);
    if (!tube) return std::nullopt;
    step_ = {.tube = std::move(tube->box), .change = std::move(tube->change), .end = start};
    step_.slopes = field_.jacobian(step_.tube);
    bool held = false;
    for (std::size_t i = 0; i < field_.size(); ++i) {
      ArbSpan& span = step_.end[field_.variables()[i]];
      span = {end_of(start, i, false), end_of(start, i, true)};
      if (may_be_held(i, false) || may_be_held(i, true)) {
        held = true;
        field_.add_work(kOfHeldEnd);
        span = held_end(i, span);
      }
    }
    if (held) step_.slopes.reset();
    return std::move(step_);
  }

 private:
  /// Beside what the field does: boxes are copied for both faces of each state, and ends put together.
  [[nodiscard]] Work work_of_step(const SpanBox& start) const {
    const std::size_t n = field_.size();
    return static_cast<Work>(2 * n * (20 + 2 * start.size() + 2 * n));
  }

  [[nodiscard]] bool may_be_held(std::size_t i, bool above) const {
    const std::optional<Arb>& limit = above ? limits_[i].above : limits_[i].below;
    const Arb& tube = step_.tube[field_.variables()[i]];
    return limit && !(above ? is_below(tube.upper(), *limit) : is_below(*limit, tube.lower()));
  }

  [[nodiscard]] ArbSpan held_end(std::size_t i, ArbSpan span) const {
    const Arb zero;
    const StopLimits& limit = limits_[i];
    if (may_be_held(i, false)) {
      const Arb up = greater(zero, step_.change[i].upper());
      span.upper = greater(span.upper, *limit.below + duration_ * up).upper();
      span.lower = greater(span.lower, *limit.below).lower();
    }
    if (may_be_held(i, true)) {
      const Arb down = lesser(zero, step_.change[i].lower());
      span.lower = lesser(span.lower, *limit.above + duration_ * down).lower();
      span.upper = lesser(span.upper, *limit.above).upper();
      if (limit.below) span.lower = greater(span.lower, *limit.below).lower();
    }
    return span;
  }

  [[nodiscard]] Arb end_of(const SpanBox& start, std::size_t i, bool greatest) {
    const std::uint32_t slot = field_.variables()[i];
    const Arb from = greatest ? start[slot].upper : start[slot].lower;
    const Arb fastest = greatest ? step_.change[i].upper() : step_.change[i].lower();
    const Arb rough = from + duration_ * fastest;
    const Arb bound = step_.slopes ? along_face(start, i, greatest) : beyond_face(start, i, greatest);
    if (!bound.is_finite()) return greatest ? rough.upper() : rough.lower();
    return greatest ? lesser(rough, bound).upper() : greater(rough, bound).lower();
  }

  /// All derivatives of states are within `change`, so that the one on the moving face changes by
  /// time * slopes * change at most.
  [[nodiscard]] Arb along_face(const SpanBox& start, std::size_t i, bool greatest) {
    const std::uint32_t slot = field_.variables()[i];
    SpanBox face = start;
    face[slot] = greatest ? ArbSpan{start[slot].upper, start[slot].upper}
                          : ArbSpan{start[slot].lower, start[slot].lower};
    const Arb change = extreme_change(field_, i, face, step_.slopes, greatest, pieces_);
    Arb second;
    for (std::size_t j = 0; j < field_.size(); ++j) second = second + (*step_.slopes)(i, j) * step_.change[j];
    const Arb bend = greatest ? second.upper() : second.lower();
    return face[slot].lower + duration_ * change + duration_ * duration_ * Arb(0.5) * bend;
  }

  /// A bound without slopes: a state that is beyond the moving end has to have got there with a derivative
  /// that is taken there.
  [[nodiscard]] Arb beyond_face(const SpanBox& start, std::size_t i, bool greatest) {
    const std::uint32_t slot = field_.variables()[i];
    const Arb from = greatest ? start[slot].upper : start[slot].lower;
    const Arb moved = from + duration_ * (greatest ? step_.change[i].lower() : step_.change[i].upper());
    SpanBox beyond = start;
    for (std::size_t j = 0; j < field_.size(); ++j) {
      const Arb& all = step_.tube[field_.variables()[j]];
      beyond[field_.variables()[j]] = {all.lower(), all.upper()};
    }
    if (greatest) {
      beyond[slot].lower = lesser(from, moved).lower();
    } else {
      beyond[slot].upper = greater(from, moved).upper();
    }
    return from + duration_ * extreme_change(field_, i, beyond, std::nullopt, greatest, pieces_);
  }

  SeriesField& field_;
  const std::vector<StopLimits>& limits_;
  const Arb& duration_;
  int pieces_;
  TubeStep step_;
};

}  // namespace

std::optional<std::vector<TubeStep>> enclose_flow(SeriesField& field, const std::vector<StopLimits>& limits,
                                                  const SpanBox& start, const Arb& duration, int steps,
                                                  int pieces, const std::function<void(TubeStep&)>& narrow) {
  const Arb share = duration / Arb(static_cast<double>(steps));
  std::vector<TubeStep> result;
  const SpanBox* now = &start;
  result.reserve(static_cast<std::size_t>(steps));
  for (int step = 0; step < steps; ++step) {
    std::optional<TubeStep> next = StepMaker(field, limits, share, pieces).make(*now);
    if (!next) return std::nullopt;
    result.push_back(std::move(*next));
    if (narrow) narrow(result.back());
    now = &result.back().end;
  }
  return result;
}

}  // namespace coordreq
