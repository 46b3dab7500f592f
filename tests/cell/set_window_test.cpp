#include "cell/set_window.hpp"

#include <gtest/gtest.h>

#include <set>

#include "cell/analyzed_file.hpp"
#include "results/results_reader.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

// Everything stays where it is, so K is S.
const char* const kSpec = R"json({
  "coordreq": 1, "name": "still",
  "states": [ { "name": "h", "lower": 0, "upper": 5, "count": 5, "outside": "periodic" },
              { "name": "x", "lower": 0, "upper": 3, "step": 1 } ],
  "inputs": [ { "name": "u", "values": [0] } ],
  "agents": [ { "name": "a", "inputs": ["u"] } ],
  "dynamics": { "time": "discrete", "period": 1, "equations": { "h": "h", "x": "x" } },
  "abstraction": { "cells": "half_open", "safe": "center" },
  "safe": "h != 2 or x != 1" })json";

TEST(SetWindow, SaysOfEveryBoxWhetherItIsInside) {
  ThreadTeam team(1);
  const sample::ScratchFolder folder;
  analyze_into(folder / "still.h5", kSpec, "", team);
  const ResultsReader results(folder / "still.h5");
  ASSERT_EQ(results.attributes().invariant_cells, 19U);
  SetWindow window(results.grid(),
                   [&](const CellBlock& block) { return results.members("/invariant", block); });
  // Small boxes and large ones by turns, so that the window is replaced, kept and enlarged.
  for (std::int32_t first = 0; first < 5; ++first) {
    for (std::int32_t last = first; last < first + 5; ++last) {
      for (std::int32_t low = 0; low < 4; ++low) {
        for (std::int32_t high = low; high < 4; ++high) {
          const std::vector<IndexRange> box = {{first, last}, {low, high}};
          window.cover(box);
          std::set<std::int32_t> headings;
          for (std::int32_t h = first; h <= last; ++h) headings.insert(h % 5);
          EXPECT_EQ(window.contains(box), headings.count(2) == 0 || low > 1 || high < 1);
        }
      }
    }
  }
}

}  // namespace
}  // namespace coordreq
