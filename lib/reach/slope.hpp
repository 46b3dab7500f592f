#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "expression/program.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// r with f = r * x + (what does not depend on x) for an expression f and a variable x; nothing where no such
/// r is seen. Of a condition 0 if it does not depend on x.
using Slope = std::optional<Rational>;

/// The slopes of all nodes of a program; the last one is that of its result.
[[nodiscard]] std::vector<Slope> find_slopes(const Program& program, std::uint32_t variable);

}  // namespace coordreq
