#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "choices/independent_actions.hpp"
#include "choices/independent_posts.hpp"
#include "engine/join_rows.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/draw.hpp"

// Rows along several dimensions give the levels that rows along one give (engines_agree_test.cpp holds these
// against single pairs).
namespace coordreq {
namespace {

std::string draw_state(std::size_t i) {
  const int count = draw(2, 6);
  if (draw(0, 4) == 0) {
    return fmt::format(R"({{"name": "s{}", "lower": 0, "upper": {}, "count": {}, "outside": "periodic"}})", i,
                       count, count);
  }
  const auto side = [] { return *rc::gen::element("unsafe", "unsafe", "saturate", "safe"); };
  return fmt::format(
      R"({{"name": "s{}", "lower": 0, "upper": {}, "step": 1, "outside": {{"below": "{}", "above": "{}"}}}})",
      i, count - 1, side(), side());
}

/// Two or three agents with one or two inputs each. What moves a state is drawn later.
ProblemSpec draw_rows_spec() {
  const auto states = static_cast<std::size_t>(draw(3, 4));
  const auto agents = static_cast<std::size_t>(draw(2, 3));
  std::string state_list;
  std::string equations;
  for (std::size_t i = 0; i < states; ++i) {
    state_list += (i == 0 ? "" : ", ") + draw_state(i);
    equations += fmt::format(R"({}"s{}": "s{}")", i == 0 ? "" : ", ", i, i);
  }
  std::string input_list;
  std::string agent_list;
  std::size_t inputs = 0;
  for (std::size_t a = 0; a < agents; ++a) {
    std::string own;
    for (int k = draw(1, 2); k > 0; --k, ++inputs) {
      input_list += fmt::format(R"({}{{"name": "u{}", "lower": 0, "upper": {}, "step": 1}})",
                                inputs == 0 ? "" : ", ", inputs, draw(1, 2));
      own += fmt::format(R"({}"u{}")", own.empty() ? "" : ", ", inputs);
    }
    agent_list += fmt::format(R"({}{{"name": "a{}", "inputs": [{}]}})", a == 0 ? "" : ", ", a, own);
  }
  const std::string safe =
      fmt::format("max(abs(s0 - s{}), abs(s1 - {})) >= {}", states - 1, draw(0, 3), draw(1, 2));
  const std::string text = fmt::format(
      R"({{"coordreq": 1, "name": "joined", "states": [{}], "inputs": [{}], "agents": [{}], "safe": "{}",
           "dynamics": {{"time": "discrete", "period": 1, "equations": {{{}}}}}, "abstraction": {{"safe": "center"}},
           "coordination": {{"partitions": "all"}}}})",
      state_list, input_list, agent_list, safe, equations);
  return read_spec(text, "random");
}

std::vector<std::int32_t> some(std::size_t below) {
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < below; ++i) {
    if (draw(0, 1) == 0) result.push_back(static_cast<std::int32_t>(i));
  }
  return result;
}

/// State t moves by offsets that depend on some of the first `across` states and some inputs.
TransitionTable draw_shift(const Abstraction& abstraction, std::size_t t, std::size_t across) {
  TransitionTable table{.states = some(across), .inputs = some(abstraction.inputs.size())};
  table.states.push_back(static_cast<std::int32_t>(t));
  table.shift = true;
  table.entries.resize(static_cast<std::size_t>(lay_out(table, t, abstraction.grid, abstraction.inputs)));
  for (IndexRange& entry : table.entries) {
    entry.first = draw(-2, 1);
    entry.last = entry.first + draw(0, draw(0, 3) == 0 ? 2 : 1);
  }
  return table;
}

/// State t goes anywhere, as some of the first `across` states and some inputs say.
TransitionTable draw_leader(const Abstraction& abstraction, std::size_t t, std::size_t across) {
  TransitionTable table{.states = some(across), .inputs = some(abstraction.inputs.size())};
  table.entries.resize(static_cast<std::size_t>(lay_out(table, t, abstraction.grid, abstraction.inputs)));
  for (IndexRange& entry : table.entries) {
    entry.first = draw(-1, static_cast<int>(abstraction.grid[t].count));
    entry.last = entry.first + draw(0, 2);
  }
  return table;
}

std::int64_t cell_of(const UniformGrid& from, std::int64_t cell, const UniformGrid& to) {
  std::int64_t result = 0;
  for (std::size_t i = 0; i < from.size(); ++i) result += from.index(cell, i) * to.stride(i);
  return result;
}

