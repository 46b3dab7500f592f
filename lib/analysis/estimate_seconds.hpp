#pragma once

#include <optional>

#include "base/thread_team.hpp"
#include "model/model.hpp"

namespace coordreq {

/// About how many seconds the analysis takes on this machine if nothing else runs, with these threads,
/// without the writing of its file. Copies of the problem on coarser grids are computed, each about four
/// times as large as the one before, until one takes long enough to be measured. Where posts are enclosures,
/// tables are taken to take as long for each box as a sample of the problem's own boxes (EnclosureSample),
/// and boxes of copies are not divided; other tables as long for each entry as those of the last copy. All
/// else is taken to grow on by the power of the number of cells by which it grew from copy to copy. Copies
/// ask for no requirements and take no controller from a file. Nothing where there are none, as where a
/// coarser grid makes an error, unless tables are known. A copy that takes longer than two seconds is given
/// up: its tables are taken to go on as they began. For users to see: no result depends on it. Cost: a second
/// or two.
[[nodiscard]] std::optional<double> estimate_seconds(const Model& model, ThreadTeam& team);

/// Whether a problem is so large that the analysis may take hours: so that it is worth an estimate.
[[nodiscard]] bool may_take_hours(const Model& model);

}  // namespace coordreq
