#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <random>

#include "answers/convention/convention.hpp"
#include "answers/convention/convention_freedom.hpp"
#include "base/index.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

using Sets = std::vector<std::vector<bool>>;

/// Whether every joint input of the product is admissible.
bool is_inside(const Sets& sets, const std::vector<bool>& admissible, const std::vector<InputClass>& agents) {
  for (std::size_t u = 0; u < admissible.size(); ++u) {
    bool chosen = true;
    for (std::size_t i = 0; i < agents.size(); ++i)
      chosen = chosen && sets[i][at(agents[i].action(static_cast<std::int64_t>(u)))];
    if (chosen && !admissible[u]) return false;
  }
  return true;
}

/// Word by word as the definition has it.
Sets by_definition(const std::vector<bool>& admissible, const std::vector<InputClass>& agents) {
  Sets sets;
  for (const InputClass& agent : agents) sets.emplace_back(at(agent.actions()), false);
  for (std::size_t u = 0; u < admissible.size(); ++u) {
    if (!admissible[u]) continue;
    for (std::size_t i = 0; i < agents.size(); ++i)
      sets[i][at(agents[i].action(static_cast<std::int64_t>(u)))] = true;
    break;
  }
  if (std::find(admissible.begin(), admissible.end(), true) == admissible.end()) return sets;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    for (std::size_t a = 0; a < sets[i].size(); ++a) {
      if (sets[i][a]) continue;
      sets[i][a] = true;
      if (!is_inside(sets, admissible, agents)) sets[i][a] = false;
    }
  }
  return sets;
}

/// No action can be added: the product is as large as can be.
bool is_maximal(Sets sets, const std::vector<bool>& admissible, const std::vector<InputClass>& agents) {
  for (std::vector<bool>& own : sets) {
    for (std::size_t a = 0; a < own.size(); ++a) {
      if (own[a]) continue;
      own[a] = true;
      if (is_inside(sets, admissible, agents)) return false;
      own[a] = false;
    }
  }
  return true;
}

/// Rows that are alike, found once. @returns whether there are any
bool expect_same_with_tiles(const FastAnalysis& fast, const ActionGrouping& agents,
                            const ConventionFreedom& plain, ThreadTeam& team) {
  bool are_any = false;
  for (const std::size_t leading : {fast.engine.outer(), fast.engine.across()}) {
    const std::optional<Tiles> tiles = Tiles::make(fast.engine, fast.hull, leading);
    if (!tiles) continue;
    const Tiles::Numbers classes = tiles->refined(tiles->tables(), number_rows(fast.invariance.invariant));
    are_any = are_any || *std::ranges::max_element(classes) + 1 < classes.size();
    const ConventionFreedom found = find_convention(fast.controller, agents, team, &*tiles);
    for (std::size_t i = 0; i < agents.size(); ++i) {
      const ConventionFreedom::Agent &own = found.agents[i], &other = plain.agents[i];
      RC_ASSERT(own.mean == other.mean);
      RC_ASSERT(own.full == other.full);
      RC_ASSERT(own.histogram == other.histogram);
      RC_ASSERT(std::memcmp(own.freedom.data(), other.freedom.data(), own.freedom.size() * sizeof(float)) ==
                0);
    }
  }
  return are_any;
}

/// The rows of the fast path against the definition, cell by cell.
void expect_convention(const ProblemSpec& spec, const FastAnalysis& fast, const PlainAnalysis& plain,
                       ThreadTeam& team) {
  const std::vector<InputClass> agents = agent_classes(spec, fast.abstraction.inputs);
  const ActionGrouping grouping(fast.engine, agents, team);
  const ConventionFreedom found = find_convention(fast.controller, grouping, team);
  const bool are_alike = expect_same_with_tiles(fast, grouping, found, team);
  RC_CLASSIFY(are_alike, "rows alike");
  std::vector<double> sums(agents.size(), 0);
  std::vector<std::int64_t> full(agents.size(), 0);
  std::int64_t cells = 0;
  std::vector<std::vector<std::uint8_t>> packed;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    packed.emplace_back(plain.controller.size() * at((agents[i].actions() + 7) / 8));
    fill_convention_bits(fast.controller, grouping, i, 0, packed[i].size(), packed[i].data());
  }
  for (std::size_t x = 0; x < plain.controller.size(); ++x) {
    const std::vector<bool>& admissible = plain.controller[x];
    const Sets sets = by_definition(admissible, agents);
    RC_ASSERT(convention_at(admissible, agents) == sets);
    if (plain.invariant[x]) {
      RC_ASSERT(is_inside(sets, admissible, agents));
      RC_ASSERT(is_maximal(sets, admissible, agents));
      ++cells;
    }
    for (std::size_t i = 0; i < agents.size(); ++i) {
      const std::size_t bytes = at((agents[i].actions() + 7) / 8);
      std::vector<bool> projection(at(agents[i].actions()), false);
      for (std::size_t u = 0; u < admissible.size(); ++u) {
        if (admissible[u]) projection[at(agents[i].action(static_cast<std::int64_t>(u)))] = true;
      }
      for (std::size_t a = 0; a < sets[i].size(); ++a)
        RC_ASSERT(((packed[i][x * bytes + a / 8] >> (a % 8) & 1U) != 0) == sets[i][a]);
      const float freedom = found.agents[i].freedom[x];
      if (!plain.invariant[x]) {
        RC_ASSERT(std::isnan(freedom));
        continue;
      }
      const auto kept = static_cast<double>(std::count(sets[i].begin(), sets[i].end(), true));
      const auto all = static_cast<double>(std::count(projection.begin(), projection.end(), true));
      RC_ASSERT(freedom == static_cast<float>(kept / all));
      sums[i] += kept / all;
      if (kept == all) ++full[i];
    }
  }
  for (std::size_t i = 0; i < agents.size(); ++i) {
    RC_ASSERT(std::fabs(found.agents[i].mean * static_cast<double>(cells) - sums[i]) <=
              1e-9 * static_cast<double>(cells));
    RC_ASSERT(found.agents[i].full == full[i]);
    std::int64_t in_histogram = 0;
    for (const std::int64_t count : found.agents[i].histogram) in_histogram += count;
    RC_ASSERT(in_histogram == cells);
  }
}

