#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "reach/reference_flow.hpp"

namespace coordreq {
namespace {

/// A system over one cell.
struct TightnessCase {
  const char* name;
  std::vector<std::string> equations;
  std::vector<Interval> slots;  ///< x, y, z, u, v, w, d
  double tau;
  double most = 1.0;  ///< excess
};

/// From one end of a box to the other.
std::vector<long double> values_of(const Interval& box, int count) {
  if (box.is_point()) return {box.lower};
  std::vector<long double> result;
  for (int k = 0; k < count; ++k) result.push_back(box.lower + k * width(box) / (count - 1));
  return result;
}

/// Signals of three equal pieces, each of values from all of the disturbances' boxes.
std::vector<Signal> signals(const FlowCase& system) {
  const Interval& w = system.slots[kDisturbanceSlot];
  const Interval& d = system.slots[kDisturbanceSlot + 1];
  const int count = w.is_point() || d.is_point() ? 7 : 3;
  std::vector<std::vector<long double>> values;
  for (const long double a : values_of(w, count)) {
    for (const long double b : values_of(d, count)) values.push_back({a, b});
  }
  if (values.size() == 1) return {Signal{values.front()}};
  std::vector<Signal> result;
  for (const auto& first : values) {
    for (const auto& second : values) {
      for (const auto& third : values) result.push_back({first, second, third});
    }
  }
  return result;
}

std::vector<Interval> sampled_hull(const FlowCase& system) {
  const std::vector<Signal> all = signals(system);
  const int samples = all.size() == 1 ? 9 : 3;  // a dimension; ends included
  const int steps = all.size() == 1 ? 120 : 60;
  const std::size_t n = system.equations.size();
  std::vector<Interval> result(n, {outward::kInfinity, -outward::kInfinity});
  std::vector<int> counter(n);
  for (bool more = true; more;) {
    std::vector<long double> start;
    for (std::size_t i = 0; i < n; ++i) {
      start.push_back(system.slots[i].lower + counter[i] * (width(system.slots[i]) / (samples - 1)));
    }
    for (const Signal& signal : all) {
      const std::vector<long double> end = integrate(system, start, signal, steps).back();
      for (std::size_t i = 0; i < n; ++i) {
        result[i].lower = std::min(result[i].lower, static_cast<double>(end[i]));
        result[i].upper = std::max(result[i].upper, static_cast<double>(end[i]));
      }
    }
    more = false;
    for (std::size_t i = 0; i < n && !more; ++i) {
      counter[i] = (counter[i] + 1) % samples;
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
     0.2},
    {"van der Pol, tau 0.1",
     {"y", "(1 - x^2)*y - x"},
     {{1.0, 1.1}, {0.5, 0.6}, kNone, kNone, kNone, kNone, kNone},
     0.1},
    {"van der Pol, tau 1",
     {"y", "(1 - x^2)*y - x"},
     {{1.0, 1.1}, {0.5, 0.6}, kNone, kNone, kNone, kNone, kNone},
     1.0},
    {"van der Pol at the origin",
     {"y", "(1 - x^2)*y - x"},
     {{-0.05, 0.05}, {-0.05, 0.05}, kNone, kNone, kNone, kNone, kNone},
     0.5},
    {"pendulum with disturbance",
     {"y", "-sin(x) - 0.1*y + w"},
     {{1.0, 1.1}, {0.5, 0.6}, kNone, kNone, kNone, {-0.1, 0.1}, kNone},
     0.1},
    {"pendulum, upright",
     {"y", "sin(x) + u*cos(x)"},
     {{-0.05, 0.05}, {-0.05, 0.05}, kNone, {1.0, 1.0}, kNone, kNone, kNone},
     0.2},
    {"unicycle",
     {"u*cos(z)", "u*sin(z)", "v"},
     {{0.0, 0.2}, {0.0, 0.2}, {0.6, 0.7}, {1.0, 1.0}, {0.5, 0.5}, kNone, kNone},
     0.3},
    {"unicycle, straight ahead",
     {"u*cos(z)", "u*sin(z)", "v"},
     {{0.0, 0.2}, {0.0, 0.2}, {-0.05, 0.05}, {1.0, 1.0}, {0.5, 0.5}, kNone, kNone},
     0.3},
    {"aircraft, relative",
     {"-5 + 5*cos(z) + u*y", "5*sin(z) - u*x", "v - u"},
     {{1.0, 1.1}, {2.0, 2.1}, {0.6, 0.687}, {1.0, 1.0}, {-1.0, -1.0}, kNone, kNone},
     0.1},
    {"aircraft, parallel",
     {"-5 + 5*cos(z) + u*y", "5*sin(z) - u*x", "v - u"},
     {{1.0, 1.1}, {2.0, 2.1}, {-0.04, 0.04}, {1.0, 1.0}, {-1.0, -1.0}, kNone, kNone},
     0.1},
    {"Lorenz",
     {"10*(y - x)", "x*(28 - z) - y", "x*y - 8/3*z"},
     {{1.0, 1.1}, {1.0, 1.1}, {20.0, 20.1}, kNone, kNone, kNone, kNone},
     0.05},
    {"two tanks",
     {"u - sqrt(max(x, 0))", "sqrt(max(x, 0)) - sqrt(max(y, 0))"},
     {{0.1, 0.2}, {0.0, 0.1}, kNone, {0.5, 0.5}, kNone, kNone, kNone},
     0.1},
    {"filling from empty, `0.1 + sqrt(x)`",
     {"0.1 + sqrt(max(x, 0))"},
     {{0.0, 0.01}, kNone, kNone, kNone, kNone, kNone, kNone},
     1.0},
    {"saturated actuator",
     {"y", "max(-1, min(1, -2*x - 3*y))"},
     {{0.1, 0.2}, {0.2, 0.3}, kNone, kNone, kNone, kNone, kNone},
     0.1},
    {"`d^2 - d*x + 0.3*u`, d in [-1, 2]",
     {"d^2 - d*x + 0.3*u"},
     {{-0.1, 0.1}, kNone, kNone, kNone, kNone, kNone, {-1.0, 2.0}},
     1.0},
    {"`y*d + x*w`, `-x + u*d`, d and w in [-1, 1]",
     {"y*d + x*w", "-x + u*d"},
     {{0.45, 0.55}, {0.25, 0.35}, kNone, {-1.0, -1.0}, kNone, {-1.0, 1.0}, {-1.0, 1.0}},
     1.0,
     13.0},
    {"`9*y + u`, `-9*sin(x)`: one turn and a half",
     {"9*y + u", "-9*sin(x)"},
     {{0.75, 0.85}, {0.25, 0.35}, kNone, {1.0, 1.0}, kNone, kNone, kNone},
     1.0},
    {"friction, `u - 0.5*sign(y)`, coming to rest",
     {"y", "u - 0.5*sign(y)"},
     {{0.0, 0.1}, {0.15, 0.25}, kNone, {0.25, 0.25}, kNone, kNone, kNone},
     0.8},
    {"stiff, `-1e5*(x - sin(y))`",
     {"-1e5*(x - sin(y))", "u"},
     {{0.15, 0.25}, {0.2, 0.3}, kNone, {1.0, 1.0}, kNone, kNone, kNone},
     0.0005},
};

struct Row {
  std::string text;
  double excess = 0.0;  ///< in widths of the initial box
};

/// A line of the table, for the state with the largest excess.
Row row_of(const TightnessCase& known) {
  FlowCase system(known.equations);
  system.slots = known.slots;
  system.tau = known.tau;
  const FlowEnclosure post = system.enclosure();
  EXPECT_EQ(post.status, FlowEnclosure::Status::ok) << known.name;
  const std::vector<Interval> reached = sampled_hull(system);
  Row worst{{}, -1.0};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    EXPECT_LE(post.end[i].lower, reached[i].lower + 1e-9) << known.name;
    EXPECT_GE(post.end[i].upper, reached[i].upper - 1e-9) << known.name;
    const double excess = (width(post.end[i]) - width(reached[i])) / width(known.slots[i]);
    if (excess <= worst.excess) continue;
    const auto rounded = [](double x) { return std::fabs(x) < 5e-4 ? 0.0 : x; };
    worst = {fmt::format("| {} | {} | [{:.3f}, {:.3f}] | [{:.3f}, {:.3f}] | {:.2f} |", known.name,
                         kFlowNames[i], rounded(post.end[i].lower), rounded(post.end[i].upper),
                         rounded(reached[i].lower), rounded(reached[i].upper), std::max(excess, 0.0)),
             excess};
  }
  return worst;
}

std::string page() {
  std::ifstream file(COORDREQ_ROOT "/docs/explanation/guarantees.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Tightness, IsAsThePageSays) {
  const std::string text = page();
  ASSERT_FALSE(text.empty());
  for (const TightnessCase& known : kCases) {
    const Row row = row_of(known);
    const std::string shown = row.excess < 0.005 ? known.name : row.text + "\n";
    EXPECT_NE(text.find(shown), std::string::npos) << "not in docs/explanation/guarantees.md:\n" << row.text;
    EXPECT_LE(row.excess, known.most) << known.name;
  }
}

}  // namespace
}  // namespace coordreq
