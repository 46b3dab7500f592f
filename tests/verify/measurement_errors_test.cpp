// Measurement errors in every kind of post: what an analysis writes that counts half of the error is found
// to be wrong, and what one writes that counts all of it is not.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "support/analysed_file.hpp"

namespace coordreq {
namespace {

struct Kind {
  const char* name;
  const char* time;
  const char* equation_of_x;
  const char* equation_of_y;
  const char* more = "";  ///< in the dynamics
};

std::string spec_text(const Kind& kind, const std::string& error) {
  return fmt::format(R"({{"coordreq": 1, "name": "measured",
"states": [{{"name": "x", "lower": 0, "upper": 12, "step": 1, "outside": "saturate", "measurement_error": {}}},
           {{"name": "y", "lower": 0, "upper": 3, "step": 1, "outside": "saturate"}},
           {{"name": "m", "lower": 0, "upper": 1, "step": 1, "discrete": true}}],
"inputs": [{{"name": "u", "values": [-1, 0, 1]}}, {{"name": "v", "values": [-1, 0, 1]}}],
"agents": [{{"name": "a", "inputs": ["u"]}}, {{"name": "b", "inputs": ["v"]}}],
"dynamics": {{"time": "{}", "period": 1, "equations": {{"x": "{}", "y": "{}"{}}}{}}},
"safe": "x >= 1", "abstraction": {{"cells": "half_open"}}, "output": {{"abstraction": true}}}})",
                     error, kind.time, kind.equation_of_x, kind.equation_of_y,
                     *kind.more == '\0' ? R"(, "m": "0")" : "", kind.more);
}

TEST(MeasurementErrors, CountInEveryKindOfPost) {
  const Kind kinds[] = {
      {"an affine map", "discrete", "0.5*x + 0.2 + 3*u", "y + v"},
      {"a shift", "discrete", "x + 0.3 + 3*u", "y + v"},
      {"a nonlinear map", "discrete", "0.05*x^2 + 3*u", "y + v"},
      {"a nonlinear map that shifts", "discrete", "x + 0.35*sin(y) + 3*u", "y + v"},
      {"a sum", "discrete", "0.5*x + 0.3*y*cos(u) + sin(v)", "y + v"},
      {"a flow of integrators", "continuous", "y + u", "v"},
      {"a nonlinear flow", "continuous", "u - 0.02*x^2", "v"},
      {"an update", "continuous", "u", "v", R"json(, "updates": {"m": "if(x >= 5.8, 1, 0)"})json"},
  };
  ThreadTeam team(2);
  for (const Kind& kind : kinds) {
    const ClaimedFile right = analysed_file(spec_text(kind, "0.4"), team);
    EXPECT_EQ(complaints(verify_file(right, {}, team)), "") << kind.name;
    ClaimedFile wrong = analysed_file(spec_text(kind, "0.2"), team);
    wrong.spec = right.spec;
    EXPECT_EQ(verify_file(wrong, {}, team).verdict(), Verdict::wrong) << kind.name;
  }
}

}  // namespace
}  // namespace coordreq