TEST(Convention, IsTheDefinitionOnRandomSystems) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("rows equal single cells", [&] {
    const ProblemSpec spec = read_spec(draw_problem(), "random");
    const FastAnalysis fast(spec, team);
    const PlainAnalysis plain = plainly(spec, fast);
    RC_CLASSIFY(spec.agents.size() >= 2 && fast.invariance.invariant.count() > 0, "K not empty, 2 agents");
    RC_CLASSIFY(spec.agents.size() >= 3 && fast.invariance.invariant.count() > 0, "K not empty, 3 agents");
    expect_convention(spec, fast, plain, team);
  }));
}

/// Every state stays, so that C is any relation: what is listed. Inputs of the agents are interleaved.
ProblemSpec standing(int agents) {
  std::string inputs;
  std::string owners;
  for (int i = 0; i < agents; ++i) {
    inputs +=
        (i > 0 ? "," : "") + std::string(R"({"name": "u)") + std::to_string(i) + R"(", "values": [0, 1, 2]})";
    owners += (i > 0 ? "," : "") + std::string(R"({"name": "a)") + std::to_string(i) + R"(", "inputs": ["u)" +
              std::to_string(i) + "\"" + (i == 0 ? ", \"v\"" : "") + "]}";
  }
  return read_spec(R"({"coordreq": 1, "name": "standing",
"states": [{"name": "x", "lower": 0, "upper": 1, "step": 1}, {"name": "y", "lower": 0, "upper": 69, "step": 1}],
"inputs": [)" + inputs +
                       R"(, {"name": "v", "values": [0, 1]}], "agents": [)" + owners + R"(],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}}, "safe": "true",
"abstraction": {"cells": "half_open"}})",
                   "standing");
}

TEST(Convention, IsTheDefinitionOfAnyRelationOfTwoToFourAgents) {
  ThreadTeam team(2);
  for (int agents = 2; agents <= 4; ++agents) {
    const ProblemSpec spec = standing(agents);
    EXPECT_TRUE(rc::check("rows equal single cells", [&] {
      std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
      PackedPairs listed{.inputs = make_input_space(spec).count(), .bytes = {}};
      const std::int64_t cells = make_grid(spec).cells();
      listed.bytes.resize(at(cells * listed.bytes_per_cell()));
      for (std::int64_t x = 0; x < cells; ++x) {
        const auto density = static_cast<std::uint32_t>(x % 9);  // of 8; some cells have none, some all
        for (std::int64_t u = 0; u < listed.inputs; ++u) {
          if (random() % 8 < density) listed.set(x, u);
        }
      }
      const FastAnalysis fast(spec, team, &listed);
      expect_convention(spec, fast, plainly(spec, fast, &listed), team);
    }));
  }
}

/// Whether every cell that can be next, if not all has left for good, is in the set.
bool leads_into(const Abstraction& system, std::int64_t x, std::int64_t u, const std::vector<bool>& set) {
  std::vector<std::int64_t> cells = {0};
  for (std::size_t i = 0; i < system.grid.size(); ++i) {
    const ResolvedRange range = system.resolved(i, x, u);
    if (range.blocked) return false;
    if (range.all_left()) cells.clear();
    std::vector<std::int64_t> longer;
    for (const std::int64_t cell : cells) {
      for (std::int64_t k = range.inside.first; k <= range.inside.last; ++k)
        longer.push_back(cell + k % system.grid[i].count * system.grid.stride(i));
    }
    cells = std::move(longer);
  }
  return std::all_of(cells.begin(), cells.end(), [&](std::int64_t cell) { return set[at(cell)]; });
}

/// Whoever keeps to it needs no communication: K is invariant under every choice from P.
TEST(Convention, KeepsTheSystemInTheInvarianceSet) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("no product leads out of K", [&] {
    const ProblemSpec spec = read_spec(draw_problem(), "random");
    const FastAnalysis fast(spec, team);
    const PlainAnalysis plain = plainly(spec, fast);
    const std::vector<InputClass> agents = agent_classes(spec, fast.abstraction.inputs);
    for (std::size_t x = 0; x < plain.controller.size(); ++x) {
      if (!plain.invariant[x]) continue;
      const Sets sets = convention_at(plain.controller[x], agents);
      for (const std::vector<bool>& own : sets)
        RC_ASSERT(std::find(own.begin(), own.end(), true) != own.end());
      for (std::size_t u = 0; u < plain.controller[x].size(); ++u) {
        bool chosen = true;
        for (std::size_t i = 0; i < agents.size(); ++i)
          chosen = chosen && sets[i][at(agents[i].action(static_cast<std::int64_t>(u)))];
        RC_ASSERT(!chosen || leads_into(fast.abstraction, static_cast<std::int64_t>(x),
                                        static_cast<std::int64_t>(u), plain.invariant));
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
