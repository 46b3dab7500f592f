#pragma once

#include "reach/abstraction.hpp"

namespace coordreq {

/// Gives a small abstraction tables drawn at random inside a RapidCheck property: some leading states that
/// move by themselves, and behind them sums that vary along the rows, with terms that depend on anything.
/// Ranges stay near the cell mostly, some leave the domain.
void draw_sums(Abstraction& abstraction);

}  // namespace coordreq
