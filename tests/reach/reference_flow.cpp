#include "reach/reference_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coordreq {
namespace {

constexpr long double kUndefined = std::numeric_limits<long double>::quiet_NaN();
using States = std::vector<long double>;

class ReferenceFlow {
 public:
  explicit ReferenceFlow(const FlowCase& system) : system_(system), slots_(system.slots.size()) {
    for (const Program& equation : system.equations) equations_.emplace_back(equation);
    for (std::size_t s = 0; s < slots_.size(); ++s) slots_[s].value = system.slots[s].lower;
  }

  void set_disturbance(const std::vector<long double>& values) {
    for (std::size_t l = 0; l < values.size(); ++l) slots_[kDisturbanceSlot + l].value = values[l];
  }

  /// In halves, and so on, where the slope changes much on the way.
  void step(States& x, long double h, int halvings = 0) {
    const States k1 = derivative(x);
    const States k2 = derivative(moved(x, k1, h / 2));
    if (halvings < kMostHalvings && is_rough(x, k1, k2, h)) {
      step(x, h / 2, halvings + 1);
      step(x, h / 2, halvings + 1);
      return;
    }
    const States k3 = derivative(moved(x, k2, h / 2));
    const States k4 = derivative(moved(x, k3, h));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    x = stopped(x);
  }

 private:
  static constexpr int kMostHalvings = 14;

  static bool is_rough(const States& x, const States& k1, const States& k2, long double h) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!(h * std::fabs(k2[i] - k1[i]) <= 0.01L * (1.0L + std::fabs(x[i])))) return true;
    }
    return false;
  }

  States moved(const States& x, const States& slope, long double h) const {
    States result = x;
    for (std::size_t i = 0; i < x.size(); ++i) result[i] += h * slope[i];
    return stopped(result);
  }

  States stopped(States x) const {
    for (std::size_t i = 0; i < system_.stops.size(); ++i) {
      const FlowSystem::Limit& limit = system_.stops[i];
      if (limit.above) x[i] = std::min<long double>(x[i], limit.upper.lower);
      if (limit.below) x[i] = std::max<long double>(x[i], limit.lower.upper);
    }
    return x;
  }

  States derivative(const States& x) {
    for (std::size_t i = 0; i < x.size(); ++i) slots_[i].value = x[i];
    States result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      result[i] = equations_[i].number(slots_).value;
      if (system_.stops.empty()) continue;
      const FlowSystem::Limit& limit = system_.stops[i];
      if (limit.above && x[i] >= limit.upper.lower) result[i] = std::min(result[i], 0.0L);
      if (limit.below && x[i] <= limit.lower.upper) result[i] = std::max(result[i], 0.0L);
    }
    return result;
  }

  const FlowCase& system_;
  std::vector<Evaluator<Real>> equations_;
  std::vector<Real> slots_;
};

long double power(long double a, long double b) {
  if (std::isnan(a) || std::isnan(b) || (a == 0.0L && b < 0.0L)) return kUndefined;
  return std::pow(a, b);
}

}  // namespace

Real from_rational(const Real* /*tag*/, const Rational& q) {
  const double high = nearest_double(q);
  return {static_cast<long double>(high) + static_cast<long double>(nearest_double(q - exact(high)))};
}

Real apply(Operator op, const Real& a) {
  const long double x = a.value;
  switch (op) {
    case Operator::negate:
      return {-x};
    case Operator::sine:
      return {std::sin(x)};
    case Operator::cosine:
      return {std::cos(x)};
    case Operator::tangent:
      return {std::tan(x)};
    case Operator::arcsine:
      return {std::asin(x)};
    case Operator::arccosine:
      return {std::acos(x)};
    case Operator::arctangent:
      return {std::atan(x)};
    case Operator::hyperbolic_sine:
      return {std::sinh(x)};
    case Operator::hyperbolic_cosine:
      return {std::cosh(x)};
    case Operator::hyperbolic_tangent:
      return {std::tanh(x)};
    case Operator::exponential:
      return {std::exp(x)};
    case Operator::logarithm:
      return {x > 0.0L ? std::log(x) : kUndefined};
    case Operator::square_root:
      return {std::sqrt(x)};
    case Operator::absolute:
      return {std::fabs(x)};
    case Operator::sign:
      return {std::isnan(x) ? x : x > 0.0L ? 1.0L : x < 0.0L ? -1.0L : 0.0L};
    case Operator::floor:
      return {std::floor(x)};
    default:
      return {kUndefined};
  }
}

Real apply(Operator op, const Real& a, const Real& b) {
  const long double x = a.value;
  const long double y = b.value;
  switch (op) {
    case Operator::add:
      return {x + y};
    case Operator::subtract:
      return {x - y};
    case Operator::multiply:
      return {x * y};
    case Operator::divide:
      return {y == 0.0L ? kUndefined : x / y};
    case Operator::power:
      return {power(x, y)};
    case Operator::angle:
      return {x == 0.0L && y == 0.0L ? kUndefined : std::atan2(x + 0.0L, y + 0.0L)};
    case Operator::minimum:
      return {std::isnan(y) || y < x ? y : x};
    case Operator::maximum:
      return {std::isnan(y) || y > x ? y : x};
    default:
      return {kUndefined};
  }
}

Truth compare(Operator op, const Real& a, const Real& b) {
  return truth_of(op, {a.value<b.value, a.value> b.value, a.value <= b.value, a.value >= b.value});
}

Real select(Truth condition, const Real& a, const Real& b) {
  if (condition == Truth::undecided) return {kUndefined};
  return condition == Truth::yes ? a : b;
}

std::vector<std::vector<long double>> integrate(const FlowCase& system, const std::vector<long double>& start,
                                                const Signal& signal, int steps) {
  ReferenceFlow flow(system);
  std::vector<States> path{start};
  States x = start;
  const long double h = static_cast<long double>(system.tau) / steps;
  for (int k = 0; k < steps; ++k) {
    flow.set_disturbance(
        signal[static_cast<std::size_t>(k) * signal.size() / static_cast<std::size_t>(steps)]);
    flow.step(x, h);
    path.push_back(x);
  }
  return path;
}

}  // namespace coordreq
