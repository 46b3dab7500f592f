#pragma once

#include "answers/analysis_context.hpp"
#include "answers/warning.hpp"

namespace coordreq {

/// A state of S at rest at the limit of a `stop` side, with an input under which nothing moves, whose cell is
/// not in K. The cell around a limit holds everything from the limit to half a step beside it, a vehicle that
/// stands and others that creep; so its reachable set spreads to the next position at every step, on every
/// grid. Centres of cells are looked at where all states with such a side are at it: some thousand cells, and
/// some inputs; none found proves nothing. Nothing is said where nobody chooses (`given`, a controller file),
/// where memories are kept, or where a state at rest would depend on a disturbance.
/// @param invariant K @pre the context is set up, by one process; the set has its rows
[[nodiscard]] Warnings advise_on_standing(const AnalysisContext& context, const CellSet& invariant);

}  // namespace coordreq
