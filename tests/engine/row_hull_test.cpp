#include "engine/row_hull.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

/// The box of the only row of a ring of 10 cells, each input turning it by one of the offsets.
RowBox box_on_a_ring(const std::vector<IndexRange>& turns) {
  const GridDimension ring{.name = "x",
                           .first = 0,
                           .step = 1,
                           .count = 10,
                           .below = Outside::periodic,
                           .above = Outside::periodic,
                           .lower = 0,
                           .upper = 10};
  std::vector<Rational> values;
  for (std::size_t u = 0; u < turns.size(); ++u) values.emplace_back(static_cast<long>(u));
  Abstraction abstraction{.grid = UniformGrid({ring}), .inputs = InputSpace({{"u", values}})};
  TransitionTable& table = abstraction.tables.emplace_back();
  table.states = {0};
  table.inputs = {0};
  table.shift = true;
  lay_out(table, 0, abstraction.grid, abstraction.inputs);
  table.entries = turns;
  const RowEngine engine(abstraction, nullptr, {});
  RowBox box;
  RowHull(engine).box(RowPosition(abstraction.grid, 0), box);
  return box;
}

TEST(RowHull, OnARingItIsTheShortestArc) {
  EXPECT_EQ(box_on_a_ring({{9, 9}, {1, 2}}).windows, (std::vector<IndexRange>{{-1, 2}}));
}

}  // namespace
}  // namespace coordreq
