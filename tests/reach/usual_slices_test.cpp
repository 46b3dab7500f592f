#include "reach/usual_slices.hpp"

#include <gtest/gtest.h>

#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// Two states of 101 points at a distance of 1, x' as given and y' = 0.
ProblemSpec spec_of(const std::string& x) {
  return read_spec({R"({"coordreq": 1, "name": "two", "inputs": [{"name": "u", "values": [0, 1]}],
    "states": [{"name": "x", "lower": -50, "upper": 50, "step": 1},
               {"name": "y", "lower": -50, "upper": 50, "step": 1}],
    "agents": [{"name": "a", "inputs": ["u"]}], "safe": "true",
    "dynamics": {"time": "discrete", "period": 1, "equations": {"x": ")" +
                        x + R"(", "y": "0"}}})",
                    "two", ""});
}

UsualSlices slices_of_x(const ProblemSpec& spec) {
  return usual_slices(spec, 0, table_shapes(spec)[0], 1);
}

TEST(UsualSlices, ARowHasAPieceForEachPlaceThatItsCellsGoTo) {
  const UsualSlices slices = slices_of_x(spec_of("0.01*x^2 + 0.1*y + u"));
  EXPECT_GT(slices.segments, 15);  // posts of a tenth of a cell, of which every tenth meets two cells
  EXPECT_LT(slices.segments, 40);
}

TEST(UsualSlices, RowsThatSayTheSameCountOnce) {
  const UsualSlices few = slices_of_x(spec_of("0.001*floor(x/40) + 0.1*y + u"));
  EXPECT_GE(few.different, 2);
  EXPECT_LT(few.different, 30);
}

TEST(UsualSlices, WhereMostAreDifferentAllAre) {
  EXPECT_EQ(slices_of_x(spec_of("sin(x) + x*sin(y)")).different, 101);
}

TEST(UsualWidths, AreThoseOfTheMiddleCell) {
  const std::vector<std::int32_t> widths = usual_widths(spec_of("x + 3*y + u"));
  EXPECT_GE(widths[0], 4);
  EXPECT_LE(widths[0], 6);
  EXPECT_LE(widths[1], 1);
}

}  // namespace
}  // namespace coordreq
