#pragma once

#include <string>

#include "analysis/analyze.hpp"
#include "app/json_text.hpp"

namespace coordreq {

/// Who must talk to whom, for people: the partitions that cells are given and the pairs that are critical.
/// Empty if the spec has no horizon or K has no cell.
[[nodiscard]] std::string coalition_text(const AnalysisSummary& summary);

/// The same for programs, all partitions and pairs; null if the spec has no horizon.
[[nodiscard]] Json coalition_json(const AnalysisSummary& summary);

}  // namespace coordreq
