// What commands compute of single cells is what an analysis stores of all.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "cell/same_actions.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

TEST(RandomCellController, WhatIsComputedIsWhatTheAnalysisStores) {
  ThreadTeam team(1);
  EXPECT_TRUE(
      rc::check("actions of random exact problems", [&] { expect_same_actions(draw_problem(), team); }));
}

TEST(RandomCellController, AlsoWhereSafetyIsAskedForBetweenTheSamples) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("actions of random problems with tubes",
                        [&] { expect_same_actions(draw_problem(RandomTime::between_samples), team); }));
}

}  // namespace
}  // namespace coordreq
