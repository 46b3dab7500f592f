#pragma once

#include <string>

#include "app/json_text.hpp"

// What is said of the network, for people.
namespace coordreq {

/// Modes that a table shows.
inline constexpr std::size_t kMostModes = 12;
/// What a table has left out; empty if nothing.
[[nodiscard]] std::string more_modes(std::size_t modes);

/// A section of `info`.
[[nodiscard]] std::string modes_text(const Json& modes);

}  // namespace coordreq
