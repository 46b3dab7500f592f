#include "reach/seam.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reach/flow_helpers.hpp"
#include "reach/periodic_flow.hpp"

namespace coordreq {
namespace {

constexpr std::uint32_t kErrorSlot = 7;

WoundEquation wound(const std::string& text, const Ring& ring) {
  return wind(link(text, look_up_flow, ExpectedType::number, "/dynamics"), 0, ring, {.error = kErrorSlot},
              Representative::followed);
}

Ring heading() {
  return {.lower = exact(-M_PI), .upper = exact(M_PI)};
}

double value(const WoundEquation& equation, double x, double y = 0.0) {
  std::vector<double> slots(kErrorSlot + 1);
  slots[0] = x;
  slots[1] = y;
  return Evaluator<double>(equation.program).number(slots);
}

TEST(Seam, RepresentativeIsPutInWhereTheStateIsANumber) {
  const WoundEquation equation = wound("x^2 + y", {.lower = -1, .upper = 3});
  EXPECT_TRUE(equation.as_number);
  EXPECT_EQ(equation.mismatch, 0);
  EXPECT_EQ(value(equation, 2.5, 10.0), 16.25);
  EXPECT_EQ(value(equation, 3.5, 10.0), 10.25);
  EXPECT_EQ(value(equation, -1.5, 10.0), 16.25);
  for (int turn = -kMostTurns; turn <= kMostTurns; ++turn) {
    EXPECT_EQ(value(equation, 2.5 + 4.0 * turn), 6.25) << turn;
    EXPECT_EQ(value(equation, -0.5 + 4.0 * turn), 0.25) << turn;
  }
}

TEST(Seam, WholeTurnsOfSinCosAndTanStay) {
  for (const std::string text :
       {"sin(x)", "y*cos(2*x + y^2)^3", "tan(x/2)", "tan(-x)", "exp(sin(y - 3*x))", "sin(x)*cos(x - y)"}) {
    const WoundEquation equation = wound(text, heading());
    EXPECT_FALSE(equation.as_number) << text;
    EXPECT_GT(equation.mismatch, 0) << text;
    EXPECT_LT(equation.mismatch, Rational(1) / 1000000000000000) << text;
  }
  const WoundEquation degrees = wound("cos(pi/180*x)", {.lower = 0, .upper = 360});
  EXPECT_FALSE(degrees.as_number);
  EXPECT_GT(degrees.mismatch, 0);
}

TEST(Seam, EverythingElseIsANumber) {
  for (const std::string text :
       {"x", "sin(x/2)", "tan(x/4)", "sin(1.5*x)", "cos(x*y)", "sin(x^2)", "sin(x)*x", "exp(x)",
        "if(x > 0, y, u)", "sin(1.000001*x)", "cos(sin(x) + x)"}) {
    EXPECT_TRUE(wound(text, heading()).as_number) << text;
  }
  EXPECT_FALSE(wound("y + u", heading()).as_number);
  EXPECT_TRUE(wound("sin(x)", {.lower = 0, .upper = 6}).as_number);
}

TEST(Seam, MismatchIsThatOfTheRoundedConstants) {
  // sin(2 pi) of the double: minus the distance to the real number, up to 1e-48.
  const double distance = -std::sin(2 * M_PI);
  const WoundEquation equation = wound("2*sin(x) + cos(x)", heading());
  EXPECT_NEAR(equation.mismatch.get_d(), distance, 1e-29);
  EXPECT_NEAR(wound("sin(3*x)", heading()).mismatch.get_d(), distance, 1e-29);
}

/// x' = f with periodic y from [2.9, 3.1], y' = 1 for 0.5.
FlowEnclosure from_seam(const std::string& f) {
  FlowCase system({f, "1"});
  system.tau = 0.5;
  system.slots[0] = {0.0, 0.0};
  system.slots[1] = {2.9, 3.1};
  return PeriodicFlow(system.system(), {std::nullopt, heading()}, 0.5, 0.5).flow(system.slots);
}

TEST(PeriodicFlow, NumberJumpsOnTheWay) {
  // From y the seam is met after pi - y, and x is then 2 pi a unit of time less than without it.
  const FlowEnclosure found = from_seam("y");
  ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
  const auto end = [](double y) { return 0.5 * y + 0.125 - 2 * M_PI * (0.5 - (M_PI - y)); };
  EXPECT_LE(found.end[0].lower, end(3.1));
  EXPECT_GE(found.end[0].upper, end(2.9));
  EXPECT_GT(found.end[0].lower, end(3.1) - 0.3);
  EXPECT_LT(found.end[0].upper, end(2.9) + 0.3);
  EXPECT_LE(found.end[1].lower, 3.4);
  EXPECT_GE(found.end[1].upper, 3.6);
}

TEST(PeriodicFlow, StateThatWindsTooOftenIsAnywhere) {
  FlowCase system({"y", "100"});
  system.slots[1] = {-M_PI, M_PI};
  system.tau = 0.5;
  const FlowEnclosure found =
      PeriodicFlow(system.system(), {std::nullopt, heading()}, 0.5, 0.5).flow(system.slots);
  ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
  EXPECT_NEAR(found.end[0].lower, -0.5 * M_PI, 1e-12);
  EXPECT_NEAR(found.end[0].upper, 0.5 * M_PI, 1e-12);
}

TEST(PeriodicFlow, WholeTurnsAreAsTightAsWithoutASeam) {
  FlowCase system({"cos(y)", "1"});
  system.tau = 0.5;
  system.slots[1] = {2.9, 3.1};
  const FlowEnclosure plain = system.enclosure();
  const FlowEnclosure found = from_seam("cos(y)");
  ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
  EXPECT_NEAR(found.end[0].lower, plain.end[0].lower, 1e-14);
  EXPECT_NEAR(found.end[0].upper, plain.end[0].upper, 1e-14);
  EXPECT_LE(found.end[0].lower, plain.end[0].lower);
  EXPECT_GE(found.end[0].upper, plain.end[0].upper);
}

TEST(PeriodicFlow, StateThatMovesAwayFromItsSeamIsAsWithoutIt) {
  FlowCase system({"y", "-y"});
  system.slots[1] = {2.9, M_PI};
  const FlowEnclosure plain = system.enclosure();
  PeriodicFlow flow(system.system(), {std::nullopt, heading()}, system.tau, system.tau);
  const FlowEnclosure found = flow.flow(system.slots);
  EXPECT_EQ(found.end[0].lower, plain.end[0].lower);
  EXPECT_EQ(found.end[0].upper, plain.end[0].upper);
}

TEST(PeriodicFlow, StateThatComesToRestOnItsSeamIsSeenBeyondIt) {
  // y reaches pi at once and stays; its representative there is -pi.
  FlowCase system({"y", "if(y > 0, 1, 0)"});
  system.slots[1] = {3.14, M_PI};
  PeriodicFlow flow(system.system(), {std::nullopt, heading()}, system.tau, system.tau);
  const FlowEnclosure found = flow.flow(system.slots);
  ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
  EXPECT_LE(found.end[0].lower, -M_PI * system.tau);
}

}  // namespace
}  // namespace coordreq
