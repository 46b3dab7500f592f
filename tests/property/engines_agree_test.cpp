#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>
#include <random>
#include <utility>

#include "answers/invariance/safe_set.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/random_problem.hpp"
#include "support/random_sums.hpp"

namespace coordreq {
namespace {

/// In which forms the projections of K come, and of what partitions.
void classify_projections(const FastAnalysis& fast) {
  bool forms[3] = {};
  bool layered_forms[3] = {};
  bool three_classes = false;
  bool two_inputs = false;
  for (std::size_t p = 0; p < fast.actions.size(); ++p) {
    const ActionGrouping& grouping = fast.actions[p].grouping;
    if (grouping.size() < 2) continue;
    three_classes = three_classes || grouping.size() >= 3;
    for (std::size_t c = 0; c < grouping.size(); ++c)
      two_inputs = two_inputs || grouping[c].inputs().size() >= 2;
    for (std::int64_t r = 0; r < fast.engine.rows(); ++r) {
      if (!any_set(fast.invariance.invariant.row(r))) continue;
      const auto form = static_cast<std::size_t>(fast.actions[p].projections.form(r));
      forms[form] = true;
      layered_forms[form] = layered_forms[form] || fast.layers[p].sizes.size() > 1;
    }
  }
  using Form = Projections::Form;
  const auto has = [](const bool(&found)[3], Form form) { return found[static_cast<std::size_t>(form)]; };
  RC_CLASSIFY(has(forms, Form::full), "full");
  RC_CLASSIFY(has(forms, Form::masks), "masks");
  RC_CLASSIFY(has(forms, Form::product), "product");
  RC_CLASSIFY(has(layered_forms, Form::full), "full, with layers");
  RC_CLASSIFY(has(layered_forms, Form::masks), "masks, with layers");
  RC_CLASSIFY(has(layered_forms, Form::product), "product, with layers");
  RC_CLASSIFY(three_classes, "three classes");
  RC_CLASSIFY(two_inputs, "a class with several inputs");
}

void classify(const ProblemSpec& spec, const FastAnalysis& fast, const PlainAnalysis& plain) {
  classify_projections(fast);
  RC_CLASSIFY(spec.abstraction.between_samples && plain.partitions[0].sizes.size() > 1,
              "between samples, more than one layer");
  RC_CLASSIFY(std::count(plain.invariant.begin(), plain.invariant.end(), true) > 0, "K not empty");
  RC_CLASSIFY(!plain.partitions.empty() && plain.partitions[0].sizes.size() > 1, "more than one layer");
  RC_CLASSIFY(plain.iterations > 2, "more than two sweeps for K");
}

/// A quarter of the problems has tubes.
RandomTime any_time() {
  return *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
}

/// Few, half or most of all pairs.
PackedPairs draw_pairs(std::int64_t cells, std::int64_t inputs) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const std::uint32_t density = *rc::gen::element(1U, 4U, 7U);
  PackedPairs pairs{.inputs = inputs, .bytes = {}};
  pairs.bytes.resize(static_cast<std::size_t>(cells * pairs.bytes_per_cell()));
  for (std::int64_t x = 0; x < cells; ++x) {
    for (std::int64_t u = 0; u < inputs; ++u) {
      if (random() % 8 < density) pairs.set(x, u);
    }
  }
  return pairs;
}

TEST(Engines, RowsAndSinglePairsGiveTheSameBits) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("row engine equals plain engine", [&] {
    const ProblemSpec spec = read_spec(draw_problem(any_time()), "random");
    const FastAnalysis fast(spec, team);
    const PlainAnalysis plain = plainly(spec, fast);
    classify(spec, fast, plain);
    expect_agreement(fast, plain, team);
  }));
}

TEST(Engines, AgreeOnListedPairs) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("row engine equals plain engine with a controller from a file", [&] {
    const ProblemSpec spec = read_spec(draw_problem(any_time()), "random");
    const PackedPairs listed = draw_pairs(make_grid(spec).cells(), make_input_space(spec).count());
    const FastAnalysis fast(spec, team, &listed);
    const PlainAnalysis plain = plainly(spec, fast, &listed);
    classify(spec, fast, plain);
    expect_agreement(fast, plain, team);
  }));
}

/// A raw range for a state of a hand-made abstraction: near the old one mostly, at times far out.
IndexRange disturbed(IndexRange old, std::int64_t count) {
  const auto draw = [](int low, int high) {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high));
  };
  constexpr IndexRange kLost{INT32_MAX, INT32_MAX};
  const int around = static_cast<int>(count);
  switch (draw(0, 12)) {
    case 0:
      return {old.first - draw(0, 2), old.last + draw(0, 3)};
    case 1:
      return {old.first + around, old.last + around};
    case 2: {
      const int first = draw(-2 * around, 2 * around);
      return {first, first + draw(0, around + 1)};
    }
    case 3:
      return draw(0, 20) == 0 ? kLost : old;
    default:
      return old;
  }
}

