#include "reach/taylor_step.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reach/jacobian.hpp"
#include "reach/reference_flow.hpp"
#include "reach/sensitivity.hpp"

namespace coordreq {
namespace {

/// Steps of x' = cos(y), y' = 40 from a box.
class Turning {
 public:
  Turning()
      : known_({"cos(y)", "40"}),
        system_(known_.system()),
        tape_(system_.equations, system_.state_slots, system_.disturbance_slots),
        field_(system_, tape_),
        step_(tape_),
        choices_(tape_.nodes.size()) {
    known_.slots[1] = {1.0, 1.5};
    field_.begin(known_.slots);
  }

  /// @returns whether there is a remainder within the tolerance
  bool try_step(double duration) {
    std::vector<Interval> box(2);
    std::vector<Interval> derivative(2);
    const std::vector<Interval> start{known_.slots[0], known_.slots[1]};
    EXPECT_FALSE(field_.enclose_solutions(start, Interval(duration), box, derivative));
    EXPECT_TRUE(decide(tape_, field_.values(), choices_));
    step_.begin(field_, choices_, {false, false});
    TaylorRemainder remainder;
    step_.find_remainder(Interval(duration), kTolerance, remainder);
    return remainder.order > 0;
  }
  bool could_be_doubled(double duration) { return step_.could_be_doubled(Interval(duration), kTolerance); }

 private:
  inline static const std::vector<double> kTolerance{1e-9, 1e-9};

  FlowCase known_;
  FlowSystem system_;
  FlowTape tape_;
  VectorField field_;
  TaylorStep step_;
  Choices choices_;
};

TEST(TaylorStep, OfWhichTwiceIsRuledOutHasNoRemainderAtTwiceTheDuration) {
  Turning turning;
  int ruled_out = 0;
  int doubled = 0;
  for (double duration = 1e-3; duration < 0.1; duration *= 1.03) {
    if (!turning.try_step(duration)) continue;
    const bool possible = turning.could_be_doubled(duration);
    const bool found = turning.try_step(2.0 * duration);
    EXPECT_TRUE(possible || !found) << duration;
    if (!possible) ++ruled_out;
    if (found) ++doubled;
  }
  EXPECT_GT(ruled_out, 10);
  EXPECT_GT(doubled, 10);
}

std::optional<FlowTape> tape_with_tangents(const FlowSystem& system) {
  std::vector<std::uint32_t> slots(system.equations.size());
  std::iota(slots.begin(), slots.end(), static_cast<std::uint32_t>(system.slot_count));
  return FlowTape::with_tangents(system.equations, system.state_slots, slots);
}

/// What a step from a box leads to, by an interval Jacobian and narrowed by tangents.
std::pair<UpwardMatrix, UpwardMatrix> step_of(const FlowCase& flow, const std::vector<Interval>& start) {
  FlowSystem system = flow.system();
  system.disturbance_slots.clear();
  const FlowTape tape(system.equations, system.state_slots, {});
  VectorField field(system, tape);
  Jacobian jacobian(system, tape);
  field.begin(flow.slots);
  jacobian.begin(flow.slots);
  std::vector<Interval> box(start.size());
  std::vector<Interval> derivative(start.size());
  EXPECT_FALSE(field.enclose_solutions(start, Interval(flow.tau), box, derivative));
  jacobian.evaluate(box);
  TransitionMatrix transition(start.size(), TransitionMatrix::kFewTerms);
  const std::vector<bool> none(start.size());
  EXPECT_TRUE(transition.enclose(jacobian.state(), Interval(flow.tau), none));
  UpwardMatrix by_jacobian = transition.end();
  TangentStep tangent(*tape_with_tangents(system), system);
  tangent.begin(flow.slots);
  tangent.narrow(start, box, Interval(flow.tau), 10, transition);
  return {by_jacobian, transition.end()};
}

TEST(TangentStep, HoldsTheDifferencesOfSolutionsAndIsNarrower) {
  const std::vector<std::vector<std::string>> systems{
      {"cos(3*y)", "2 - x"},
      {"y*x/(2 + x^2) - y^3", "sqrt(4 + x*y) - x*x"},
      {"atan(2*y) + log(3 + x)", "tanh(x) - exp(-y) + asin(y/3)"},
      {"(2 + x)^1.5 - y", "-x/(3 + y)"},
      {"2^y - cosh(x)", "x^3 - tan(y) + (1 + y)^(-2) + sinh(y)*acos(x/2)"},
      {"(2 + y)^(1 + x)", "sin(z*x)", "1 - (x - y)*z"}};
  for (const std::vector<std::string>& equations : systems) {
    FlowCase flow(equations);
    flow.tau = 0.05;
    const std::size_t n = equations.size();
    const std::vector<Interval> start(n, Interval{0.25, 0.26});
    const auto [wide, narrow] = step_of(flow, start);
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<long double> from(n, 0.25L);
      std::vector<long double> to = from;
      to[j] = 0.26L;
      const auto a = integrate(flow, from, Signal{{0.0L, 0.0L}}, 200).back();
      const auto b = integrate(flow, to, Signal{{0.0L, 0.0L}}, 200).back();
      for (std::size_t i = 0; i < n; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const auto column = static_cast<Eigen::Index>(j);
        const auto slope = static_cast<double>((b[i] - a[i]) / (to[j] - from[j]));
        EXPECT_LE(narrow(row, column).lower(), slope + 1e-12) << equations[0] << ' ' << i << ' ' << j;
        EXPECT_GE(narrow(row, column).upper(), slope - 1e-12) << equations[0] << ' ' << i << ' ' << j;
        EXPECT_LE(width(narrow(row, column).interval()), 0.75 * width(wide(row, column).interval()) + 1e-11)
            << equations[0] << ' ' << i << ' ' << j;
      }
    }
  }
}

TEST(TangentStep, ThereIsNoneOfAKinkOrAJump) {
  for (const char* text : {"abs(x)", "max(x, y)", "if(x > 0, 1, 2)", "floor(x)*y", "atan2(x, y)"})
    EXPECT_FALSE(tape_with_tangents(FlowCase({text, "1"}).system())) << text;
}

}  // namespace
}  // namespace coordreq
