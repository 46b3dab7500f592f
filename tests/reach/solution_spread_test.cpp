#include "reach/solution_spread.hpp"

#include <gtest/gtest.h>

#include "reach/reference_flow.hpp"

namespace coordreq {
namespace {

std::optional<std::size_t> widest(const FlowCase& flow, double limit) {
  FlowSystem system = flow.system();
  system.steps.assign(flow.equations.size(), 1.0);
  const std::span<const Interval> box(flow.slots.data(), flow.equations.size());
  return SolutionSpread(system, flow.tau).widest(flow.slots, box, limit);
}

TEST(SolutionSpread, IsTheFarthestThatSolutionsGetFromOneAnother) {
  FlowCase flow({"3*x"});
  flow.slots[0] = {1.0, 1.5};
  flow.tau = 1.0;
  EXPECT_EQ(widest(flow, 0.5 * std::exp(3.0) - 0.1), 0U);
  EXPECT_EQ(widest(flow, 0.5 * std::exp(3.0) + 0.1), std::nullopt);
}

TEST(SolutionSpread, CountsOnTheWayToo) {
  // x^2 + y^2 stays: what differs by 2 in y at first differs by as much in x after a quarter of a turn.
  FlowCase flow({"0.1*y", "-10*x"});
  flow.slots[0] = {0.0, 0.0};
  flow.slots[1] = {-10.0, 10.0};
  flow.tau = 3.14159;  // half a turn: x is 0 again
  EXPECT_EQ(widest(flow, 19.0), 1U);
  flow.slots[0] = {-1.0, 1.0};
  flow.slots[1] = {0.0, 0.0};
  EXPECT_EQ(widest(flow, 19.0), 0U);
  EXPECT_EQ(widest(flow, 21.0), std::nullopt);
}

TEST(SolutionSpread, SaysNothingWhereSolutionsCannotBeFollowed) {
  for (const char* const text : {"x^2", "sqrt(x - 1)", "1e7*sin(1e5*x)"}) {
    FlowCase flow({text});
    flow.slots[0] = {0.5, 2.0};
    flow.tau = 1.0;
    EXPECT_EQ(widest(flow, 1e-3), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace coordreq
