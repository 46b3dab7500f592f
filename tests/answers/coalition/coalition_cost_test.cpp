#include "answers/coalition/coalition_cost.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

#include "answers/agents.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/partition_names.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

PartitionSpec partition(const std::string& name) {
  const auto count = static_cast<std::size_t>(
      std::count_if(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; }));
  return parse_partition_name(agents(count), name).value();
}

TEST(NetworkCost, WithoutALinkCostIsAgentsMinusClasses) {
  for (const PartitionSpec& one : make_all_partitions(agents(5)))
    EXPECT_EQ(network_cost(one, {}), Rational(5 - static_cast<int>(one.classes.size())));
}

TEST(NetworkCost, TakesTheCheapestTreeOfEachClass) {
  const std::vector<LinkCostSpec> links{{0, 1, 10}, {0, 2, Rational(1, 3)}, {2, 3, 0}};
  EXPECT_EQ(network_cost(partition("a+b|c|d"), links), 10);
  // By way of c: b reaches c at the cost of 1.
  EXPECT_EQ(network_cost(partition("a+b+c|d"), links), Rational(4, 3));
  EXPECT_EQ(network_cost(partition("a+b|c+d"), links), 10);
  EXPECT_EQ(network_cost(partition("a+b+c+d"), links), Rational(4, 3));
  EXPECT_EQ(network_cost(partition("a|b|c|d"), links), 0);
}

/// The cheapest of all graphs on the agents that have the classes as their components.
Rational cost_by_trying_all_graphs(const PartitionSpec& one, const std::vector<LinkCostSpec>& links,
                                   std::size_t count) {
  const std::vector<AgentPair> pairs = agent_pairs(count);
  std::optional<Rational> least;
  for (std::uint32_t graph = 0; graph < (1U << pairs.size()); ++graph) {
    std::vector<std::int32_t> component(count);
    std::iota(component.begin(), component.end(), 0);
    Rational cost = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if ((graph >> i & 1U) == 0) continue;
      const auto [first, second] = pairs[i];
      const std::int32_t a = first, b = second;
      const auto link = std::find_if(links.begin(), links.end(),
                                     [&](const LinkCostSpec& l) { return l.first == a && l.second == b; });
      cost += link == links.end() ? Rational(1) : link->cost;
      std::replace(component.begin(), component.end(), std::int32_t{component[static_cast<std::size_t>(b)]},
                   std::int32_t{component[static_cast<std::size_t>(a)]});
    }
    const bool fits = std::all_of(pairs.begin(), pairs.end(), [&](const AgentPair& pair) {
      return (component[static_cast<std::size_t>(pair.first)] ==
              component[static_cast<std::size_t>(pair.second)]) == are_together(one, pair);
    });
    if (fits && (!least || cost < *least)) least = cost;
  }
  return least.value();
}

TEST(NetworkCost, IsThatOfTheCheapestGraphWithTheseComponents) {
  EXPECT_TRUE(rc::check("spanning forests", [] {
    const auto count = static_cast<std::size_t>(*rc::gen::inRange(1, 5));
    std::vector<LinkCostSpec> links;
    for (const AgentPair& pair : agent_pairs(count)) {
      if (*rc::gen::inRange(0, 3) == 0) continue;
      links.push_back({pair.first, pair.second, Rational(*rc::gen::inRange(0, 7), 3)});
      links.back().cost.canonicalize();
    }
    for (const PartitionSpec& one : make_all_partitions(agents(count)))
      RC_ASSERT(network_cost(one, links) == cost_by_trying_all_graphs(one, links, count));
  }));
}

std::vector<std::string> preferred(const CoordinationSpec& coordination) {
  std::vector<std::string> names;
  for (const CoalitionChoice& choice : order_of_preference(coordination))
    names.push_back(coordination.partitions[choice.partition].name);
  return names;
}

TEST(OrderOfPreference, IsByCostThenByTheLargestClassThenByName) {
  CoordinationSpec coordination{.partitions = make_all_partitions(agents(4))};
  EXPECT_EQ(preferred(coordination),
            (std::vector<std::string>{"a|b|c|d", "a+b|c|d", "a+c|b|d", "a+d|b|c", "a|b+c|d", "a|b+d|c",
                                      "a|b|c+d", "a+b|c+d", "a+c|b+d", "a+d|b+c", "a+b+c|d", "a+b+d|c",
                                      "a+c+d|b", "a|b+c+d", "a+b+c+d"}));
  coordination.partitions = {partition("a+b|c"), partition("a|b+c"), partition("a+b+c")};
  coordination.partitions[0].name = "z";
  coordination.partitions[1].name = "Z";
  EXPECT_EQ(preferred(coordination), (std::vector<std::string>{"Z", "z", "a+b+c"}));
  coordination.link_cost = {{1, 2, 3}};
  EXPECT_EQ(preferred(coordination), (std::vector<std::string>{"z", "a+b+c", "Z"}));
}

}  // namespace
}  // namespace coordreq
