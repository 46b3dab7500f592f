#pragma once

#include <string>

namespace coordreq {

enum class RandomTime {
  any,
  discrete,
  between_samples,  ///< continuous, and safety is asked for between the samples
};
enum class RandomEdges {
  any,
  plain,  ///< no periodic states, no measurement errors, no disturbance from somewhere on
};

enum class RandomAgents {
  few,   ///< 1 to 3, with some of their partitions
  many,  ///< 3 or 4 in a plane or a space, with all their partitions, a horizon and costs of links
};

/// A random small problem spec as JSON text, exactly solvable, drawn inside a RapidCheck property: 1 to 3
/// states (continuous and discrete), 1 to 3 inputs, 1 to 3 agents, disturbances, every `outside` rule but
/// `stop`, measurement errors, both kinds of cells, safety between the samples, `allow`, both kinds of
/// synthesis, several partitions, max_delay.
[[nodiscard]] std::string draw_problem(RandomTime kind = RandomTime::any,
                                       RandomEdges edges = RandomEdges::any,
                                       RandomAgents agents = RandomAgents::few);

}  // namespace coordreq
