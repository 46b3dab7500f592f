#pragma once

#include <string>
#include <vector>

#include "reach/flow_helpers.hpp"
#include "reach/reference_flow.hpp"

// Drawn with RapidCheck, so to be called within rc::check only.
namespace coordreq {

/// What a random right-hand side may contain.
enum class Roughness {
  smooth,         ///< arithmetic and elementary functions
  lipschitz,      ///< and abs, min, max
  discontinuous,  ///< and sign, if
};

[[nodiscard]] int pick(int count);
/// One of so many doubles from lower to upper, ends included.
[[nodiscard]] double pick_between(double lower, double upper, int count = 17);

/// An expression in x, y, z (the first `states` of them), u, v, w, d.
[[nodiscard]] std::string random_field(int depth, int states, Roughness roughness);

/// One to three states, random equations, boxes and period.
[[nodiscard]] FlowCase random_case(Roughness roughness);

/// A corner, the centre, a point of a face or any point of the initial box, within the limits.
[[nodiscard]] std::vector<long double> random_start(const FlowCase& system);
/// Switches at random times between values that are ends more often than not.
[[nodiscard]] Signal random_signal(const FlowCase& system);

}  // namespace coordreq
