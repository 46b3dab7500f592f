#include "engine/engine_sizes.hpp"

#include <gtest/gtest.h>

#include "engine/join_rows.hpp"
#include "engine/row_engine.hpp"
#include "model/model.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/table_shapes.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

ProblemSpec plane(const std::string& equations, const std::string& outside = "unsafe") {
  const std::string state = R"(, "lower": 0, "upper": 30, "step": 1, "outside": ")" + outside + R"("})";
  return read_spec(R"({"coordreq": 1, "name": "rows", "states": [{"name": "a")" + state +
                       R"(, {"name": "b")" + state + R"(, {"name": "c")" + state +
                       R"(], "inputs": [{"name": "u", "values": [-2, 0, 3]}],
                       "agents": [{"name": "one", "inputs": ["u"]}], "safe": "a > 0",
                       "dynamics": {"time": "discrete", "period": 1, "equations": )" +
                       equations + "}}",
                   "test");
}

/// Compares estimates with the sizes of what the engine makes of the same spec.
void expect_sizes(const ProblemSpec& spec) {
  ThreadTeam team(1);
  const Model model(spec, table_shapes(spec));
  const EngineSizes sizes(model);
  Abstraction f = arranged(build_abstraction(spec, team), model.order());
  f.grid = join_rows(f, model.most_along());
  const RowEngine engine(f, nullptr, {});
  EXPECT_EQ(sizes.grid().across(), f.grid.across());
  const auto levels = static_cast<double>(engine.make_levels<std::uint8_t>(engine.posts()).bytes());
  EXPECT_GE(sizes.levels() + 100, levels);
  EXPECT_LE(sizes.levels(), 2 * levels + 100);  // how far posts go is not known yet
  const auto set = static_cast<double>(CellSet(engine.rows(), engine.row_length()).words().size_bytes());
  EXPECT_GE(1.01 * sizes.set(), set);
  EXPECT_LE(sizes.set(), 1.2 * set);
  for (std::size_t t = 0; t < engine.tables(); ++t) {
    EXPECT_GE(1.1 * sizes.slices(t) + 2000, static_cast<double>(engine.slices()[t].bytes())) << t;
    EXPECT_NEAR(sizes.table(t), static_cast<double>(f.tables[t].bytes()), 1) << t;
  }
}

TEST(EngineSizes, AreToldBeforeThereAreTables) {
  for (const char* outside : {"unsafe", "safe", "saturate"}) {
    SCOPED_TRACE(outside);
    expect_sizes(plane(R"({"a": "a + u", "b": "b - u", "c": "c + 2 * u"})", outside));  // one long row
    expect_sizes(plane(R"({"a": "a + u", "b": "b + u", "c": "c + a / 10"})", outside));
    expect_sizes(plane(R"({"a": "a / 2 + u", "b": "b + c", "c": "c - u"})", outside));
    expect_sizes(plane(R"({"a": "a * b / 31 + u", "b": "c", "c": "b"})", outside));
  }
}

TEST(EngineSizes, NeedNoMemoryForThemselves) {
  ProblemSpec spec = plane(R"({"a": "a + u", "b": "b + u", "c": "c + u"})");
  for (StateSpec& state : spec.states) state.grid.count = 1'000'000;
  const Model model(spec, table_shapes(spec));
  EXPECT_NEAR(EngineSizes(model).levels(), 1e18, 1e17);
}

}  // namespace
}  // namespace coordreq