TEST(Engines, AgreeOnAnyTablesOfRanges) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("row engine equals plain engine on hand-made tables", [&] {
    const ProblemSpec spec = read_spec(draw_problem(any_time()), "random");
    Abstraction abstraction = build_abstraction(spec, team);
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      // Half of the time shifts are disturbed as such, else cell by cell.
      // A sum is disturbed cell by cell in any case.
      const bool by_cells = abstraction.tables[i].is_sum() || *rc::gen::arbitrary<bool>();
      if (by_cells) abstraction.tables[i] = written_out(abstraction, i);
      const auto disturb = [&](TransitionTable& table) {
        for (IndexRange& entry : table.entries) entry = disturbed(entry, abstraction.grid[i].count);
      };
      disturb(abstraction.tables[i]);
      if (!abstraction.tubes.empty()) disturb(abstraction.tubes[i]);
    }
    const FastAnalysis fast(spec, std::move(abstraction), team);
    const PlainAnalysis plain = plainly(spec, fast);
    classify(spec, fast, plain);
    expect_agreement(fast, plain, team);
  }));
}

TEST(Engines, AgreeOnAnySums) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("row engine equals plain engine on hand-made sums", [&] {
    const RandomEdges edges = *rc::gen::inRange(0, 3) == 0 ? RandomEdges::any : RandomEdges::plain;
    const ProblemSpec spec = read_spec(draw_problem(any_time(), edges), "random");
    RC_PRE(spec.states.size() > 1);
    Abstraction abstraction = build_abstraction(spec, team);
    draw_sums(abstraction);
    const FastAnalysis fast(spec, std::move(abstraction), team);
    const PlainAnalysis plain = plainly(spec, fast);
    RC_CLASSIFY(!fast.engine.posts().is_cut(), "summed");
    RC_CLASSIFY(!fast.engine.posts().is_cut() && fast.engine.outer() > 1, "two states lead");
    RC_CLASSIFY(!fast.engine.posts().is_cut() && fast.engine.outer() + 1 < spec.states.size(),
                "two states are sums");
    classify(spec, fast, plain);
    expect_agreement(fast, plain, team);
  }));
}

TEST(Engines, SafeSetsLieBetweenNaturalEvaluationAndSamples) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("natural <= S <= sampled", [&] {
    const ProblemSpec spec = read_spec(draw_problem(), "random");
    const Abstraction abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec)};
    const std::vector<bool> safe = members(safe_set(spec, abstraction, team));
    const SafeBounds bounds = bound_safe_plainly(spec, abstraction.grid);
    RC_CLASSIFY(safe != bounds.natural, "more than natural evaluation");
    RC_CLASSIFY(safe == bounds.sampled, "exact");
    for (std::size_t x = 0; x < safe.size(); ++x) {
      RC_ASSERT(!bounds.natural[x] || safe[x]);
      RC_ASSERT(!safe[x] || bounds.sampled[x]);
    }
  }));
}

TEST(Engines, SumsDoNotHideWhatAStateDependsOn) {
  // y and x turn together, so that only h moves by itself; so fine that sharing more would seem to pay.
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "turn",
"states": [{"name": "h", "lower": 0, "upper": "2*pi", "count": 36, "outside": "periodic"},
           {"name": "y", "lower": -10, "upper": 10, "step": 0.5, "outside": "safe"},
           {"name": "x", "lower": -10, "upper": 10, "step": 0.5, "outside": "safe"}],
"inputs": [{"name": "u", "lower": -1, "upper": 1, "step": 0.5}, {"name": "v", "lower": -1, "upper": 1, "step": 0.5}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "continuous", "period": 0.2,
  "equations": {"x": "-5 + 5*cos(h) + u*y", "y": "5*sin(h) - u*x", "h": "v - u"}},
"safe": "x^2 + y^2 >= 4"})json",
                                     "turn");
  ThreadTeam team(2);
  const Abstraction abstraction = build_abstraction(spec, team);
  EXPECT_TRUE(abstraction.tables[1].is_sum());
  EXPECT_LE(RowEngine(abstraction, nullptr, {}).outer(), 1U);
}

