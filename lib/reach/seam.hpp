#pragma once

#include <cstdint>

#include "expression/program.hpp"
#include "numeric/rational.hpp"

// A periodic state that moves in continuous time is followed without wrapping, so that it may be beyond its
// seam. Expressions see its representative (contract, "Domain and grid"): this is put into the equations.
namespace coordreq {

/// One period [lower, upper) of a state, and where its representative is.
struct Ring {
  Rational lower;
  Rational upper;
};

/// Number of turns that a state that is used as a number is followed, in either direction.
inline constexpr int kMostTurns = 4;

/// The representative of a state that is used as a number.
enum class Representative : std::uint8_t {
  followed,  ///< the value that it has, up to kMostTurns periods beyond the ring
  anywhere,  ///< a new variable, which may be anything in [lower, upper]
};

/// New variables that wind() puts in.
struct SeamSlots {
  std::uint32_t error = 0;
  std::uint32_t anywhere = 0;
};

/// An equation over a state that may be beyond its ring.
struct WoundEquation {
  Program program;
  /// The state is used other than in sin, cos or tan of whole turns: the equation jumps at the seams.
  bool as_number = false;
  /// How far a period is at most from the whole turns of sin, cos and tan, as an upper bound, in units of the
  /// state: `pi` is a rounded constant. 0 if it is in none of them.
  Rational mismatch = 0;
};

/// Puts the representative of the variable x at `slot` wherever x is used as a number.
///
/// Within sin, cos and tan of an expression c x + (what does not depend on x), where c times the period is a
/// whole number of their periods up to 1e-9, x stays as it is but for an error: the result has x + e there
/// with a new variable e at `error_slot`. Of x that is k periods beyond the ring the value is that of the
/// representative for some e in k * [-mismatch, mismatch].
[[nodiscard]] WoundEquation wind(const Program& equation, std::uint32_t slot, const Ring& ring,
                                 const SeamSlots& slots, Representative representative);

}  // namespace coordreq
