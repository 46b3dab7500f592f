#include "verify/time_series.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace coordreq {
namespace {

constexpr double kMostPower = 16;
using Series = std::vector<Interval>;

Interval whole_number(std::size_t n) {
  const auto value = static_cast<double>(n);
  return {value, value};
}

/// sum_{j = first}^{last} a_j b_{k - j}
Interval convolution(const Series& a, const Series& b, std::size_t k, std::size_t first, std::size_t last) {
  Interval sum{0.0, 0.0};
  for (std::size_t j = first; j <= last; ++j) sum = sum + a[j] * b[k - j];
  return sum;
}

/// (1 / k) sum_{j = 1}^{k} j a_j q_{k - j}: coefficient k of the integral of a' q.
Interval integrated(const Series& a, const Series& q, std::size_t k) {
  Interval sum{0.0, 0.0};
  for (std::size_t j = 1; j <= k; ++j) sum = sum + whole_number(j) * a[j] * q[k - j];
  return sum / whole_number(k);
}

/// Coefficient k of the y with y' q = a', given y_0, ..., y_{k-1}; 0 for k = 0.
Interval divided(const Series& a, const Series& q, const Series& y, std::size_t k) {
  Interval sum = whole_number(k) * a[k];
  for (std::size_t j = 1; j < k; ++j) sum = sum - whole_number(j) * y[j] * q[k - j];
  return sum / (whole_number(k) * q[0]);
}

Interval square(const Series& a, std::size_t k) {
  return k == 0 ? sqr(a[0]) : convolution(a, a, k, 0, k);
}

Interval root(const Series& a, const Series& y, std::size_t k) {
  if (k == 0) return sqrt(a[0]);
  const Interval sum = k > 1 ? a[k] - convolution(y, y, k, 1, k - 1) : a[k];
  return sum / (Interval{2.0, 2.0} * y[0]);
}

bool is_usable(const Interval& a) {
  return a.total && std::isfinite(a.lower) && std::isfinite(a.upper);
}

}  // namespace

TimeSeries::TimeSeries(std::vector<const Program*> equations, std::vector<std::uint32_t> slots)
    : slots_(std::move(slots)), states_(slots_.size(), Series(kOrder + 1)) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (state_of_slot_.size() <= slots_[i]) state_of_slot_.resize(slots_[i] + std::size_t{1}, -1);
    state_of_slot_[slots_[i]] = static_cast<std::int32_t>(i);
  }
  for (const Program* program : equations) {
    Equation& equation = equations_.emplace_back(Equation{.program = program});
    plain_.emplace_back(*program);
    for (const Rational& q : program->constants) equation.constants.push_back(enclose(q));
    equation.nodes.resize(program->nodes.size());
    for (Node& node : equation.nodes) {
      node.value.resize(kOrder + 1);
      node.second.resize(kOrder + 1);
      node.third.resize(kOrder + 1);
    }
    // a^2 needs nothing but a; a^n the powers between.
    for (std::size_t n = 0; n < program->nodes.size(); ++n) {
      if (program->nodes[n].op == Operator::power)
        equation.nodes[n].powers.assign(static_cast<std::size_t>(kMostPower) + 1, Series(kOrder + 1));
    }
  }
}

bool TimeSeries::expand(std::span<const Interval> box) {
  for (std::size_t i = 0; i < slots_.size(); ++i) states_[i][0] = box[slots_[i]];
  for (std::size_t k = 0; k < kOrder; ++k) {
    for (Equation& equation : equations_) {
      if (!extend(equation, box, k)) return false;
    }
    for (std::size_t i = 0; i < slots_.size(); ++i)
      states_[i][k + 1] = equations_[i].nodes.back().value[k] / whole_number(k + 1);
  }
  return true;
}

void TimeSeries::derivative(std::span<const Interval> box, std::span<Interval> out) {
  for (std::size_t i = 0; i < slots_.size(); ++i) out[i] = plain_[i].number(box);
}

bool TimeSeries::extend(Equation& equation, std::span<const Interval> box, std::size_t k) {
  for (std::size_t n = 0; n < equation.nodes.size(); ++n) {
    if (is_condition(equation.program->nodes[n].op)) {
      if (k == 0 && !extend_condition(equation, n, k)) return false;
    } else if (!extend_node(equation, n, box, k) || !is_usable(equation.nodes[n].value[k])) {
      return false;
    }
  }
  return true;
}

