#pragma once

#include <cstddef>
#include <cstdint>

// Limits up to which the engine keeps results that it could find anew; estimates of memory use them too.
namespace coordreq {

/// With more actions than this, over all choices of states, groups are found anew for each row.
inline constexpr std::int64_t kMostSharedActions = std::int64_t{1} << 24;

/// With more groups than this, comparing each with each costs more than it saves.
inline constexpr std::int64_t kMostComparedGroups = 128;

/// Number of choices of states up to which the groups of a class with so many actions are shared.
[[nodiscard]] constexpr std::int64_t most_shared_choices(std::int64_t actions) {
  const std::int64_t compared = actions < kMostComparedGroups ? actions : kMostComparedGroups;
  return kMostSharedActions / (actions + compared * compared / 4);
}

/// Bytes of the minima that one thread shares between the rows of a unit: they stay in the second-level
/// cache.
inline constexpr std::int64_t kSharedBytes = std::int64_t{1} << 20;

/// Bytes of the eroded patches of one unit; the aircraft needs 41 of 0.1 MiB.
inline constexpr std::size_t kPatchBytes = std::size_t{1} << 24;

/// Number of patches of one unit that are eroded by a single size, for bounds of several choices.
inline constexpr std::size_t kJoinedPatches = 128;

/// So many tasks per thread even out that some rows take longer than others.
inline constexpr std::int64_t kTasksOfThread = 8;

/// Number of units that are in work at once where each has such patches, with enough rows for all threads:
/// threads in the same unit share them, and wait for each other while one makes them.
[[nodiscard]] constexpr std::int64_t units_at_once(int threads, std::int64_t rows_of_unit) {
  return 2 + kTasksOfThread * threads / rows_of_unit;
}

/// By how many indices a bound's box may be wider than the widest box of one choice, in a dimension of
/// `count` indices: patches have room for such boxes beyond the domain, which must not cost more than bounds
/// save.
[[nodiscard]] constexpr std::int32_t most_wider(std::int32_t count) {
  return count < 32 ? count / 8 : 4;
}

/// Levels of the rows of a batch of a wave, where one unit has not more: those that have changed are held
/// until the batch is done.
inline constexpr std::int64_t kMostLevelsOfBatch = std::int64_t{1} << 20;

}  // namespace coordreq
