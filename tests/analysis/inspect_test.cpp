#include <gtest/gtest.h>

#include <cstdlib>

#include "analysis/analyze.hpp"
#include "analysis/estimate_memory.hpp"
#include "base/error.hpp"
#include "reach/abstraction.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

ProblemSpec spec_of(const std::string& upper) {
  return read_spec(R"({"coordreq": 1, "name": "t",
"states": [{"name": "p", "lower": 0, "upper": )" +
                       upper +
                       R"(, "step": 1, "unit": "m"}, {"name": "v", "lower": 0, "upper": 9, "step": 1}],
"inputs": [{"name": "u", "values": [-1, 0, 2]}, {"name": "b", "values": [0, 1]}], "disturbances": [{"name": "w", "lower": 0, "upper": 1}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "c", "inputs": ["b"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"p": "v", "v": "u + w"}}, "safe": "true"})",
                   "test");
}

TEST(Inspect, ReportsSizesAndDependencies) {
  const SpecReport report = inspect(spec_of("99"), 1);
  EXPECT_EQ(report.cells, 1000);
  EXPECT_EQ(report.joint_inputs, 6);
  using Names = std::vector<std::string>;
  const SpecReport::State& p = report.states[0];
  EXPECT_EQ(p.states, (Names{"p", "v"}));
  EXPECT_EQ(p.inputs, Names{"u"});
  EXPECT_EQ(p.disturbances, Names{"w"});
  EXPECT_TRUE(p.shift);
  EXPECT_EQ(p.table_entries, 10U * 3U);
  EXPECT_EQ(p.table_bytes, 10U * 3U * 8U);
  const SpecReport::State& v = report.states[1];
  EXPECT_EQ(v.states, Names{"v"});
  EXPECT_EQ(v.inputs, Names{"u"});
  EXPECT_EQ(v.disturbances, Names{"w"});
  EXPECT_TRUE(v.shift);
  EXPECT_EQ(v.table_entries, 3U);
  EXPECT_EQ(report.partitions, (std::vector<std::string>{"a|c"}));
  EXPECT_TRUE(report.exact);
}

TEST(Inspect, SaysWhatAResultWouldGuarantee) {
  ProblemSpec spec = spec_of("99");
  EXPECT_EQ(inspect(spec, 1).guarantee, "samples");
  const std::uint64_t memory = inspect(spec, 1).memory_bytes;
  spec.abstraction.between_samples = true;
  EXPECT_EQ(inspect(spec, 1).guarantee, "continuous");
  EXPECT_GT(inspect(spec, 1).memory_bytes, memory);
  spec.abstraction.safe = Membership::center;
  EXPECT_EQ(inspect(spec, 1).guarantee, "samples-center");
}

TEST(Inspect, MemoryGrowsWithTheCells) {
  EXPECT_GT(inspect(spec_of("9999999"), 1).memory_bytes,
            inspect(spec_of("99"), 1).memory_bytes + 1000000 * 80U);
}

TEST(ThreadsOfAnAnalysis, AreFewerWhereMemoryIsShort) {
  // A sanitiser takes memory of its own between the estimates.
  if (std::getenv("COORDREQ_SANITIZED") != nullptr) GTEST_SKIP();
  const ProblemSpec spec = spec_of("99");
  const Model model = make_model(spec);
  EXPECT_EQ(threads_within(model, std::nullopt, 64, false), 64);
  EXPECT_EQ(threads_within(model, std::uint64_t{1} << 40U, 64, false), 64);
  const double few = estimate_memory(model, 5), many = estimate_memory(model, 64);
  ASSERT_LT(few, many);
  const int within = threads_within(model, static_cast<std::uint64_t>(few + 100000), 64, false);
  EXPECT_GE(within, 5);
  EXPECT_LT(within, 10);
}

TEST(ThreadsOfAnAnalysis, RefusesWithTheEstimateBeforeAnythingRuns) {
  try {
    static_cast<void>(threads_within(make_model(spec_of("99999999")), std::uint64_t{1} << 30, 1, false));
    FAIL() << "expected a LimitError";
  } catch (const LimitError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 30), "1,000,000,000 cells need about");
    EXPECT_EQ(error.exit_code(), ExitCode::limit);
  }
}

}  // namespace
}  // namespace coordreq
