#pragma once

#include <string>

namespace coordreq {

enum class RandomTime { any, discrete };

/// A random small problem spec as JSON text, exactly solvable, drawn inside a RapidCheck property: 1 to 3
/// states (continuous and discrete), 1 to 3 inputs, 1 to 3 agents, disturbances, every `outside` rule of this
/// version, both kinds of cells, `allow`, both kinds of synthesis, several partitions, max_delay.
[[nodiscard]] std::string draw_problem(RandomTime kind = RandomTime::any);

}  // namespace coordreq
