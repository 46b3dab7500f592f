#pragma once

#include <cstdint>

// What stands for a number of steps where there is none, in the values of answers and, by this name, in the
// docs of results files (docs/reference/results.md). Arrays of narrower types hold their own greatest number
// for kUnbounded.
namespace coordreq {

/// No number of steps bounds it: silence may go on, no connection is needed, the set is never left, or the
/// goal is never reached.
inline constexpr std::int32_t kUnbounded = INT32_MAX;
/// Of a cell of S outside K.
inline constexpr std::int32_t kOutsideInvariant = -1;
/// Of a cell outside S.
inline constexpr std::int32_t kOutsideSafe = -2;
/// Of a trigger: a connection must stand already, the delay is less than it takes to connect.
inline constexpr std::int32_t kMustBeConnected = -3;
/// Of a coalition: no partition of the spec is safe until the horizon.
inline constexpr std::int32_t kNoPartitionSuffices = -3;
/// Of an approach: a cell of K from which the goal cannot be forced.
inline constexpr std::int32_t kOutsideWinning = -4;

}  // namespace coordreq
