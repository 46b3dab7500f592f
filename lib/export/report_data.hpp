#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/results_reader.hpp"

namespace coordreq {

/// Limits of the data of a page.
struct ReportLimits {
  std::int64_t values = std::int64_t{1} << 27;  ///< numbers, in all maps
  std::size_t packed_bytes = std::size_t{12} << 20;
  std::size_t partitions = 8;   ///< of which the delay is displayed for each cell
  std::size_t members = 64;     ///< pairs of agents, modes of the network; at most 64
  std::size_t agents = 8;       ///< of which shares are displayed, and modes of which probabilities are
  std::size_t subsets = 65536;  ///< different sets of members that there may be
};

/// The data of a page.
struct ReportData {
  std::string json;                     ///< the document that lib/export/report reads
  std::vector<std::size_t> partitions;  ///< of which there are maps, ascending
  /// For each of them the first cell with the longest finite delay, or, if there is none, the first of K; -1
  /// if K is empty.
  std::vector<std::int64_t> best_cells;
  bool is_whole = true;  ///< every cell is in it
};

/// Memory of report_data() and of a page with its text, in bytes.
[[nodiscard]] double report_bytes(const ResultsReader& results, const ReportLimits& limits = {});
/// The maps of cells as one JSON document: grid points and layers, and for each set of cells that
/// choose_cells() finds the delay of each of `partitions` and the collision time; where the file has them the
/// coalition, the critical pairs, the modes of the network that are safe, and the freedom that the convention
/// leaves each agent, in hundredths of a per cent; of probabilities 0, or 1 and the hundredths of powers of
/// ten above 1e-12, rounded up. With them the paths of the counterexamples, and the kind of the map that
/// shows what they contradict.
///
/// Of pairs and modes a map holds numbers of sets, which its head lists as hexadecimal digits of bits, the
/// first member the lowest bit. If there are more members than the limits say, or more sets than these, only
/// the first members are in it; its head has `total`.
///
/// If the maps of all cells take more than the limits, fewer cells are in it; the values of these are those
/// of the file. A map is packed as base64 of a zlib stream of unsigned little-endian integers of 1, 2 or 4
/// bytes: a number v as v + 3, so that the flags -3, -2, -1 have room, and infinity as the type's maximum. In
/// order: row-major over the indices of the set, the last dimension fastest.
///
/// Memory: 4 bytes a value of one map, plus the text. Reads each map twice.
/// @param partitions positions, ascending; as many as are to be displayed
/// @throws as the member functions of ResultsReader
[[nodiscard]] ReportData report_data(const ResultsReader& results, std::vector<std::size_t> partitions,
                                     const ReportLimits& limits = {});

}  // namespace coordreq
