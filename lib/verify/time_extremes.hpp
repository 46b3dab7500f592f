#pragma once

#include <cstdint>
#include <vector>

#include "numeric/rational.hpp"

namespace coordreq {

/// Coefficients of t^0, t^1, ..., at least one.
using Polynomial = std::vector<Rational>;

[[nodiscard]] Rational value_at(const Polynomial& p, const Rational& t);

/// Whether p keeps its sign on [0, end], as far as halving shows: 1, -1, or 0 if that is open; 1 if p is 0
/// all over.
[[nodiscard]] int sign_on(const Polynomial& p, const Rational& end);

/// Bounds of floor(min over [0, end] of p): outer <= it <= inner.
struct FloorOfLeast {
  std::int64_t outer = 0;
  std::int64_t inner = 0;  ///< taken at a known time
};

/// Cuts [0, end] where p turns, exactly up to degree 2, else by halving, until p is monotone on each part or
/// cannot matter any more. Equal bounds but where the least value is an integer, or all but, at an irrational
/// time.
[[nodiscard]] FloorOfLeast floor_of_least(const Polynomial& p, const Rational& end);

}  // namespace coordreq
