#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "base/json.hpp"
#include "export/report_data.hpp"
#include "export/report_maps.hpp"
#include "export/report_members.hpp"

namespace coordreq {

/// A map and what the page calls it.
struct ReportMap {
  std::shared_ptr<Json> head;
  ReadCells read;
  std::shared_ptr<MemberMap> members = {};  ///< if it is one of sets
  /// FieldMap::legend with the values read so far; may be empty.
  std::function<void(Json& head)> legend = {};
};

/// The maps of a page, of every field that is drawn: first those over partitions for each of `partitions`,
/// then the others in the order of the answers. @pre unchecked: `results` outlives them.
[[nodiscard]] std::vector<ReportMap> list_maps(const ResultsReader& results,
                                               const std::vector<std::size_t>& partitions,
                                               const ReportLimits& limits);

/// pack_map(), with as many members as can be numbered; completes the head.
[[nodiscard]] std::vector<PackedMap> pack_listed(const ResultsReader& results, ReportMap& map,
                                                 const std::vector<ReportCells>& sets);

}  // namespace coordreq
