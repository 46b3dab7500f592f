// States that go round where equations jump: sin, cos and tan of a state whose period is another than theirs,
// and the state as a number.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "support/analysed_file.hpp"
#include "support/draw.hpp"
#include "support/read_system.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/piece_choices.hpp"

namespace coordreq {
namespace {

std::string ring_text(const std::string& equation, const std::string& period = "0.3") {
  return fmt::format(R"({{"coordreq": 1, "name": "ring",
"states": [{{"name": "y", "lower": -1, "upper": 1, "count": 10, "outside": "periodic"}}],
"inputs": [{{"name": "u", "values": [-1, 1]}}], "agents": [{{"name": "a", "inputs": ["u"]}}],
"dynamics": {{"time": "continuous", "period": {}, "equations": {{"y": "{}"}}}},
"safe": "true", "output": {{"abstraction": true}}}})",
                     period, equation);
}

struct Ends {
  double lower = 0.0;
  double upper = 0.0;
};

/// Of y, with u = 1.
std::optional<Ends> ends_of(const SystemSpec& spec, double from, double to, const Effort& effort) {
  SpanBox box(spec.slot_count());
  box[spec.state_slot(0)] = span_of(exact(from), exact(to));
  box[spec.input_slot(0)] = span_of(1, 1);
  FlowExtremes flow(spec, influences_on(spec, 0), 0.2);
  if (!flow.enclose(box, effort)) return std::nullopt;
  const auto never = [](const Arb&, const Arb&) { return false; };
  const Extremes found = flow.extremes(0, never);
  return Ends{found.least.bound.lower_rational().get_d(), found.greatest.bound.upper_rational().get_d()};
}

/// The state after 0.3, unwrapped, by many small steps.
template <class Equation>
double followed(const Equation& f, double y) {
  constexpr int kSteps = 20'000;
  const auto seen = [](double x) { return x - 2.0 * std::floor((x + 1.0) / 2.0); };
  for (int k = 0; k < kSteps; ++k) y += 0.3 / kSteps * f(seen(y));
  return y;
}

TEST(Seams, ASolutionGoesOnWithWhatIsBeyond) {
  const SystemSpec spec = read_system(ring_text("2 + sin(y) + 0*u"), "ring");
  const auto f = [](double y) { return 2.0 + std::sin(y); };
  const std::optional<Ends> found = ends_of(spec, 0.8, 0.99, {96, 1e-7});
  ASSERT_TRUE(found);
  EXPECT_LE(found->lower, followed(f, 0.8) + 1e-4);
  EXPECT_GE(found->upper, followed(f, 0.99) - 1e-4);
  EXPECT_NEAR(found->lower, followed(f, 0.8), 0.02);
  EXPECT_NEAR(found->upper, followed(f, 0.99), 0.02);
}

TEST(Seams, WhatTurnsBackAtASeamIsEnclosed) {
  // Up to the seam from below and down to it from above.
  const SystemSpec spec = read_system(ring_text("y + 0*u"), "ring");
  const std::optional<Ends> found = ends_of(spec, 0.7, 0.9, {96, 1e-7});
  ASSERT_TRUE(found);
  EXPECT_LE(found->lower, 0.7 * std::exp(0.3) + 1e-9);
  EXPECT_GE(found->upper, 1.0 - 1e-9);
  EXPECT_LE(found->upper, 1.05);
}

TEST(Seams, RandomFlowsAreHeld) {
  EXPECT_TRUE(rc::check("flows over seams", [] {
    const double a = draw(-3, 3), b = draw(-2, 2), c = draw(1, 4), d = draw(-1, 1), e = draw(0, 2);
    const std::string text = fmt::format("{} + ({})*sin({}*y + {}) + {}*y*u", a, b, c, d, e);
    RC_LOG(text);
    const SystemSpec spec = read_system(ring_text(text), "ring");
    const double from = -1.0 + 0.1 * draw(0, 18);
    const std::optional<Ends> found = ends_of(spec, from, from + 0.19, {32, 1e-6});
    RC_ASSERT(found.has_value());
    const auto f = [&](double y) { return a + b * std::sin(c * y + d) + e * y; };
    for (int k = 0; k <= 8; ++k) {
      const double end = followed(f, from + 0.19 * k / 8);
      RC_ASSERT(found->lower - 2e-3 <= end && end <= found->upper + 2e-3);
    }
  }));
}

TEST(Seams, AllPostsOfASeamOfAnotherPeriodAreConfirmed) {
  ThreadTeam team(2);
  const Verification found = verify_file(analysed_file(ring_text("2 + sin(y) + 0*u"), team), {}, team);
  EXPECT_EQ(complaints(found), "");
  EXPECT_EQ(found.confirmed, found.enclosed);
}

TEST(Seams, RandomSystemsHold) {
  std::int64_t confirmed = 0, enclosed = 0;
  int refused = 0;  // where tan may turn so often that its poles are not seen to be passed by
  EXPECT_TRUE(rc::check("systems with seams", [&] {
    const std::string function = pick<std::string>({"sin", "cos", "tan"});
    const std::string inside = function == "tan" ? "y/4" : fmt::format("{}*y + {}", draw(1, 4), draw(-1, 1));
    const std::string text = fmt::format("{} + ({})*{}({}) + {}", draw(-3, 3), draw(-2, 2), function, inside,
                                         pick<std::string>({"u", "y*u", "0*u", "abs(y)*u"}));
    RC_LOG(text);
    ThreadTeam team(2);
    VerifyOptions options;
    options.budget_seconds = 1.0;
    try {
      const ClaimedFile file = analysed_file(ring_text(text, pick<std::string>({"0.1", "0.3", "1"})), team);
      const Verification found = verify_file(file, options, team);
      RC_ASSERT(found.verdict() != Verdict::wrong);
      confirmed += found.confirmed;
      enclosed += found.enclosed;
    } catch (const SpecError&) {
      ++refused;
    }
  }));
  EXPECT_LE(refused, 10);
  EXPECT_GE(2 * confirmed, enclosed);
}

}  // namespace
}  // namespace coordreq
