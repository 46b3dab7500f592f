#pragma once

#include <cstddef>
#include <cstdint>

// How far the engine goes in keeping what it could find anew; estimates of memory need them too.
namespace coordreq {

/// Above so many actions in all choices of states groups are found anew for each row.
inline constexpr std::int64_t kMostSharedActions = std::int64_t{1} << 24;

/// With more groups than this, comparing each with each costs more than it saves.
inline constexpr std::int64_t kMostComparedGroups = 128;

/// Choices of states up to which the groups of so many actions are shared.
[[nodiscard]] constexpr std::int64_t most_shared_choices(std::int64_t actions) {
  const std::int64_t compared = actions < kMostComparedGroups ? actions : kMostComparedGroups;
  return kMostSharedActions / (actions + compared * compared / 4);
}

/// Choices of states whose groups are found before equal ones are thrown away: there may be thousands of
/// choices, and groups that are compared take some kilobytes.
inline constexpr std::int64_t kGroupsFoundAtOnce = 256;

/// All minima that one thread shares between the rows of a unit: so that they stay in the second-level cache.
inline constexpr std::int64_t kSharedBytes = std::int64_t{1} << 20;

/// All eroded patches of one thread together; a unit of the aircraft needs 41 of 0.1 MiB.
inline constexpr std::size_t kPatchBytes = std::size_t{1} << 24;

/// Patches of one thread that are eroded by a single size, for bounds of several choices.
inline constexpr std::size_t kJoinedPatches = 128;

/// By how many indices such a patch's size may be wider than the widest box of one choice, on a side of so
/// many: patches have room for it beyond the domain, which must not cost more than it saves.
[[nodiscard]] constexpr std::int32_t most_wider(std::int32_t count) {
  return count < 32 ? count / 8 : 4;
}

}  // namespace coordreq
