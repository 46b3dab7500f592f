#pragma once

#include <cstdint>
#include <optional>

namespace coordreq {

/// The memory that this process may use, in bytes: what the machine has, or the lowest limit of the control
/// groups (containers) it runs in if that is lower. Nothing if the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> available_memory();

}  // namespace coordreq
