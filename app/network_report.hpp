#pragma once

#include <string>
#include <vector>

#include "app/json_text.hpp"
#include "spec/spec_types.hpp"

// What is said of the network, for people.
namespace coordreq {

/// Which steps are lost: "at most 2 of any 5 steps are lost".
[[nodiscard]] std::string network_meaning(const NetworkSpec& network);

/// Modes that a table shows.
inline constexpr std::size_t kMostModes = 12;
/// What a table has left out; empty if nothing.
[[nodiscard]] std::string more_modes(std::size_t modes);

/// A section of `info`.
[[nodiscard]] std::string modes_text(const Json& modes);

/// A section of `query`. @param names of the modes that are safe
[[nodiscard]] std::string safe_modes_text(const NetworkSpec& network, std::vector<std::string> names);
[[nodiscard]] std::vector<std::string> safe_mode_names(const NetworkSpec& network,
                                                       const std::vector<bool>& safe);

}  // namespace coordreq
