#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/uniform_grid.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// The cell of a measured state, or why there is none.
struct Location {
  enum class Kind : std::uint8_t {
    cell,         ///< in the domain
    left_safely,  ///< beyond a `safe` side and no side of another kind: the absorbing cell T
    beyond,       ///< beyond another side
    off_grid,     ///< in the domain, but a discrete state is not one of its values
  };
  Kind kind = Kind::cell;
  std::int64_t cell = -1;           ///< linear index; -1 unless `cell`
  std::vector<std::int64_t> index;  ///< of each dimension; the one beyond the domain or nearest if not `cell`
  std::size_t dimension = 0;        ///< the first at fault, unless `cell`
  bool above = false;               ///< of `left_safely` and `beyond`: which side
};

/// Where a state lies: cells are [a, b) in every dimension, whatever `cells` says in the spec, so that a
/// state has one cell; a discrete dimension has only its grid points. Exact.
///
/// A periodic dimension wraps. Beyond a `saturate` or `stop` side the true state never is, so what is
/// measured there, by no more than the measurement error beyond the last grid point, reads as the boundary
/// cell. @pre one value a dimension
[[nodiscard]] Location locate(const UniformGrid& grid, std::span<const Rational> state);

}  // namespace coordreq
