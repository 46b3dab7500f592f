#pragma once

#include <string>
#include <vector>

#include "reach/random_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

/// A random small problem of states x, y, z, inputs u, v and disturbances w, d with right-hand sides from the
/// whole grammar, in discrete or continuous time: grids of a few cells, every `outside` rule, measurement
/// errors, both kinds of cells.
struct RandomDynamics {
  std::string text;  ///< the spec as JSON
  SystemSpec spec;
  FlowCase system;  ///< the same equations, boxes of w and d, limits and period; for integrate()

  /// Draws with RapidCheck. @throws SpecError if the expressions drawn are beyond the grammar's limits
  static RandomDynamics draw();
};

}  // namespace coordreq
