#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "answers/field.hpp"
#include "base/process_memory.hpp"
#include "base/thread_team.hpp"
#include "export/cell_table.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Takes an exported text in segments, in order; may throw.
using TextSink = std::function<void(std::string_view)>;

/// Values on a box of cells in three dimensions, as plain data for tools that draw. Where fewer states are
/// displayed, the other dimensions have one cell and an axis without a name.
struct ImageContent {
  std::string title;
  std::array<std::string, 3> axes;              ///< of x, y, z: "p1 [m]"
  std::string cut;                              ///< the cut through the other states: "v2 = 2.8 m/s, p2: min"
  std::array<double, 3> origin{};               ///< the corner at the lower end of all axes
  std::array<double, 3> spacing{1, 1, 1};       ///< sides of a cell
  std::array<std::uint64_t, 3> cells{1, 1, 1};  ///< along each axis

  struct Array {
    std::string name;
    ResultArray values;  ///< cells[0] * cells[1] * cells[2] elements, x fastest
  };
  std::vector<Array> arrays;
};

/// One line a cell that the selection leaves: the centre in the dimensions that remain, then `safe`,
/// `invariant`, `collision_time` and for each partition `delay:P` and `countdown:P`, coded as in the results
/// file with "inf" for its maximum. The first line names the columns.
void export_csv(const ResultsReader& results, const TableSelection& selection, const TextSink& sink);

/// The columns of a table of cells as an image: the states that the selection leaves are its axes, in the
/// order of the spec. Each array is float64, coded as in the results file, with infinity for its maximum, so
/// that a colour scale of the finite values shows the steps.
///
/// Memory: 4 bytes for each cell that is left and each column.
/// @throws UsageError if more than three states are left
[[nodiscard]] ImageContent cell_image(const ResultsReader& results, const TableSelection& selection);
/// Memory of cell_image(), in bytes.
[[nodiscard]] double image_bytes(const ResultsReader& results, const TableSelection& selection);

/// An image as VTK's XML image data (.vti): values at cells, compressed, appended as raw bytes. Every version
/// of VTK and ParaView that is in use reads it. `title`, `axes` and `cut` are field data.
///
/// Source: "VTK File Formats" in The VTK User's Guide, 11th edition.
/// @pre every array is float64
void export_vti(const ImageContent& image, const TextSink& sink);

/// Which controller an export is of.
enum class ControllerKind : std::uint8_t {
  safety,    ///< C: that of K
  progress,  ///< P: that of the goal, in the cells from which it can be forced
};

/// The controller as a static controller of SCOTS v0.2: the grids of states and joint inputs, and for each
/// cell that has any its number and those of its joint inputs. Numbers count with dimension 0 fastest.
/// @throws ResultsError if SCOTS cannot have the grids: points that are no multiples of the step, or listed
///   input values that are not evenly spaced and ascending
/// @pre for `progress` the spec has a goal
void export_scots(const ResultsReader& results, ControllerKind kind, ThreadTeam& team, const TextSink& sink);
/// Memory of export_scots().
[[nodiscard]] MemoryDemand scots_demand(const ResultsReader& results);

/// A C99 header, complete in itself, that holds the trigger table of one partition and the admissible actions
/// of its classes: functions from a measured state to its cell and from a cell to its countdown and actions.
///
/// Cells with the same countdown and actions that follow one another are one run; a lookup is a binary search
/// among the runs. Sets of actions are stored once each, as bits. Cells are found by comparing with the exact
/// faces, so that no rounding puts a state into another cell than query does.
/// @pre partition < results.partitions().size()
/// @throws LimitError beyond 2^31 - 1 cells; ResultsError if the actions cannot be computed
void export_c_header(const ResultsReader& results, std::size_t partition, ThreadTeam& team,
                     const TextSink& sink);
/// Memory of export_c_header().
[[nodiscard]] MemoryDemand c_header_demand(const ResultsReader& results);

}  // namespace coordreq
