#pragma once

#include <cstddef>
#include <cstdint>

// Which equations count as polynomials with rational coefficients, so that a system of degree 1 is exact: the
// rule, which the analysis and the verifier follow each with code of its own.
//
// - Sums, differences, products, quotients by constants other than 0 and powers by whole constants of
// polynomials are
//   multiplied out.
// - Functions, and `min`, `max`, `mod` and the like, are only of constants: of numbers, and of what is fixed.
// A constant
//   that is no rational number may be added, and multiplied with constants.
// - `if` is one of its branches where its condition is decided for all values, comparisons by a difference
// that is a
//   constant. An `if` that is not decided is no polynomial, even if its branches are equal.
// - A product whose factors have too high degrees together, or too many terms but for the constant, is none.
namespace coordreq {

inline constexpr std::size_t kMostTermsOfExact = 2000;  ///< of one factor times those of the other
inline constexpr std::uint32_t kMostDegreeOfExact = 32;

}  // namespace coordreq
