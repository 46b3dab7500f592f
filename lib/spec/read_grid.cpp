#include "spec/spec_parts.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "spec/check_limits.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

GridSpec grid_by_step(const Scope& scope, const Node& object, const Rational& lower, const Rational& upper) {
  const Rational step = scope.number(object["step"]);
  if (step <= 0) throw SpecError("expected a step > 0, found " + to_text(step), object["step"].pointer());
  const Rational origin = object.has("origin") ? scope.number(object["origin"]) : Rational(0);
  const mpz_class first = whole_above((lower - origin) / step);
  const mpz_class count = whole_below((upper - origin) / step) - first + 1;
  if (count < 1) {
    throw SpecError(fmt::format("no grid point {} + k*{} lies in [{}, {}]", to_text(origin), to_text(step),
                                to_text(lower), to_text(upper)),
                    object.pointer());
  }
  check_point_count(count, object.pointer());
  return {origin + Rational(first) * step, step, count.get_si()};
}

/// @pre `node` is a count of 1
GridSpec single_point(const Node& object, const Node& node, const Rational& lower, const Rational& upper,
                      GridOf kind) {
  REQUIRES(node.token() == "1");
  if (lower != upper) {
    throw SpecError(
        fmt::format("one point is lower and upper: expected {}, found {}", to_text(lower), to_text(upper)),
        object["upper"].pointer());
  }
  if (kind == GridOf::points) return {lower, 1, 1};
  throw SpecError("the cell of one point needs its width: expected 'step', found 'count'", node.pointer());
}

GridSpec grid_by_count(const Node& object, const Rational& lower, const Rational& upper, GridOf kind) {
  const Node node = object["count"];
  const mpz_class count(node.token());
  const bool is_periodic = kind == GridOf::periodic_cells;
  check_point_count(count, node.pointer());
  if (!is_periodic && count == 1) return single_point(object, node, lower, upper, kind);
  if (lower == upper) {
    throw SpecError(fmt::format("expected upper > lower = {}, found the same", to_text(lower)),
                    object["upper"].pointer());
  }
  return {lower, (upper - lower) / Rational(is_periodic ? count : mpz_class(count - 1)), count.get_si()};
}

/// The results file and the engines address points by doubles.
void check_distinct(const GridSpec& grid, const std::string& pointer) {
  if (grid.count < 2) return;
  const Rational last = grid.last();
  const bool is_distinct = nearest_double(grid.first) < nearest_double(grid.first + grid.step) &&
                           nearest_double(last - grid.step) < nearest_double(last);
  if (!is_distinct) {
    throw SpecError(fmt::format("grid points {:.6g} apart near {:.6g} are equal as doubles",
                                nearest_double(grid.step), nearest_double(last)),
                    pointer);
  }
}

}  // namespace

GridReading read_grid(const Scope& scope, const Node& object, GridOf kind) {
  GridReading reading;
  reading.lower = scope.number(object["lower"]);
  reading.upper = scope.number(object["upper"]);
  if (reading.upper < reading.lower) {
    throw SpecError(
        fmt::format("expected upper >= lower = {}, found {}", to_text(reading.lower), to_text(reading.upper)),
        object["upper"].pointer());
  }
  if (kind == GridOf::periodic_cells && !object.has("count")) {
    throw SpecError("a periodic state is given with 'count', found 'step'", object["step"].pointer());
  }
  reading.grid = object.has("count") ? grid_by_count(object, reading.lower, reading.upper, kind)
                                     : grid_by_step(scope, object, reading.lower, reading.upper);
  check_distinct(reading.grid, object.pointer());
  return reading;
}

}  // namespace coordreq
