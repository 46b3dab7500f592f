#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cell/analyzed_file.hpp"
#include "cell/cell_controller.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {

/// What the file says of all cells, by one or the other way.
struct AllActions {
  std::vector<std::vector<bool>> joint;                  ///< [cell]
  std::vector<std::vector<std::vector<bool>>> by_class;  ///< [cell * partitions + partition][class]

  /// Cell by cell, since a controller that computes keeps the last cell only.
  AllActions(const ResultsReader& results, CellController& controller) {
    for (std::int64_t x = 0; x < results.grid().cells(); ++x) {
      joint.push_back(controller.joint_inputs(x));
      for (std::size_t p = 0; p < results.partitions().size(); ++p) {
        by_class.push_back(controller.actions(p, x));
      }
    }
  }
};

/// Analyses the spec with and without its actions stored and compares what the two files say of every cell.
/// @param singles how many cells or more are also asked for on their own, before anything was worth computing
///   as a whole
inline void expect_same_actions(const std::string& spec, ThreadTeam& team, std::int64_t singles = 5) {
  const sample::ScratchFolder folder;
  analyze_into(folder / "all.h5", spec, R"("controller": true, "actions": true)", team);
  analyze_into(folder / "none.h5", spec, "", team);
  const ResultsReader stored(folder / "all.h5");
  std::vector<const char*> names = {"none.h5"};
  // Tubes are not stored: a file with tables is read as one without.
  if (!stored.spec().abstraction.between_samples) {
    analyze_into(folder / "tables.h5", spec, R"("abstraction": true)", team);
    names.push_back("tables.h5");
  }
  CellController by_file(stored, team);
  const AllActions expected(stored, by_file);
  for (const char* const name : names) {
    const ResultsReader results(folder / name);
    for (const bool at_once : {false, true}) {
      CellController computed(results, team);
      if (at_once) computed.prepare_all();
      const AllActions found(results, computed);
      ASSERT_EQ(found.joint, expected.joint);
      ASSERT_EQ(found.by_class, expected.by_class);
    }
    for (std::int64_t x = 0; x < results.grid().cells(); x += 1 + results.grid().cells() / singles) {
      CellController single(results, team);
      ASSERT_EQ(single.joint_inputs(x), expected.joint[static_cast<std::size_t>(x)]);
    }
  }
}

}  // namespace coordreq
