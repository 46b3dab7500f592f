#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/json.hpp"
#include "export/report_cells.hpp"
#include "export/report_data.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The values of some cells, packed; see report_data().
struct PackedMap {
  int bytes = 1;     ///< of a number
  std::string data;  ///< base64
};

/// One map for each of some sets of cells.
struct PackedMaps {
  std::vector<PackedMap> sets;
  std::int32_t largest = 0;         ///< finite value, in all cells of the file; 0 if none is larger
  std::vector<std::int32_t> flags;  ///< and what else there is, ascending
};

/// In the order of the sets; the file is read once.
[[nodiscard]] PackedMaps pack_map(const UniformGrid& grid, const ReadCells& read,
                                  const std::vector<ReportCells>& sets);

/// For each cell of K the set of those members that hold there, as a number: sets are numbered as they are
/// found, and the flags -2, -1 say that a cell is not in S, not in K.
class MemberMap {
 public:
  /// Whether a member holds in each cell of a block: 0 or 1.
  using ReadMember = std::function<std::vector<std::uint8_t>(std::size_t member, const CellBlock&)>;

  /// @param names of all members; the first `most` are in the map. @param most_sets that are numbered
  /// @pre 1 <= most <= 64, most_sets >= 2. @pre unchecked: `results` outlives this object
  MemberMap(const ResultsReader& results, ReadMember read, std::vector<std::string> names, std::size_t most,
            std::size_t most_sets);

  [[nodiscard]] std::vector<std::int32_t> read(const CellBlock& block);

  /// False if there were more sets than can be numbered, so that what was read is worth nothing.
  [[nodiscard]] bool fits() const { return sets_.size() <= most_sets_; }
  /// Begins anew with half of the members. One member has two sets.
  void halve();

  /// Names of the members that are in the map.
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] std::size_t total() const { return names_.size(); }
  /// By their numbers, as hexadecimal digits: member m is bit m.
  [[nodiscard]] std::vector<std::string> sets() const;

 private:
  std::int32_t number(std::uint64_t set);

  const ResultsReader& results_;
  ReadMember read_;
  std::vector<std::string> names_;
  std::size_t mapped_, most_sets_;
  std::vector<std::uint64_t> sets_;
  std::unordered_map<std::uint64_t, std::int32_t> numbers_;
};

/// A map and what the page calls it.
struct ReportMap {
  std::shared_ptr<Json> head;
  ReadCells read;
  std::shared_ptr<MemberMap> members = {};  ///< if it is one of sets
  /// FieldMap::legend with the values read so far; may be empty.
  std::function<void(Json& head)> legend = {};
};

/// The maps of a page, of every field that is drawn: first those by partition for each of `partitions`,
/// then the others in the order of the answers. @pre unchecked: `results` outlives them.
[[nodiscard]] std::vector<ReportMap> list_maps(const ResultsReader& results,
                                               const std::vector<std::size_t>& partitions,
                                               const ReportLimits& limits);

/// pack_map(), with as many members as can be numbered; completes the head.
[[nodiscard]] std::vector<PackedMap> pack_listed(const ResultsReader& results, ReportMap& map,
                                                 const std::vector<ReportCells>& sets);

}  // namespace coordreq
