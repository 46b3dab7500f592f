#pragma once

#include <optional>

#include "base/thread_team.hpp"
#include "model/model.hpp"

namespace coordreq {

/// About how many seconds the analysis takes on this machine, with these threads, without the writing of its
/// file. Copies of the problem on coarser grids are worked out, each about four times as large as the one
/// before, until one takes long enough to be measured; tables are taken to take as long for each entry as
/// those of the last copy, and all else to grow on by the power of the number of cells by which it grew from
/// copy to copy. A problem that is itself so small is measured. Nothing where there are no such copies: with
/// a controller file, or where a coarser grid makes an error. For users to see: no result depends on it.
/// Cost: seconds at most, usually some tenths.
[[nodiscard]] std::optional<double> estimate_seconds(const Model& model, ThreadTeam& team);

/// Whether a problem is so large that the analysis may take hours: so that it is worth an estimate.
[[nodiscard]] bool may_take_hours(const Model& model);

}  // namespace coordreq
