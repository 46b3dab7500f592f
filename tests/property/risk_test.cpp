// Risks on random systems and networks with numbers: against exact fractions, and against W(q).

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/network/answer.hpp"
#include "answers/network/network_problem.hpp"
#include "answers/risk/answer.hpp"
#include "answers/risk/risk_levels.hpp"
#include "base/json.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/draw.hpp"
#include "support/plain_risk.hpp"
#include "support/random_goal.hpp"
#include "support/random_problem.hpp"
#include "support/random_silence.hpp"

namespace coordreq {
namespace {

/// Parts of 1 in eighths, perhaps with a range about them, of which some may be 0 for certain.
std::vector<Json> draw_probabilities(int count) {
  std::vector<int> eighths(static_cast<std::size_t>(count), 0);
  for (int i = 0; i < 8; ++i) ++eighths[static_cast<std::size_t>(draw(0, count - 1))];
  const bool is_certain = draw(0, 1) == 0;
  std::vector<Json> result;
  for (const int own : eighths) {
    const int low = std::max(0, own - draw(0, 2)), high = std::min(8, own + draw(0, 2));
    if (is_certain || draw(0, 2) == 0) {
      result.emplace_back(own / 8.0);
    } else {
      result.push_back({low / 8.0, high / 8.0});
    }
  }
  return result;
}

Json draw_probability() {
  return draw_probabilities(2).front();
}

std::vector<std::string> names_of_partitions(const ProblemSpec& spec) {
  std::vector<std::string> names;
  for (const PartitionSpec& partition : spec.coordination.partitions) names.push_back(partition.name);
  std::string all;
  for (const AgentSpec& agent : spec.agents) all += (all.empty() ? "" : "+") + agent.name;
  names.push_back(all);
  return names;
}

Json draw_numbers(const ProblemSpec& spec) {
  Json network;
  if (draw(0, 1) == 0) {
    network["loss"] = draw_probability();
    if (draw(0, 1) == 0) network["after_loss"] = draw_probability();
    return network;
  }
  const std::vector<std::string> partitions = names_of_partitions(spec);
  const int modes = draw(1, 4);
  for (int q = 0; q < modes; ++q) {
    network["modes"].push_back({{"name", std::to_string(q)}, {"partition", pick(partitions)}});
    const std::vector<Json> probabilities = draw_probabilities(modes);
    for (int next = 0; next < modes; ++next)
      network["transitions"].push_back(
          {std::to_string(q), std::to_string(next), probabilities[static_cast<std::size_t>(next)]});
  }
  return network;
}

/// A random problem with a network of numbers, and a risk. @param horizon less than 1: random
ProblemSpec draw_risky(int horizon, bool any) {
  Json spec = Json::parse(
      perhaps_with_goal(draw_problem(draw(0, 3) == 0 ? RandomTime::between_samples : RandomTime::any)));
  spec["network"] = draw_numbers(read_spec(spec.dump(), "random"));
  spec["risk"]["horizon"] = horizon < 1 ? draw(1, 5) : horizon;
  const bool is_given = spec["controller"].value("synthesis", "maximal") == "given";
  if (!any && !is_given && draw(0, 1) == 0) spec["risk"]["coordinated"] = "safest";
  if (draw(0, 1) == 0) spec["risk"]["start"] = draw(0, 1) == 0 ? "drawn" : "connected";
  return read_spec(spec.dump(), "random");
}

Rational stored(const RiskRows& rows, std::size_t x) {
  const auto cell = static_cast<std::int64_t>(x);
  return exact(double{risk_of(rows.row(cell / rows.row_length())[cell % rows.row_length()])});
}
Rational stored(const Risk& risk, std::size_t mode, std::size_t x) {
  return stored(risk.risks[mode], x);
}

/// "Never below, 0 exactly where that is, never above 1, and at most 0.1 % + 1e-30 above it."
void expect_bound(const Rational& own, const Rational& expected) {
  RC_ASSERT(own >= expected);
  RC_ASSERT((own == 0) == (expected == 0));
  RC_ASSERT(own <= 1);
  RC_ASSERT(own <= expected * Rational(1001, 1000) + exact(1e-30));
}

/// The rate is what one more step adds to what is stored, and no more than roundings of double above it.
void expect_rate(const PlainRisk& plainly, const Risk& risk, std::size_t cells, bool is_safest) {
  PlainRisks own(risk.risks.size());
  for (std::size_t mode = 0; mode < own.size(); ++mode) {
    for (std::size_t x = 0; x < cells; ++x) own[mode].push_back(stored(risk, mode, x));
  }
  const PlainRisks more = plainly.next(own, is_safest);
  Rational rate = 0;
  for (std::size_t mode = 0; mode < own.size(); ++mode) {
    for (std::size_t x = 0; x < cells; ++x) rate = std::max(rate, Rational(more[mode][x] - own[mode][x]));
  }
  RC_ASSERT(exact(risk.rate) >= rate);
  RC_ASSERT(exact(risk.rate) <= rate + exact(1e-14));
}

TEST(Risk, IsCloselyAboveTheExactOne) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("rows in floats against single pairs in fractions", [&] {
    const ProblemSpec spec = draw_risky(0, false);
    RC_LOG() << spec.text;
    const FastAnalysis fast(spec, team);
    const std::vector<bool> safe = members(fast.safe), beyond = members(fast.beyond.value_or(fast.safe));
    const PlainAnalysis plain = plainly(spec, fast);
    const PlainRisk risks(spec, fast.abstraction, safe, beyond, plain);
    PlainRisks expected = risks.first();
    for (std::int64_t n = 0; n < spec.risk->horizon; ++n)
      expected = risks.next(expected, spec.risk->is_safest);
    const Risk& risk = fast.answers->get<RiskAnswer>().risk;
    bool is_telling = false;
    for (std::size_t mode = 0; mode < expected.size(); ++mode) {
      for (std::size_t x = 0; x < expected[mode].size(); ++x) {
        expect_bound(stored(risk, mode, x), expected[mode][x]);
        is_telling = is_telling || (expected[mode][x] > 0 && expected[mode][x] < 1);
      }
    }
    RC_CLASSIFY(is_telling && !spec.risk->is_safest, "between 0 and 1, any");
    RC_CLASSIFY(is_telling && spec.risk->is_safest, "between 0 and 1, safest");
    expect_rate(risks, risk, safe.size(), spec.risk->is_safest);
    const RiskAnswer& answer = fast.answers->get<RiskAnswer>();
    RC_ASSERT(answer.drawn.has_value() == spec.risk->is_drawn);
    for (std::size_t x = 0; x < safe.size(); ++x) {
      const auto cell = static_cast<std::int64_t>(x);
      expect_bound(stored(answer.start(*spec.risk), x),
                   spec.risk->is_drawn ? risks.expected(expected, 0, cell) : expected[spec.risk->start][x]);
    }
  }));
}

