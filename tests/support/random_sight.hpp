#pragma once

#include <string>

namespace coordreq {

/// The problem with `sees` for some or all of its agents, drawn inside a RapidCheck property: at least one
/// does not see all states. What more than one agent sees is measured without an error.
[[nodiscard]] std::string with_sight(const std::string& problem);

}  // namespace coordreq
