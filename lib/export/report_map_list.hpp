#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "export/report_data.hpp"
#include "export/report_maps.hpp"
#include "export/report_members.hpp"

namespace coordreq {

/// A map and what the page calls it.
struct ReportMap {
  nlohmann::ordered_json head;
  ReadCells read;
  std::shared_ptr<MemberMap> members;                       ///< of maps of pairs and modes
  std::shared_ptr<std::set<std::int32_t>> coalitions = {};  ///< of the coalition map: partitions read so far
};

/// The maps of a page: the delay of each of `partitions`, the collision time, and what else the file has.
/// REQUIRES: `results` outlives them.
[[nodiscard]] std::vector<ReportMap> list_maps(const ResultsReader& results,
                                               const std::vector<std::size_t>& partitions,
                                               const ReportLimits& limits);

/// pack_map(), with as many members as can be numbered; completes the head.
[[nodiscard]] std::vector<PackedMap> pack_listed(const ResultsReader& results, ReportMap& map,
                                                 const std::vector<ReportCells>& sets);

}  // namespace coordreq
