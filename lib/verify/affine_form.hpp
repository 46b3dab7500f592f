#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "expression/program.hpp"

namespace coordreq {

/// constant + sum_j slope[j] x_j, exactly.
struct ExactForm {
  Rational constant;
  std::vector<Rational> slope;  ///< one a variable
};

/// Multiplies an expression out as a polynomial with rational coefficients (fmpq_mpoly of FLINT). With it the
/// verifier finds out by itself which systems are exact (contract, "Cells").
/// @param variables slots of the x_j; @param values of all other slots
/// @returns nothing if that is no polynomial of degree at most 1 (see exact_equations.hpp), or some constant
/// in it is no rational number
[[nodiscard]] std::optional<ExactForm> affine_form(const Program& program,
                                                   const std::vector<std::uint32_t>& variables,
                                                   const std::vector<Rational>& values);

}  // namespace coordreq
