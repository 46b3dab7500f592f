#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/json.hpp"

namespace coordreq {

/// The document of `info`: the origin of a results file, its axes, the members of each answer, and
/// `datasets`: paths, sorted, without bare dimensions, which hold no data.
/// @param max_memory as of ResultsReader. @throws as ResultsReader
[[nodiscard]] Json read_info(const std::string& path, std::optional<std::uint64_t> max_memory = std::nullopt);

}  // namespace coordreq