/// The layers again with levels of another width.
template <class Level>
void expect_same_layers(const FastAnalysis& joined, std::size_t p, ThreadTeam& team) {
  LevelRows<Level> levels = joined.engine.make_levels<Level>(joined.invariance.invariant, team);
  IndependentActions<Level> op(joined.actions[p].projections, joined.invariance.invariant, team.size());
  run_wave(levels, joined.engine, joined.hull, static_cast<Level>(LevelRows<Level>::kTop - 1), op, {}, team);
  const LevelMap map(std::move(levels));
  for (std::int64_t x = 0; x < joined.abstraction.grid.cells(); ++x) {
    if (joined.safe.test(x)) RC_ASSERT(map.at(x) == joined.layers[p].layers_of.at(x));
  }
}

TEST(JoinedRows, GiveTheSameLevels) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("rows along several dimensions equal rows along one", [&] {
    const ProblemSpec spec = draw_rows_spec();
    Abstraction abstraction = build_abstraction(spec, team);
    const std::size_t across = static_cast<std::size_t>(draw(1, static_cast<int>(spec.states.size()) - 2));
    for (std::size_t t = 0; t < spec.states.size(); ++t) {
      abstraction.tables[t] =
          t < across ? draw_leader(abstraction, t, across) : draw_shift(abstraction, t, across);
    }
    Abstraction long_rows = abstraction;
    long_rows.grid = join_rows(abstraction);
    RC_PRE(long_rows.grid.across() != abstraction.grid.across());
    const FastAnalysis one(spec, std::move(abstraction), team);
    const FastAnalysis joined(spec, std::move(long_rows), team);
    RC_CLASSIFY(joined.engine.along() == 3, "along three");
    RC_CLASSIFY(one.invariance.invariant.count() > 0, "K not empty");
    RC_CLASSIFY(std::any_of(one.layers.begin(), one.layers.end(),
                            [](const DelayLayers& layers) { return layers.sizes.size() > 2; }),
                "several layers");
    RC_ASSERT(joined.safe.count() == one.safe.count());
    RC_ASSERT(joined.invariance.iterations == one.invariance.iterations);
    RC_ASSERT(joined.invariance.invariant.count() == one.invariance.invariant.count());
    for (std::int64_t x = 0; x < one.abstraction.grid.cells(); ++x) {
      const std::int64_t y = cell_of(one.abstraction.grid, x, joined.abstraction.grid);
      RC_ASSERT(joined.invariance.collision_time.at(y) == one.invariance.collision_time.at(x));
      for (std::size_t p = 0; p < one.layers.size(); ++p)
        RC_ASSERT(joined.layers[p].layers_of.at(y) == one.layers[p].layers_of.at(x));
    }
    for (std::size_t p = 0; p < one.layers.size(); ++p) {
      RC_ASSERT(joined.layers[p].sizes == one.layers[p].sizes);
      if (joined.actions[p].grouping.size() < 2) continue;
      expect_same_layers<std::uint16_t>(joined, p, team);
      expect_same_layers<std::uint32_t>(joined, p, team);
    }
  }));
}

TEST(IndependentPosts, LabelsOfAllPagesAreThoseThatWerePacked) {
  EXPECT_TRUE(rc::check("labels", [] {
    constexpr std::size_t kPages = 3, kLanes = 900;
    std::vector<std::int32_t> labels;
    while (labels.size() < kLanes) {
      const auto most = *rc::gen::element<std::size_t>(1, 3, 600);
      const auto length = std::min(*rc::gen::inRange<std::size_t>(1, most + 1), kLanes - labels.size());
      labels.insert(labels.end(), length, *rc::gen::element(0, 1, 7, 255, 256, 510, 511, 700));
    }
    std::vector<Word> packed(2, 0);
    for (std::size_t page = 0; page < kPages; ++page) IndependentPosts::pack_labels(labels, page, packed);
    std::vector<std::uint16_t> found(kLanes + 5, 9);
    std::vector<int> all(found.size(), 0);
    std::size_t at = 2;
    for (int page = 0; page < static_cast<int>(kPages); ++page) {
      IndependentPosts::put_labels(IndependentPosts::page_at(packed, at), found);
      for (std::size_t lane = 0; lane < found.size(); ++lane) {
        if (found[lane] == 0) continue;
        RC_ASSERT(all[lane] == 0);
        all[lane] = found[lane] + page * static_cast<int>(IndependentPosts::kLabelsOfPage);
      }
    }
    RC_ASSERT(at == packed.size());
    RC_ASSERT(std::equal(labels.begin(), labels.end(), all.begin()));
    RC_ASSERT(std::all_of(all.begin() + kLanes, all.end(), [](int label) { return label == 0; }));
  }));
}

}  // namespace
}  // namespace coordreq
