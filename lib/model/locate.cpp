#include "model/locate.hpp"

#include "base/requires.hpp"
#include "model/outside.hpp"

namespace coordreq {
namespace {

/// Position in units of cells: cell k is [k, k + 1), point k of a discrete dimension is k.
Rational position(const GridDimension& dimension, const Rational& value) {
  const Rational steps = (value - dimension.first) / dimension.step;
  if (dimension.discrete) return steps;
  return steps + Rational(1, 2);
}

std::int64_t index_of(const GridDimension& dimension, const Rational& value) {
  const Rational coordinate = position(dimension, value);
  if (dimension.periodic()) {
    const mpz_class count(static_cast<long>(dimension.count));
    mpz_class k;
    mpz_fdiv_r(k.get_mpz_t(), whole_below(coordinate).get_mpz_t(), count.get_mpz_t());
    return k.get_si();
  }
  const std::int64_t k = floor_to_int(coordinate);
  const std::int64_t top = dimension.count - 1;
  const Rational& error = dimension.measurement_error;
  if (k < 0 && traits(dimension.below).clamps && value >= dimension.first - error) return 0;
  if (k > top && traits(dimension.above).clamps && value <= dimension.point(top) + error) return top;
  return k;
}

Location::Kind kind_of(const GridDimension& dimension, const Rational& value, std::int64_t k) {
  if (k >= 0 && k < dimension.count) {
    const bool off_grid = dimension.discrete && !is_integer(position(dimension, value));
    return off_grid ? Location::Kind::off_grid : Location::Kind::cell;
  }
  const Outside rule = k < 0 ? dimension.below : dimension.above;
  return traits(rule).arrives ? Location::Kind::left_safely : Location::Kind::beyond;
}

}  // namespace

Location locate(const UniformGrid& grid, std::span<const Rational> state) {
  REQUIRES(state.size() == grid.size());
  Location location;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::int64_t k = index_of(grid[i], state[i]);
    location.index.push_back(k);
    const Location::Kind kind = kind_of(grid[i], state[i], k);
    // The worst kind counts, and the first dimension of that kind.
    if (kind <= location.kind) continue;
    location.kind = kind;
    location.dimension = i;
    location.above = k >= grid[i].count;
  }
  if (location.kind != Location::Kind::cell) return location;  // indices may be as large as numbers can be
  location.cell = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) location.cell += location.index[i] * grid.stride(i);
  return location;
}

}  // namespace coordreq
