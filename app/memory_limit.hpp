#pragma once

#include <cstdint>
#include <optional>

namespace coordreq {

/// The memory that this process may use, in bytes: what the machine has, or the lowest limit of the control
/// groups (containers) it runs in if that is lower. Nothing if the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> available_memory();

/// From now on the system refuses this process what would take it beyond so many bytes and a tenth:
/// std::bad_alloc is thrown then. It is the last resort where an estimate was too low. What the program has
/// in memory already, and what is little more than that, is always granted. Without effect under a sanitiser.
/// @param threads that will work, of which each has a stack that is not used to its end; 0: all cores
void hold_to_memory(std::uint64_t bytes, int threads);
/// Whether it is held to a limit.
[[nodiscard]] bool is_held_to_memory();

}  // namespace coordreq
