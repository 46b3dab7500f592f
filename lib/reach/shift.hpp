#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "expression/program.hpp"
#include "numeric/interval.hpp"
#include "numeric/rational.hpp"
#include "reach/affine_dynamics.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// r with f = r * x + (what does not depend on x) for an expression f and a variable x; nothing where no such
/// r is seen. Of a condition 0 if it does not depend on x.
using Slope = std::optional<Rational>;

/// The slopes of all nodes of a program; the last one is that of its result.
[[nodiscard]] std::vector<Slope> find_slopes(const Program& program, std::uint32_t variable);

/// All values that a state can have in some cell, measurement errors included, rounded outward.
[[nodiscard]] Interval range_of(const StateSpec& state);
/// From the least to the greatest value of an input.
[[nodiscard]] Interval range_of(const InputSpec& input);

/// True if the state saturates and is measured with an error: what lies beyond its limit is then seen not
/// only in the boundary cell.
[[nodiscard]] bool has_measured_limit(const StateSpec& state);

/// True if x_i(next) - x_i provably does not depend on x_i, so that one offset serves all its cells: in
/// discrete time the equation is x_i plus what does not mention x_i, or its derivative by x_i is exactly 1
/// over the whole domain and all inputs and disturbances; in continuous time no equation that x_i depends on
/// mentions x_i, nor has x_i a `stop`. Not where has_measured_limit(), nor of an update. False where that is
/// true but not seen.
[[nodiscard]] bool is_shift(const SystemSpec& spec, const Dependencies& dependencies, std::size_t state);

}  // namespace coordreq