/// The problem with rules for silent agents, by which they act in the network, too.
ProblemSpec by_rules(const ProblemSpec& problem) {
  Json spec = Json::parse(with_silence(problem.text));
  spec["network"]["actions"] = "silence";
  return read_spec(spec.dump(), "random");
}

TEST(Risk, IsZeroForEverWhereTheNetworkIsSafe) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("zero for every horizon exactly in W(q)", [&] {
    // Sets of zero risk shrink in every step until they shrink no more.
    ProblemSpec spec = draw_risky(3000, true);
    if (draw(0, 1) == 0) spec = by_rules(spec);
    const FastAnalysis fast(spec, team);
    const Risk& risk = fast.answers->get<RiskAnswer>().risk;
    const NetworkSafety& network = fast.answers->get<NetworkSafety>();
    bool some = false, not_all = false;
    for (std::size_t mode = 0; mode < risk.risks.size(); ++mode) {
      const std::vector<bool> safe = members(network.safe[mode]);
      for (std::size_t x = 0; x < safe.size(); ++x) {
        RC_ASSERT((stored(risk, mode, x) == 0) == safe[x]);
        some = some || safe[x];
        not_all = not_all || (!safe[x] && fast.invariance.invariant.test(static_cast<std::int64_t>(x)));
      }
    }
    RC_CLASSIFY(some && not_all && !spec.silence, "some cells of K");
    RC_CLASSIFY(some && not_all && spec.silence, "some cells of K, by rules");
  }));
}

TEST(Risk, GrowsWithTheHorizonByAtMostTheRate) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("V_N <= V_M <= V_N + (M - N) rate", [&] {
    ProblemSpec spec = draw_risky(0, false);
    const FastAnalysis few(spec, team);
    const std::int64_t more = draw(1, 4);
    spec.risk->horizon += more;
    const FastAnalysis many(spec, team);
    const Risk& early = few.answers->get<RiskAnswer>().risk;
    const Risk& late = many.answers->get<RiskAnswer>().risk;
    const Rational added = exact(early.rate) * static_cast<long>(more);
    for (std::size_t mode = 0; mode < early.risks.size(); ++mode) {
      for (std::size_t x = 0; x < static_cast<std::size_t>(few.safe.cells()); ++x) {
        const Rational before = stored(early, mode, x), after = stored(late, mode, x);
        RC_ASSERT(after >= before);
        // Both are rounded up a little.
        RC_ASSERT(after <= (before + added) * Rational(1001, 1000) + exact(1e-30));
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
