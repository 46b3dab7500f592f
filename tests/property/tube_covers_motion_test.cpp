// Tubes attacked: solutions of random exactly solvable systems, seam, disturbances that switch and
// measurement errors included, stay in the cells of their tube at all times. In rationals throughout: the
// classical Runge-Kutta method solves these systems, polynomials of degree 3 in time at the most, without an
// error.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "model/pieces.hpp"
#include "property/point.hpp"
#include "reach/build_abstraction.hpp"
#include "support/draw.hpp"
#include "support/random_problem.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

using Slots = std::vector<RationalInterval>;

constexpr int kSegments = 4;  ///< the disturbance may change between them

/// A point of [lower, upper], often an end.
Rational draw_within(const Rational& lower, const Rational& upper) {
  return lower + (upper - lower) * static_cast<long>(draw(0, 6)) / 6;
}

Slots draw_start(const SystemSpec& spec, const Abstraction& a, std::int64_t x, std::int64_t u) {
  Slots slots(spec.slot_count());
  for (std::size_t i = 0; i < a.grid.size(); ++i) {
    const std::vector<Piece> parts = pieces(a.grid[i], a.grid.index(x, i));
    const Piece& part = parts[static_cast<std::size_t>(draw(0, static_cast<std::int64_t>(parts.size()) - 1))];
    slots[i] = point(draw_within(part.lower, part.upper));
  }
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    slots[spec.input_slot(i)] = point(a.inputs[i].values[static_cast<std::size_t>(a.inputs.index(u, i))]);
  }
  return slots;
}

std::vector<Rational> derivative(const SystemSpec& spec, const Slots& slots) {
  std::vector<Rational> result;
  for (const Program& equation : spec.dynamics.equations) {
    result.push_back(Evaluator<RationalInterval>(equation).number(slots).lower);
  }
  return result;
}

Slots moved(Slots slots, const std::vector<Rational>& by, const Rational& time) {
  for (std::size_t i = 0; i < by.size(); ++i) slots[i] = point(slots[i].lower + by[i] * time);
  return slots;
}

Slots step(const SystemSpec& spec, const Slots& slots, const Rational& h) {
  const auto k1 = derivative(spec, slots);
  const auto k2 = derivative(spec, moved(slots, k1, h / 2));
  const auto k3 = derivative(spec, moved(slots, k2, h / 2));
  const auto k4 = derivative(spec, moved(slots, k3, h));
  std::vector<Rational> mean;
  for (std::size_t i = 0; i < k1.size(); ++i) mean.emplace_back((k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) / 6);
  return moved(slots, mean, h);
}

/// Is the value in a cell of the range, as S knows them?
bool covers(IndexRange range, const GridDimension& target, const Rational& value) {
  const Rational reach = target.radius() + target.measurement_error;
  for (std::int64_t k = range.first; k <= range.last; ++k) {
    Rational distance = abs(value - target.point(k));
    if (target.periodic()) {
      const Rational turns = distance / (target.upper - target.lower) + Rational(1, 2);
      distance = abs(distance - (target.upper - target.lower) * static_cast<long>(floor_to_int(turns)));
    }
    if (distance <= reach) return true;
  }
  return false;
}

/// Whether an equation jumps where state i passes its seam.
bool jumps_at_seam(const SystemSpec& spec, std::size_t i) {
  if (spec.states[i].below != Outside::periodic) return false;
  return std::any_of(spec.dynamics.equations.begin(), spec.dynamics.equations.end(),
                     [&](const Program& equation) {
                       const auto used = equation.variables();
                       return std::find(used.begin(), used.end(), spec.state_slot(i)) != used.end();
                     });
}

/// Behind a seam at which an equation jumps the steps are not exact any more.
bool is_before_seams(const SystemSpec& spec, const Slots& slots) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!jumps_at_seam(spec, i)) continue;
    if (slots[i].lower < spec.states[i].lower || slots[i].lower >= spec.states[i].upper) return false;
  }
  return true;
}

TEST(Abstraction, SolutionsStayInTheirTubesBetweenTheSamples) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("solutions stay in tubes", [&] {
    const SystemSpec spec = read_system(draw_problem(RandomTime::between_samples), "random");
    const Abstraction a = build_abstraction(spec, team);
    RC_ASSERT(a.tubes.size() == a.grid.size());
    for (int attempt = 0; attempt < 20; ++attempt) {
      const std::int64_t x = draw(0, a.grid.cells() - 1);
      const std::int64_t u = draw(0, a.inputs.count() - 1);
      Slots slots = draw_start(spec, a, x, u);
      for (int segment = 0; segment < kSegments && is_before_seams(spec, slots); ++segment) {
        for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
          const DisturbanceSpec& w = spec.disturbances[l];
          slots[spec.disturbance_slot(l)] = point(draw_within(w.lower, w.upper));
        }
        for (int part = 0; part < 3; ++part) {
          slots = step(spec, slots, spec.dynamics.period / (3 * kSegments));
          if (!is_before_seams(spec, slots)) break;
          for (std::size_t i = 0; i < a.grid.size(); ++i) {
            RC_ASSERT(covers(a.raw_tube(i, x, u), a.grid[i], slots[i].lower));
          }
        }
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
