#pragma once

#include <cstdint>

#include "expression/program.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// Whether an equation jumps where a periodic state passes its seam: it uses the state other than within sin,
/// cos and tan of c x + (what does not depend on x), where c times the period of x is whole periods of these,
/// but for 1e-9, as pi is a rounded constant.
[[nodiscard]] bool jumps_at_seam(const Program& equation, std::uint32_t slot, const Rational& period);

}  // namespace coordreq