TEST(Engines, AgreeOnTablesThatAreSums) {
  const std::string text = R"json({"coordreq": 1, "name": "sums",
"states": [{"name": "h", "lower": 0, "upper": "2*pi", "count": 7, "outside": "periodic"},
           {"name": "y", "lower": -4, "upper": 4, "step": 1, "outside": {"below": "safe", "above": "saturate"}},
           {"name": "x", "lower": -4, "upper": 4, "step": 0.5, "outside": "EDGE"}],
"inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 1]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "continuous", "period": 0.5,
  "equations": {"x": "-1 + cos(h) + u*y", "y": "sin(h) - u*x", "h": "v - u"}},
"safe": "x^2 + y^2 >= 1", "abstraction": {"cells": "CELLS"}})json";
  ThreadTeam team(2);
  for (const std::string edge : {"unsafe", "safe", "saturate"}) {
    for (const std::string cells : {"closed", "half_open"}) {
      std::string one = text;
      one.replace(one.find("EDGE"), 4, edge);
      one.replace(one.find("CELLS"), 5, cells);
      const ProblemSpec spec = read_spec(one, "sums");
      const FastAnalysis fast(spec, team);
      EXPECT_TRUE(fast.abstraction.tables[1].is_sum());
      EXPECT_TRUE(fast.abstraction.tables[2].is_sum());
      expect_agreement(fast, plainly(spec, fast), team);
    }
  }
}

/// Rows of 150 cells, shifts beyond a word.
std::string long_rows(const std::string& cells, const std::string& edges_of_x) {
  std::string text = R"json({"coordreq": 1, "name": "long",
"states": [{"name": "y", "lower": 0, "upper": 2, "step": 1, "outside": "saturate"},
           {"name": "x", "lower": 0, EDGES}],
"inputs": [{"name": "u", "values": [-70.5, -3, 0, 64, 200]}, {"name": "v", "values": [-1, 0.5]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "if(v > 0, x + u, 149 - x)", "y": "y + v"}},
"safe": "x <= 40 or x >= 100 or y >= 1", "abstraction": {"cells": "CELLS"}})json";
  text.replace(text.find("EDGES"), 5, edges_of_x);
  text.replace(text.find("CELLS"), 5, cells);
  return text;
}

TEST(Engines, LongRowsOverSeveralWordsAgree) {
  std::vector<std::string> edges = {R"("upper": 150, "count": 150, "outside": "periodic")"};
  for (const std::string below : {"unsafe", "safe", "saturate"}) {
    for (const std::string above : {"unsafe", "safe", "saturate"}) {
      edges.push_back(R"("upper": 149, "step": 1, "outside": {"below": ")" + below + R"(", "above": ")" +
                      above + "\"}");
    }
  }
  ThreadTeam team(2);
  for (const std::string& one : edges) {
    for (const std::string cells : {"closed", "half_open"}) {
      const ProblemSpec spec = read_spec(long_rows(cells, one), "long");
      const FastAnalysis fast(spec, team);
      expect_agreement(fast, plainly(spec, fast), team);
    }
  }
}

/// Moves that differ by a whole round are the same on a ring, and only there.
TEST(Engines, OffTheRingMovesOfAWholeRoundAreNotTheSame) {
  const auto line = [](const std::string& equation, const std::string& above, const std::string& safe) {
    return read_spec(
        R"({"coordreq": 1, "name": "line", "states": [{"name": "x", "lower": 0, "upper": 9, "step": 1,
"outside": {"below": "saturate", "above": ")" +
            above +
            R"("}}], "inputs": [{"name": "u", "values": [-8, 2]}],
"disturbances": [{"name": "w", "lower": -4.5, "upper": 4}],
"agents": [{"name": "a", "inputs": ["u"]}], "dynamics": {"time": "discrete", "period": 1, "equations": {"x": ")" +
            equation + R"("}}, "safe": ")" + safe + R"(", "abstraction": {"cells": "half_open"}})",
        "line");
  };
  ThreadTeam team(1);
  // Eight back, and two on: ten cells apart. Only two on is safe.
  const ProblemSpec round = line("x + u", "saturate", "x >= 1.5");
  const FastAnalysis fast(round, team);
  EXPECT_EQ(fast.invariance.invariant.count(), 8);
  expect_agreement(fast, plainly(round, fast), team);
  // To any of ten cells, or nine on: that is as long as the line, but no whole ring.
  const ProblemSpec wide = line("if(u > 0, x + 9, x + w)", "unsafe", "true");
  const FastAnalysis other(wide, team);
  EXPECT_EQ(other.collision_times()[0], 3);
  expect_agreement(other, plainly(wide, other), team);
}

}  // namespace
}  // namespace coordreq
