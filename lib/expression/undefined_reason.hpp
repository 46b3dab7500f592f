#pragma once

#include <span>
#include <string>

#include "expression/program.hpp"
#include "numeric/interval.hpp"

namespace coordreq {

/// Why an expression is not defined everywhere in a box, as a message may say it: "division by a number in
/// [-0.5, 0.5]". Empty if natural interval evaluation finds no reason.
/// @pre `slots` has a value for every variable; the program is a number
[[nodiscard]] std::string undefined_reason(const Program& program, std::span<const Interval> slots);

}  // namespace coordreq
