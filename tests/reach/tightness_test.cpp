#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "reach/reference_flow.hpp"

namespace coordreq {
namespace {

/// A system over one cell, and by how much its enclosure may be wider than the sampled hull.
struct TightnessCase {
  const char* name;
  std::vector<std::string> equations;
  std::vector<Interval> slots;  ///< x, y, z, u, v, w, d
  double tau;
  double allowed_excess;
};

std::vector<Interval> sampled_hull(const FlowCase& system) {
  constexpr int kSamples = 9;  // a dimension; ends included
  constexpr int kSteps = 120;
  const std::size_t n = system.equations.size();
  std::vector<Interval> result(n, {outward::kInfinity, -outward::kInfinity});
  std::vector<int> counter(n);
  const std::vector<long double> low{system.slots[kDisturbanceSlot].lower, 0.0L};
  const std::vector<long double> high{system.slots[kDisturbanceSlot].upper, 0.0L};
  for (bool more = true; more;) {
    std::vector<long double> start;
    for (std::size_t i = 0; i < n; ++i) {
      start.push_back(system.slots[i].lower + counter[i] * (width(system.slots[i]) / (kSamples - 1)));
    }
    for (const Signal& signal : {Signal{low}, Signal{high}, Signal{low, high}, Signal{high, low}}) {
      const std::vector<long double> end = integrate(system, start, signal, kSteps).back();
      for (std::size_t i = 0; i < n; ++i) {
        result[i].lower = std::min(result[i].lower, static_cast<double>(end[i]));
        result[i].upper = std::max(result[i].upper, static_cast<double>(end[i]));
      }
      if (low == high) break;
    }
    more = false;
    for (std::size_t i = 0; i < n && !more; ++i) {
      counter[i] = (counter[i] + 1) % kSamples;
      more = counter[i] != 0;
    }
  }
  return result;
}

const Interval kNone{0.0, 0.0};

const std::vector<TightnessCase> kCases{
    {"drag, 0.1 wide",
     {"y", "u - 0.2*y^2"},
     {{0.0, 0.1}, {2.75, 2.85}, kNone, {1.0, 1.0}, kNone, kNone, kNone},
     0.2,
     1e-6},
    {"van der Pol, tau 0.1",
     {"y", "(1 - x^2)*y - x"},
     {{1.0, 1.1}, {0.5, 0.6}, kNone, kNone, kNone, kNone, kNone},
     0.1,
     1e-6},
    {"van der Pol, tau 1",
     {"y", "(1 - x^2)*y - x"},
     {{1.0, 1.1}, {0.5, 0.6}, kNone, kNone, kNone, kNone, kNone},
     1.0,
     0.1},
    {"van der Pol at the origin",
     {"y", "(1 - x^2)*y - x"},
     {{-0.05, 0.05}, {-0.05, 0.05}, kNone, kNone, kNone, kNone, kNone},
     0.5,
     0.02},
    {"pendulum with disturbance",
     {"y", "-sin(x) - 0.1*y + w"},
     {{1.0, 1.1}, {0.5, 0.6}, kNone, kNone, kNone, {-0.1, 0.1}, kNone},
     0.1,
     1e-4},
    {"pendulum, upright",
     {"y", "sin(x) + u*cos(x)"},
     {{-0.05, 0.05}, {-0.05, 0.05}, kNone, {1.0, 1.0}, kNone, kNone, kNone},
     0.2,
     1e-6},
    {"unicycle",
     {"u*cos(z)", "u*sin(z)", "v"},
     {{0.0, 0.2}, {0.0, 0.2}, {0.6, 0.7}, {1.0, 1.0}, {0.5, 0.5}, kNone, kNone},
     0.3,
     1e-6},
    {"unicycle, straight ahead",
     {"u*cos(z)", "u*sin(z)", "v"},
     {{0.0, 0.2}, {0.0, 0.2}, {-0.05, 0.05}, {1.0, 1.0}, {0.5, 0.5}, kNone, kNone},
     0.3,
     0.02},
    {"aircraft, relative",
     {"-5 + 5*cos(z) + u*y", "5*sin(z) - u*x", "v - u"},
     {{1.0, 1.1}, {2.0, 2.1}, {0.6, 0.687}, {1.0, 1.0}, {-1.0, -1.0}, kNone, kNone},
     0.1,
     1e-6},
    {"aircraft, parallel",
     {"-5 + 5*cos(z) + u*y", "5*sin(z) - u*x", "v - u"},
     {{1.0, 1.1}, {2.0, 2.1}, {-0.04, 0.04}, {1.0, 1.0}, {-1.0, -1.0}, kNone, kNone},
     0.1,
     0.05},
    {"Lorenz",
     {"10*(y - x)", "x*(28 - z) - y", "x*y - 8/3*z"},
     {{1.0, 1.1}, {1.0, 1.1}, {20.0, 20.1}, kNone, kNone, kNone, kNone},
     0.05,
     1e-4},
    {"two tanks",
     {"u - sqrt(max(x, 0))", "sqrt(max(x, 0)) - sqrt(max(y, 0))"},
     {{0.1, 0.2}, {0.0, 0.1}, kNone, {0.5, 0.5}, kNone, kNone, kNone},
     0.1,
     0.02},
    {"filling from empty",
     {"0.1 + sqrt(max(x, 0))"},
     {{0.0, 0.01}, kNone, kNone, kNone, kNone, kNone, kNone},
     1.0,
     0.2},
    {"saturated actuator",
     {"y", "max(-1, min(1, -2*x - 3*y))"},
     {{0.1, 0.2}, {0.2, 0.3}, kNone, kNone, kNone, kNone, kNone},
     0.1,
     0.02},
};

TEST(Tightness, EnclosuresExceedTheSampledHullByLittle) {
  std::printf("%-28s %-5s %12s %12s %10s\n", "system", "state", "sampled", "enclosed", "excess");
  for (const TightnessCase& known : kCases) {
    FlowCase system(known.equations);
    system.slots = known.slots;
    system.tau = known.tau;
    const FlowEnclosure post = system.enclosure();
    ASSERT_EQ(post.status, FlowEnclosure::Status::ok) << known.name;
    const std::vector<Interval> sampled = sampled_hull(system);
    for (std::size_t i = 0; i < sampled.size(); ++i) {
      const double excess = width(post.end[i]) / width(sampled[i]) - 1.0;
      std::printf("%-28s %-5s %12.6g %12.6g %9.4f %%\n", known.name, std::string(kFlowNames[i]).c_str(),
                  width(sampled[i]), width(post.end[i]), 100.0 * excess);
      EXPECT_GE(excess, -1e-9) << known.name;
      EXPECT_LE(excess, known.allowed_excess) << known.name;
    }
  }
}

}  // namespace
}  // namespace coordreq
