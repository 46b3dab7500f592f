#include "verify/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace coordreq {
namespace {

/// Higher ones pay only where more is wanted.
slong order_for(double tolerance) {
  return tolerance > 1e-6 ? 7 : 10;
}

constexpr int kPicardTries = 30;
constexpr Work kOfPicard = 12;  ///< operations of a try, a state, beside its derivative
constexpr Work kOfLimit = 16;   ///< and more where it may be held at a limit
constexpr std::size_t kMostKnown = 1 << 14;

Arb from_zero(const Arb& duration) {
  return hull(Arb(), duration);
}

Arb widened(Arb a) {
  const Arb margin(0.1 * a.width() + 1e-12 * std::abs(a.approximately()) + 1e-300);
  arb_add_error_arf(a.get(), arb_midref(margin.get()));
  return a;
}

int compare(const Arb& a, const Arb& b) {
  const int middles = arf_cmp(arb_midref(a.get()), arb_midref(b.get()));
  return middles != 0 ? middles : mag_cmp(arb_radref(a.get()), arb_radref(b.get()));
}

/// Whether a state in `range` may be held at a limit.
bool touches(const StopLimits& limits, const Arb& range) {
  return (limits.below && !is_below(*limits.below, range.lower())) ||
         (limits.above && !is_below(range.upper(), *limits.above));
}

Arb within(const StopLimits& limits, const Arb& range) {
  Arb lower = range.lower();
  Arb upper = range.upper();
  if (limits.below) lower = greater(lower, *limits.below).lower();
  if (limits.above) upper = lesser(upper, *limits.above).upper();
  return hull(lower, upper);
}

}  // namespace

std::optional<Tube> picard_tube(SeriesField& field, const ArbBox& start, const Arb& duration,
                                const std::vector<StopLimits>& limits) {
  Tube tube{.box = start, .change = std::vector<Arb>(field.size())};
  const Arb time = from_zero(duration);
  std::vector<Arb> next(field.size());
  for (int attempt = 0; attempt < kPicardTries; ++attempt) {
    field.add_work(kOfPicard * static_cast<Work>(field.size()));
    bool inside = true;
    for (std::size_t i = 0; i < field.size(); ++i) {
      const std::uint32_t slot = field.variables()[i];
      tube.change[i] = field.value(i, tube.box);
      if (!tube.change[i].is_finite()) return std::nullopt;
      const bool may_be_held = !limits.empty() && touches(limits[i], tube.box[slot]);
      if (may_be_held) {
        field.add_work(kOfLimit);
        tube.change[i] = hull(tube.change[i], Arb());
      }
      next[i] = start[slot] + time * tube.change[i];
      if (may_be_held) next[i] = within(limits[i], next[i]);
      inside = inside && tube.box[slot].holds(next[i]);
    }
    if (inside) {
      // The box that the solutions move on to is a tube as well, and a narrower one.
      for (std::size_t i = 0; i < field.size(); ++i) tube.box[field.variables()[i]] = std::move(next[i]);
      return tube;
    }
    for (std::size_t i = 0; i < field.size(); ++i) {
      const std::uint32_t slot = field.variables()[i];
      tube.box[slot] = hull(tube.box[slot], widened(hull(start[slot], next[i])));
      if (limits.empty()) continue;
      // Only there are ends of balls exact.
      if (limits[i].below && limits[i].below->is_zero())
        tube.box[slot] = ending_at_zero(tube.box[slot], true);
      if (limits[i].above && limits[i].above->is_zero())
        tube.box[slot] = ending_at_zero(tube.box[slot], false);
    }
  }
  return std::nullopt;
}

bool Trajectory::Order::operator()(const ArbBox& a, const ArbBox& b) const {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](const Arb& x, const Arb& y) { return compare(x, y) < 0; });
}

bool Trajectory::advance(ArbBox& box, const Arb& duration, double tolerance) {
  if (known_.size() > kMostKnown) known_.clear();
  ArbBox key = box;
  key.push_back(duration);
  key.emplace_back(tolerance);
  const auto [entry, is_new] = known_.try_emplace(std::move(key));
  Known& known = entry->second;
  if (is_new) {
    const Work before = field_->work();
    ArbBox end = box;
    if (integrate(end, duration, tolerance)) known.end = std::move(end);
    known.work = field_->work() - before;
  } else {
    field_->add_work(known.work);  // what is remembered costs as much: so others have no say in the budget
  }
  if (field_->is_spent()) {
    if (is_new) known_.erase(entry);  // another question may have more work left
    return false;
  }
  if (!known.end) return false;
  box = *known.end;
  return true;
}

