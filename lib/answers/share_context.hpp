#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "answers/analysis_context.hpp"
#include "ranks/row_share.hpp"

// The context of several processes: whose rows are whose, and the ghost rows that each holds of others.
namespace coordreq {

/// Before the rows are cut.
[[nodiscard]] RowShare nothing_owned(Ranks& ranks);

/// Cuts the rows, if that is still to be done, and finds S in those held. Together.
/// @param find_safe adds S in some rows
/// @pre unchecked: there are engine and hull
void share_context(AnalysisContext& context, bool is_cut,
                   const std::function<void(const std::vector<RowShare::Range>&)>& find_safe);

/// Rows that a process would own, and ghost rows that it would hold.
struct RankRows {
  std::int64_t owned = 0;
  std::int64_t ghosts = 0;
  std::vector<double> slices = {};  ///< RowFractions::slices
};
/// [rank] The rows of `ranks` processes. Ghost rows are counted for all cells, in S or not. @pre unchecked:
/// the abstraction is there
[[nodiscard]] std::vector<RankRows> rows_of_ranks(const AnalysisContext& context, int ranks);

}  // namespace coordreq
