// The abstraction attacked: successors of points of a cell, seam and measurement errors included, lie in the
// post.

#include <gtest/gtest.h>
#include <rapidcheck.h>

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

/// A point of [lower, upper], often an end.
Rational draw_between(const Rational& lower, const Rational& upper) {
  return lower + (upper - lower) * static_cast<long>(draw(0, 8)) / 8;
}

/// A true state that can be measured in cell k, as expressions see it; never the far end of a period, nor of
/// a half-open cell.
Rational draw_state(const SystemSpec& spec, const GridDimension& dimension, std::int64_t k) {
  const std::vector<Piece> parts = pieces(dimension, k);
  const Piece& part = parts[static_cast<std::size_t>(draw(0, static_cast<std::int64_t>(parts.size()) - 1))];
  if (part.lower == part.upper) return part.lower;
  const bool open =
      spec.abstraction.cells == Cells::half_open || (dimension.periodic() && part.upper == dimension.upper);
  const Rational value = draw_between(part.lower, part.upper);
  return open && value == part.upper ? part.lower : value;
}

/// Does raw index k of the lattice have the value in its cell?
bool has(const SystemSpec& spec, const GridDimension& target, std::int64_t k, const Rational& value) {
  const Rational low = target.point(k) - target.radius();
  const Rational high = target.point(k) + target.radius();
  if (target.discrete || spec.abstraction.cells == Cells::closed) return low <= value && value <= high;
  return low <= value && value < high;
}

bool covers(IndexRange range, std::int64_t k, const GridDimension& target) {
  if (!target.periodic()) return range.first <= k && k <= range.last;
  for (std::int64_t j = range.first; j <= range.last; ++j) {
    if ((j - k) % target.count == 0) return true;
  }
  return false;
}

TEST(Abstraction, SuccessorsOfPointsOfACellAreInItsPost) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("samples are posted", [&] {
    const SystemSpec spec = read_system(draw_problem(RandomTime::discrete), "random");
    const Abstraction a = build_abstraction(spec, team);
    for (int attempt = 0; attempt < 40; ++attempt) {
      const std::int64_t x = draw(0, a.grid.cells() - 1);
      const std::int64_t u = draw(0, a.inputs.count() - 1);
      std::vector<RationalInterval> slots(spec.slot_count());
      for (std::size_t i = 0; i < a.grid.size(); ++i) {
        slots[i] = point(draw_state(spec, a.grid[i], a.grid.index(x, i)));
      }
      for (std::size_t i = 0; i < a.inputs.size(); ++i) {
        slots[spec.input_slot(i)] = point(a.inputs[i].values[static_cast<std::size_t>(a.inputs.index(u, i))]);
      }
      for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
        const DisturbanceSpec& w = spec.disturbances[l];
        slots[spec.disturbance_slot(l)] = point(draw_between(w.lower, w.upper));
      }
      for (std::size_t i = 0; i < a.grid.size(); ++i) {
        const GridDimension& target = a.grid[i];
        const Rational next = Evaluator<RationalInterval>(spec.dynamics.equations[i]).number(slots).lower;
        const Rational measured =
            draw_between(next - target.measurement_error, next + target.measurement_error);
        const IndexRange range = a.raw(i, x, u);
        const std::int64_t near = floor_to_int((measured - target.first) / target.step);
        for (std::int64_t k = near - 1; k <= near + 2; ++k) {
          RC_ASSERT(!has(spec, target, k, measured) || covers(range, k, target));
        }
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