bool Trajectory::integrate(ArbBox& box, const Arb& duration, double tolerance, int most) {
  std::uint32_t left = kFinest;
  std::uint32_t units = kFinest;  // not what did before: that would let one question change another
  may_double_ = true;
  while (left > 0) {
    if (--most < 0 || field_->is_spent()) return false;
    units = std::min(units, left);
    const Arb share(static_cast<double>(units) / kFinest);
    std::optional<ArbBox> next = step(box, duration * share, tolerance * share.approximately(), units == 1);
    if (next) {
      box = std::move(*next);
      left -= units;
      if (left % (2 * units) == 0 && may_double_) units *= 2;
    } else if (units > 1) {
      units /= 2;
    } else {
      return false;
    }
  }
  return true;
}

std::optional<ArbBox> Trajectory::step(const ArbBox& box, const Arb& duration, double tolerance,
                                       bool last_try) {
  const std::optional<Tube> tube = picard_tube(*field_, box, duration);
  if (!tube) return std::nullopt;
  if (std::optional<ArbBox> end = analytic_step(box, tube->box, duration, tolerance, order_for(tolerance)))
    return end;
  may_double_ = true;
  const ArbBox end = kinked_step(box, tube->box, tube->change, duration);
  for (std::size_t i = 0; i < field_->size() && !last_try; ++i) {
    const std::uint32_t slot = field_->variables()[i];
    if (end[slot].width() - box[slot].width() > tolerance) return std::nullopt;
  }
  return end;
}

std::optional<ArbBox> Trajectory::analytic_step(const ArbBox& box, const ArbBox& tube, const Arb& duration,
                                                double tolerance, slong terms) {
  const std::optional<std::vector<ArbSeries>> rest = field_->taylor(tube, terms + 1);
  if (!rest) return std::nullopt;
  Arb power;
  arb_pow_ui(power.get(), duration.get(), static_cast<ulong>(terms), kArbBits);
  std::vector<Arb> remainder;
  double most = 0.0;
  for (const ArbSeries& series : *rest) {
    remainder.push_back(series[terms] * power);
    most = std::max(most, remainder.back().width());
    if (!(most <= tolerance)) return std::nullopt;
  }
  // Twice the time has 2^terms times the remainder, and twice the tolerance.
  may_double_ = std::ldexp(most, static_cast<int>(terms)) <= tolerance;
  const std::optional<std::vector<ArbSeries>> series = field_->taylor(box, terms);
  if (!series) return std::nullopt;
  ArbBox end = box;
  for (std::size_t i = 0; i < series->size(); ++i) {
    Arb value;
    arb_poly_evaluate(value.get(), (*series)[i].get(), duration.get(), kArbBits);
    end[field_->variables()[i]] = value + remainder[i];
  }
  return end;
}

/// x(h) is in x + h f(x) + h^2 / 2 J f(tube), J the slopes over the tube; where there are none in x + h
/// f(tube).
ArbBox Trajectory::kinked_step(const ArbBox& box, const ArbBox& tube, const std::vector<Arb>& change,
                               const Arb& duration) {
  ArbBox end = box;
  const Arb half_square = duration * duration * Arb(0.5);
  for (std::size_t i = 0; i < field_->size(); ++i) {
    const std::uint32_t slot = field_->variables()[i];
    end[slot] = box[slot] + duration * change[i];
    const std::optional<std::vector<Arb>> slopes = field_->slopes(i, tube);
    if (!slopes) continue;
    Arb second;
    for (std::size_t j = 0; j < field_->size(); ++j) second = second + (*slopes)[j] * change[j];
    const Arb better = box[slot] + duration * field_->value(i, box) + half_square * second;
    if (better.is_finite() && better.width() < end[slot].width()) end[slot] = better;
  }
  return end;
}

}  // namespace coordreq
