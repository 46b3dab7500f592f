#pragma once

#include <string>

namespace coordreq {

/// A random small problem spec as JSON text, drawn inside a RapidCheck property: two or three agents that all
/// do the same, each in states of its own, and are to be apart from each other. In some of them one agent
/// (its actions, an edge, its measurement error), or what is safe, makes a difference; some are in continuous
/// time, and safe between the samples; partitions are all or a list.
[[nodiscard]] std::string draw_like_agents();

}  // namespace coordreq