/// Conditions have to be the same over all of the box; then they are along all solutions in it.
bool TimeSeries::extend_condition(Equation& equation, std::size_t n, std::size_t k) {
  const Program::Node& node = equation.program->nodes[n];
  const auto truth = [&](std::uint32_t i) { return equation.nodes[i].truth; };
  Truth& result = equation.nodes[n].truth;
  switch (node.op) {
    case Operator::logical_and:
      result = truth_and(truth(node.a), truth(node.b));
      break;
    case Operator::logical_or:
      result = truth_or(truth(node.a), truth(node.b));
      break;
    case Operator::logical_not:
      result = !truth(node.a);
      break;
    case Operator::literal_true:
    case Operator::literal_false:
      result = to_truth(node.op == Operator::literal_true);
      break;
    default:
      result = compare(node.op, equation.nodes[node.a].value[k], equation.nodes[node.b].value[k]);
  }
  return result != Truth::undecided;
}

bool TimeSeries::extend_node(Equation& equation, std::size_t n, std::span<const Interval> box,
                             std::size_t k) {
  const Program::Node& node = equation.program->nodes[n];
  Node& result = equation.nodes[n];
  const Interval zero{0.0, 0.0};
  if (node.op == Operator::constant) {
    result.value[k] = k == 0 ? equation.constants[node.a] : zero;
    return true;
  }
  if (node.op == Operator::variable) {
    const std::int32_t state = node.a < state_of_slot_.size() ? state_of_slot_[node.a] : -1;
    if (state >= 0) {
      result.value[k] = states_[static_cast<std::size_t>(state)][k];
    } else {
      result.value[k] = k == 0 ? box[node.a] : zero;
    }
    return true;
  }
  const Node& a = equation.nodes[node.a];
  const Node& b = equation.nodes[node.b];
  switch (node.op) {
    case Operator::add:
      result.value[k] = a.value[k] + b.value[k];
      return true;
    case Operator::subtract:
      result.value[k] = a.value[k] - b.value[k];
      return true;
    case Operator::multiply:
      result.value[k] = node.a == node.b ? square(a.value, k) : convolution(a.value, b.value, k, 0, k);
      return true;
    case Operator::divide:
      result.value[k] = k == 0 ? a.value[0] / b.value[0]
                               : (a.value[k] - convolution(result.value, b.value, k, 0, k - 1)) / b.value[0];
      return true;
    case Operator::power:
      return extend_power(result, a, b, k);
    case Operator::minimum:
    case Operator::maximum:
    case Operator::if_else:
      return extend_choice(node, equation, result, k);
    default:
      return extend_function(node, result, a, k);
  }
}

/// a^n for small whole n by multiplication, which also works where a may be 0.
bool TimeSeries::extend_power(Node& result, const Node& a, const Node& b, std::size_t k) {
  const Interval& exponent = b.value[0];
  if (!exponent.is_point()) return false;
  for (std::size_t j = 1; j <= k; ++j) {
    if (b.value[j].lower != 0.0 || b.value[j].upper != 0.0) return false;
  }
  const double n = exponent.lower;
  if (n == 2.0) {
    result.value[k] = square(a.value, k);
    return true;
  }
  if (n == std::floor(n) && n >= 1.0 && n <= kMostPower) {
    result.powers[1][k] = a.value[k];
    for (std::size_t m = 2; m <= static_cast<std::size_t>(n); ++m)
      result.powers[m][k] = convolution(result.powers[m - 1], a.value, k, 0, k);
    result.value[k] = result.powers[static_cast<std::size_t>(n)][k];
    if (k == 0) result.value[0] = power(a.value[0], n);
    return true;
  }
  if (k == 0) {
    result.value[0] = pow(a.value[0], exponent);
    return true;
  }
  Interval sum{0.0, 0.0};
  for (std::size_t j = 0; j < k; ++j) {
    const Interval weight = exponent * whole_number(k - j) - whole_number(j);
    sum = sum + weight * a.value[k - j] * result.value[j];
  }
  result.value[k] = sum / (whole_number(k) * a.value[0]);
  return true;
}

