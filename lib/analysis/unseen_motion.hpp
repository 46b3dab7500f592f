#pragma once

#include <cstdint>

#include "answers/analysis_context.hpp"
#include "answers/warning.hpp"

namespace coordreq {

/// What a search did: reads of tables and sets, and solutions followed.
struct SearchWork {
  std::int64_t reads = 0;
  std::int64_t followed = 0;
};

/// Where safety is asked at samples only: a motion from one cell of a set to others of it, under an
/// admissible joint input, that passes cells outside S in between. Tried on a sample: a fixed amount of work,
/// the same on every machine and no more than a sixteenth of a read a cell on large grids. Cells are chosen
/// by the straight line to the middle of their post, and then followed from their centre with disturbances in
/// the middle, without a guarantee; whoever finds none has proved nothing. Of those found it tells the first
/// where the condition itself fails, else the first.
/// @param kept K, or S where K is not known
/// @pre the context is set up, by one process; `kept` has its rows
[[nodiscard]] Warnings advise_on_unseen_motion(const AnalysisContext& context, const CellSet& kept,
                                               ThreadTeam& team, SearchWork& work);

}  // namespace coordreq
