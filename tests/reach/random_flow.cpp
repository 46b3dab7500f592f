#include "reach/random_flow.hpp"

#include <rapidcheck.h>

#include <algorithm>
#include <array>

namespace coordreq {
namespace {

std::string random_leaf(int states) {
  constexpr std::array<const char*, 5> kNumbers{"1", "2", "0.5", "0.1", "3"};
  const int which = pick(10);
  if (which < 5) return std::string(kFlowNames[static_cast<std::size_t>(pick(states))]);
  if (which < 8) return std::string(kFlowNames[kInputSlot + static_cast<std::size_t>(pick(4))]);
  return kNumbers[static_cast<std::size_t>(pick(5))];
}

std::string smooth_term(int which, int depth, int states, Roughness roughness) {
  const auto next = [&] { return random_field(depth - 1, states, roughness); };
  switch (which) {
    case 0:
    case 1:
      return "(" + next() + " + " + next() + ")";
    case 2:
      return "(" + next() + " - " + next() + ")";
    case 3:
    case 4:
      return "(" + next() + " * " + next() + ")";
    case 5:
      return "(" + next() + " / (2 + (" + next() + ")^2))";
    case 6:
      return "sin(" + next() + ")";
    case 7:
      return "cos(" + next() + ")";
    case 8:
      return "exp(sin(" + next() + "))";
    case 9:
      return "atan(" + next() + ")";
    case 10:
      return "(" + next() + ")^" + std::to_string(2 + pick(3));
    case 11:
      return "sqrt(1 + (" + next() + ")^2)";
    case 12:
      return "log(2 + (" + next() + ")^2)";
    case 13:
      return "tanh(" + next() + ")";
    case 14:
      return "tan(0.5*sin(" + next() + "))";
    case 15:
      return "asin(0.5*sin(" + next() + "))";
    case 16:
      return "(1 + (" + next() + ")^2)^-0.5";
    case 17:
      return "cosh(sin(" + next() + "))";
    case 18:
      return "atan2(" + next() + ", 1 + (" + next() + ")^2)";
    default:
      return "-" + next();
  }
}

std::string rough_term(int which, int depth, int states, Roughness roughness) {
  const auto next = [&] { return random_field(depth - 1, states, roughness); };
  switch (which) {
    case 0:
      return "abs(" + next() + ")";
    case 1:
      return "min(" + next() + ", " + next() + ")";
    case 2:
      return "max(" + next() + ", " + next() + ")";
    case 3:
      return "sign(" + next() + ")";
    case 4:
      return "floor(" + next() + ")";
    case 5:
      return "atan2(" + next() + ", 0.3 + " + next() + ")";
    default:
      return "if(" + next() + (pick(2) == 0 ? " > " : " <= ") + next() + ", " + next() + ", " + next() + ")";
  }
}

Interval random_range() {
  const double lower = pick_between(-2.0, 2.0);
  return {lower, lower + std::array<double, 4>{0.0, 0.1, 0.25, 1.0}[static_cast<std::size_t>(pick(4))]};
}

long double point_of(const Interval& range, int where) {
  if (where == 0) return range.lower;
  if (where == 1) return range.upper;
  if (where == 2) return 0.5L * range.lower + 0.5L * range.upper;
  return pick_between(range.lower, range.upper, 101);
}

}  // namespace

int pick(int count) {
  // At full size: RapidCheck would begin with the low end of every range.
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, count));
}

double pick_between(double lower, double upper, int count) {
  const double share = static_cast<double>(pick(count)) / (count - 1);
  return std::clamp(lower + share * (upper - lower), lower, upper);
}

std::string random_field(int depth, int states, Roughness roughness) {
  if (depth == 0 || pick(6) == 0) return random_leaf(states);
  const bool rough = roughness != Roughness::smooth && pick(4) == 0;
  if (rough) return rough_term(pick(roughness == Roughness::lipschitz ? 3 : 7), depth, states, roughness);
  return smooth_term(pick(20), depth, states, roughness);
}

FlowCase random_case(Roughness roughness) {
  const int states = 1 + pick(3);
  std::vector<std::string> equations;
  for (int i = 0; i < states; ++i) equations.push_back(random_field(pick(4), states, roughness));
  FlowCase result(equations);
  for (std::size_t s = 0; s < result.slots.size(); ++s) {
    const bool input = s >= kInputSlot && s < kDisturbanceSlot;
    const double value = pick_between(-2.0, 2.0);
    result.slots[s] = input ? Interval{value, value} : random_range();
  }
  result.tau = std::array<double, 5>{0.01, 0.1, 0.2, 0.5, 1.0}[static_cast<std::size_t>(pick(5))];
  return result;
}

std::vector<long double> random_start(const FlowCase& system) {
  std::vector<long double> start;
  const int style = pick(4);
  for (std::size_t i = 0; i < system.equations.size(); ++i) {
    const int where = style == 0 ? pick(2) : style == 1 ? 2 : pick(4);
    long double value = point_of(system.slots[i], where);
    if (!system.stops.empty()) {
      const FlowSystem::Limit& limit = system.stops[i];
      if (limit.above) value = std::min<long double>(value, limit.upper.lower);
      if (limit.below) value = std::max<long double>(value, limit.lower.upper);
    }
    start.push_back(value);
  }
  return start;
}

Signal random_signal(const FlowCase& system) {
  Signal signal(static_cast<std::size_t>(1 + pick(7)));
  for (std::vector<long double>& values : signal) {
    for (std::size_t s = kDisturbanceSlot; s < kFlowNames.size(); ++s) {
      values.push_back(point_of(system.slots[s], pick(4)));
    }
  }
  return signal;
}

}  // namespace coordreq
