#include "engine/pair_table.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "answers/invariance/safe_set.hpp"
#include "spec/read_spec.hpp"
#include "support/condition_helpers.hpp"

namespace coordreq {
namespace {

ProblemSpec problem(std::int64_t length, const std::string& allow) {
  return read_spec(R"({"coordreq": 1, "name": "p",
"states": [{"name": "x", "lower": 0, "upper": 2, "step": 1},
           {"name": "y", "lower": 1, "upper": )" +
                       std::to_string(length) + R"(, "step": 1}],
"inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [0, 1, 2, 3, 4, 5, 6]}],
"agents": [{"name": "a", "inputs": ["u", "v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}}, "safe": "true",
"controller": {"allow": ")" +
                       allow + "\"}}",
                   "test");
}

TEST(PairTable, HasThePairsThatAreListedAndAllowed) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("bits equal single pairs", [&] {
    const auto length = *rc::gen::element<std::int64_t>(1, 7, 8, 9, 63, 64, 65, 130);
    const bool all = *rc::gen::arbitrary<bool>();
    const ProblemSpec spec = problem(length, all ? "true" : "x + u >= 1 or v > 3");
    const Abstraction system{.grid = make_grid(spec), .inputs = make_input_space(spec)};
    const std::int64_t inputs = system.inputs.count();
    PackedPairs listed{.inputs = inputs, .bytes = {}};
    listed.bytes.resize(static_cast<std::size_t>(system.grid.cells() * listed.bytes_per_cell()));
    const int density = *rc::gen::inRange(0, 4);
    for (std::int64_t x = 0; x < system.grid.cells(); ++x) {
      for (std::int64_t u = 0; u < inputs; ++u) {
        if (*rc::gen::inRange(0, 3) < density) listed.set(x, u);
      }
    }
    const PairRules rules = pair_rules(spec, system, team, &listed);
    RC_ASSERT(rules.permitted.has_value() == !all);
    for (std::int64_t x = 0; x < system.grid.cells(); ++x) {
      for (std::int64_t u = 0; u < inputs; ++u) {
        const bool allowed =
            all || system.grid.index(x, 0) + system.inputs.index(u, 0) >= 2 || system.inputs.index(u, 1) > 3;
        const ConstRow row = rules.admissible()->row(x / length, u);
        const auto column = static_cast<std::size_t>(x % length);
        RC_ASSERT((row[column / 64] >> (column % 64) & 1U) == (allowed && listed.test(x, u) ? 1U : 0U));
      }
    }
  }));
}

TEST(PairTable, IsNoneWhereEverythingIsAdmissible) {
  ThreadTeam team(1);
  const ProblemSpec spec = problem(5, "true");
  const Abstraction system{.grid = make_grid(spec), .inputs = make_input_space(spec)};
  EXPECT_EQ(pair_rules(spec, system, team).admissible(), nullptr);
}

}  // namespace
}  // namespace coordreq
