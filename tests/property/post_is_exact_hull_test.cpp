// The abstraction against a different route: the hull from the corners of the cell, and membership of each
// lattice cell by definition.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "model/odometer.hpp"
#include "property/point.hpp"
#include "reach/build_abstraction.hpp"
#include "support/random_problem.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

struct Hull {
  Rational lower, upper;
  bool upper_attained = false;
};

/// Values of an affine map at all corners of a cell and of the disturbances; a corner on an upper face of a
/// half-open cell is not in it.
Hull hull_from_corners(const SystemSpec& spec, const Abstraction& a, std::size_t state, std::int64_t x,
                       std::int64_t u) {
  Evaluator<RationalInterval> equation(spec.dynamics.equations[state]);
  std::vector<RationalInterval> slots(spec.slot_count());
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    slots[spec.input_slot(i)] = point(a.inputs[i].values[static_cast<std::size_t>(a.inputs.index(u, i))]);
  }
  Odometer corner(std::vector<std::int64_t>(a.grid.size() + spec.disturbances.size(), 2));
  Hull hull;
  bool begun = false;
  do {
    bool attained = true;
    for (std::size_t i = 0; i < a.grid.size(); ++i) {
      const Rational radius = a.grid[i].radius();
      const bool upper = corner.indices()[i] == 1;
      slots[i] = point(a.grid[i].point(a.grid.index(x, i)) + (upper ? radius : Rational(-radius)));
      // A face counts only where the equation moves with that state.
      const auto used = spec.dynamics.equations[state].variables();
      if (upper && radius > 0 && std::count(used.begin(), used.end(), i) > 0) attained = false;
    }
    for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
      const DisturbanceSpec& w = spec.disturbances[l];
      slots[spec.disturbance_slot(l)] = point(corner.indices()[a.grid.size() + l] == 1 ? w.upper : w.lower);
    }
    const Rational value = equation.number(slots).lower;
    if (!begun || value < hull.lower) hull.lower = value;
    if (!begun || value > hull.upper) {
      hull.upper = value;
      hull.upper_attained = attained;
    } else if (value == hull.upper) {
      hull.upper_attained = hull.upper_attained || attained;
    }
    begun = true;
  } while (corner.advance());
  return hull;
}

bool meets(const SystemSpec& spec, const GridDimension& target, std::int64_t k, const Hull& hull) {
  const Rational low = target.point(k) - target.radius();
  const Rational high = target.point(k) + target.radius();
  if (target.discrete) return hull.lower == low;
  if (spec.abstraction.cells == Cells::closed) return low <= hull.upper && hull.lower <= high;
  return (hull.upper_attained ? low <= hull.upper : low < hull.upper) && hull.lower < high;
}

TEST(Abstraction, PostsAreTheExactHullsOfAffineMaps) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("tables equal corners", [&] {
    const SystemSpec spec = read_system(draw_problem(RandomTime::discrete, RandomEdges::plain), "random");
    const Abstraction a = build_abstraction(spec, team);
    const std::int64_t x = *rc::gen::inRange<std::int64_t>(0, a.grid.cells());
    const std::int64_t u = *rc::gen::inRange<std::int64_t>(0, a.inputs.count());
    for (std::size_t i = 0; i < a.grid.size(); ++i) {
      const Hull hull = hull_from_corners(spec, a, i, x, u);
      const IndexRange range = a.raw(i, x, u);
      for (std::int64_t k = range.first - 3; k <= range.last + 3; ++k) {
        const bool in_range = range.first <= k && k <= range.last;
        RC_ASSERT(meets(spec, a.grid[i], k, hull) == in_range);
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
