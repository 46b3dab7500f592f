#pragma once

#include "answers/analysis_context.hpp"
#include "answers/countdown/safe_sides.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"

namespace coordreq {

/// Takes cells out from which the outward joint input leads to a cell that is out: in rounds, each of which
/// sees what the one before has taken out, until a round takes out few. What is left may still lead out.
///
/// Why: most runs that leave through a safe side do so by going on outward. Of the box that a row then leads
/// to one row is looked at, and in that one cell for each, by words. Nothing is done where rows are added up
/// or run along several dimensions.
/// @param all cells that may be out, in the rows held
/// @param outward those in whose C(x) the outward joint input is, in the rows owned
/// @param left of `all` the cells that are not out; in ghost rows these may be too many
/// @returns how many cells of the rows owned were taken out; the same for any number of threads
std::int64_t take_out_runs(const AnalysisContext& context, const SafeSides& sides, const CellSet& all,
                           const CellSet& outward, ThreadTeam& team, CellSet& left);

}  // namespace coordreq
