// Two agents are alike if all of their tables are; a single difference of any kind is enough that they are
// not.

#include "engine/like_agents.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace coordreq {
namespace {

struct Parts {
  std::vector<GridDimension> dimensions;      ///< those of the two agents, then one of nobody
  std::vector<InputSpace::Dimension> inputs;  ///< one an agent
};

/// The ranges of a small spread that differ for all cells and inputs, in full over the state and the input.
TransitionTable table_of(std::size_t state, const std::vector<std::int32_t>& inputs,
                         const Abstraction& abstraction) {
  TransitionTable table{.states = {static_cast<std::int32_t>(state)}, .inputs = inputs};
  table.entries.resize(static_cast<std::size_t>(lay_out(table, state, abstraction.grid, abstraction.inputs)));
  std::int32_t number = 0;
  for (IndexRange& entry : table.entries) {
    entry = {number % 5, number % 5 + number % 2};
    ++number;
  }
  return table;
}

/// Two agents with a state and an input each, alike unless `change` makes a difference.
Abstraction two_agents(
    const std::function<void(Parts&)>& change = [](Parts&) {}, bool has_tubes = false) {
  Parts agents;
  for (const char* name : {"p", "q", "z"})
    agents.dimensions.push_back({.name = name, .first = 0, .step = 1, .count = name[0] == 'z' ? 7 : 5});
  for (const char* name : {"u", "v"})
    agents.inputs.push_back({name, {Rational(-1), Rational(0), Rational(1)}});
  change(agents);
  Abstraction abstraction{.grid = UniformGrid(agents.dimensions), .inputs = InputSpace(agents.inputs)};
  for (std::size_t i = 0; i < 2; ++i)
    abstraction.tables.push_back(table_of(i, {static_cast<std::int32_t>(i)}, abstraction));
  abstraction.tables.push_back(table_of(2, {}, abstraction));
  if (has_tubes) abstraction.tubes = abstraction.tables;
  return abstraction;
}

bool are_alike(const Abstraction& abstraction) {
  const std::vector<AbstractAgent> agents = abstract_agents(abstraction, {{0}, {1}});
  EXPECT_EQ(agents[0].dimensions, std::vector<std::size_t>{0});
  EXPECT_EQ(agents[1].dimensions, std::vector<std::size_t>{1});
  return agent_like(abstraction, agents[0], agents[1]).has_value();
}

TEST(LikeAgents, DoTheSameInStatesOfTheirOwn) {
  EXPECT_TRUE(are_alike(two_agents()));
  EXPECT_TRUE(are_alike(two_agents([](Parts&) {}, true)));
  // All edges alike, for every rule.
  for (const Outside side : {Outside::unsafe, Outside::safe, Outside::saturate, Outside::stop}) {
    EXPECT_TRUE(are_alike(two_agents(
        [side](Parts& agents) { agents.dimensions[0].below = agents.dimensions[1].below = side; })));
  }
}

TEST(LikeAgents, HaveTheSameEdges) {
  for (const std::size_t agent : {0U, 1U}) {
    for (const Outside side : {Outside::safe, Outside::saturate, Outside::stop}) {
      EXPECT_FALSE(are_alike(two_agents([&](Parts& agents) { agents.dimensions[agent].below = side; })));
      EXPECT_FALSE(are_alike(two_agents([&](Parts& agents) { agents.dimensions[agent].above = side; })));
    }
    EXPECT_FALSE(are_alike(two_agents([&](Parts& agents) { agents.dimensions[agent].count = 4; })));
  }
}

TEST(LikeAgents, HaveAsManyActions) {
  for (const std::size_t agent : {0U, 1U})
    EXPECT_FALSE(are_alike(two_agents([&](Parts& agents) { agents.inputs[agent].values.pop_back(); })));
}

TEST(LikeAgents, HaveTheSameRangesEverywhere) {
  for (const bool of_tubes : {false, true}) {
    Abstraction abstraction = two_agents([](Parts&) {}, true);
    TransitionTable& table = (of_tubes ? abstraction.tubes : abstraction.tables)[1];
    for (IndexRange& entry : table.entries) {
      const IndexRange old = entry;
      entry.first -= 1;
      EXPECT_FALSE(are_alike(abstraction));
      entry = {old.first, old.last + 1};
      EXPECT_FALSE(are_alike(abstraction));
      entry = old;
    }
    EXPECT_TRUE(are_alike(abstraction));
    table.shift = true;
    EXPECT_FALSE(are_alike(abstraction));
  }
}

/// An agent whose tables read the input of another, or whose state moves another's, has no dimensions of its
/// own.
TEST(LikeAgents, MoveNobodyElse) {
  Abstraction driven = two_agents();
  driven.tables[0] = table_of(0, {0, 1}, driven);
  const std::vector<AbstractAgent> agents = abstract_agents(driven, {{0}, {1}});
  EXPECT_TRUE(agents[0].dimensions.empty());
  EXPECT_TRUE(agents[1].dimensions.empty());
  Abstraction coupled = two_agents();
  coupled.tables[2].states = {0, 2};
  lay_out(coupled.tables[2], 2, coupled.grid, coupled.inputs);
  EXPECT_EQ(abstract_agents(coupled, {{0}, {1}})[0].dimensions, (std::vector<std::size_t>{0, 2}));
}

TEST(LikeAgents, CanChangePlacesInEachSet) {
  const Abstraction abstraction = two_agents();
  const std::vector<AbstractAgent> agents = abstract_agents(abstraction, {{0}, {1}});
  CellSet set(abstraction.grid.rows(), abstraction.grid.row_length());
  const auto cell = [&](std::int64_t p, std::int64_t q, std::int64_t z) {
    return p * abstraction.grid.stride(0) + q * abstraction.grid.stride(1) + z;
  };
  const auto found = [&] {
    const std::vector<const CellSet*> sets{&set};
    return find_like_agents(abstraction, agents, sets).size();
  };
  EXPECT_EQ(found(), 2U);
  set.set(cell(1, 3, 2));
  EXPECT_EQ(found(), 0U);
  set.set(cell(3, 1, 2));
  EXPECT_EQ(found(), 2U);
  set.set(cell(4, 4, 6));
  EXPECT_EQ(found(), 2U);
}

}  // namespace
}  // namespace coordreq
