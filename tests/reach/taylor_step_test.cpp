#include "reach/taylor_step.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "reach/flow_helpers.hpp"

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

}  // namespace
}  // namespace coordreq