/// min, max and if: one of their operands, the same over all of the box.
bool TimeSeries::extend_choice(const Program::Node& node, Equation& equation, Node& result,
                               std::size_t k) const {
  const Node& a = equation.nodes[node.a];
  const Node& b = equation.nodes[node.b];
  if (node.op == Operator::if_else) {
    result.value[k] = a.truth == Truth::yes ? b.value[k] : equation.nodes[node.c].value[k];
    return true;
  }
  const bool least = node.op == Operator::minimum;
  const Truth first = compare(least ? Operator::less_equal : Operator::greater_equal, a.value[0], b.value[0]);
  if (k == 0) result.truth = first;
  result.value[k] = result.truth == Truth::yes ? a.value[k] : b.value[k];
  return result.truth != Truth::undecided;
}

bool TimeSeries::extend_function(const Program::Node& node, Node& result, const Node& a, std::size_t k) {
  const Interval one{1.0, 1.0};
  const Interval start = k == 0 ? apply(node.op, a.value[0]) : Interval{0.0, 0.0};
  switch (node.op) {
    case Operator::negate:
      result.value[k] = -a.value[k];
      return true;
    case Operator::absolute:
    case Operator::sign: {
      // An upper end of 0 is left to smaller boxes: a part of them must not choose the other side.
      if (a.value[0].lower < 0.0 && a.value[0].upper >= 0.0) return false;
      const bool positive = a.value[0].lower >= 0.0;
      if (node.op == Operator::absolute) result.value[k] = positive ? a.value[k] : -a.value[k];
      if (node.op == Operator::sign) result.value[k] = start;
      return node.op == Operator::absolute || result.value[0].is_point();
    }
    case Operator::exponential:
      result.value[k] = k == 0 ? start : integrated(a.value, result.value, k);
      return true;
    case Operator::logarithm:
      result.value[k] = k == 0 ? start : divided(a.value, a.value, result.value, k);
      return true;
    case Operator::square_root:
      result.value[k] = root(a.value, result.value, k);
      return true;
    case Operator::sine:
      result.value[k] = k == 0 ? start : integrated(a.value, result.second, k);
      result.second[k] = k == 0 ? cos(a.value[0]) : -integrated(a.value, result.value, k);
      return true;
    case Operator::cosine:
      result.value[k] = k == 0 ? start : -integrated(a.value, result.second, k);
      result.second[k] = k == 0 ? sin(a.value[0]) : integrated(a.value, result.value, k);
      return true;
    case Operator::hyperbolic_sine:
    case Operator::hyperbolic_cosine:
      result.value[k] = k == 0 ? start : integrated(a.value, result.second, k);
      result.second[k] = k > 0                                  ? integrated(a.value, result.value, k)
                         : node.op == Operator::hyperbolic_sine ? cosh(a.value[0])
                                                                : sinh(a.value[0]);
      return true;
    case Operator::tangent:
    case Operator::hyperbolic_tangent: {
      result.value[k] = k == 0 ? start : integrated(a.value, result.second, k);
      const Interval squared = square(result.value, k);
      const Interval constant = k == 0 ? one : Interval{0.0, 0.0};
      result.second[k] = node.op == Operator::tangent ? constant + squared : constant - squared;
      return true;
    }
    case Operator::arctangent:
      result.second[k] = (k == 0 ? one : Interval{0.0, 0.0}) + square(a.value, k);
      result.value[k] = k == 0 ? start : divided(a.value, result.second, result.value, k);
      return true;
    case Operator::arcsine:
    case Operator::arccosine:
      result.third[k] = (k == 0 ? one : Interval{0.0, 0.0}) - square(a.value, k);
      result.second[k] = root(result.third, result.second, k);
      if (k == 0) {
        result.value[0] = start;
      } else {
        // y' sqrt(1 - a^2) = +-a'; `divided` would need y with the sign of arcsine.
        Interval sum = whole_number(k) * (node.op == Operator::arcsine ? a.value[k] : -a.value[k]);
        for (std::size_t j = 1; j < k; ++j)
          sum = sum - whole_number(j) * result.value[j] * result.second[k - j];
        result.value[k] = sum / (whole_number(k) * result.second[0]);
      }
      return true;
    default:
      return false;
  }
}

}  // namespace coordreq
