#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "example_spec.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Classes = std::vector<std::vector<std::int32_t>>;

/// Three agents a, b, c with an input each.
nlohmann::json three_agents() {
  nlohmann::json spec = test::example();
  spec["inputs"].push_back({{"name", "u3"}, {"values", {0}}});
  spec["agents"].push_back({{"name", "c"}, {"inputs", {"u3"}}});
  return spec;
}

nlohmann::json with_partitions(const std::string& partitions) {
  nlohmann::json spec = three_agents();
  spec["coordination"]["partitions"] = nlohmann::json::parse(partitions);
  return spec;
}

TEST(Partition, DefaultIsEveryAgentAlone) {
  const CoordinationSpec coordination = test::read(three_agents()).coordination;
  ASSERT_EQ(coordination.partitions.size(), 1U);
  EXPECT_EQ(coordination.partitions[0].name, "a|b|c");
  EXPECT_EQ(coordination.partitions[0].canonical, "a|b|c");
  EXPECT_EQ(coordination.partitions[0].classes, (Classes{{0}, {1}, {2}}));
}

TEST(Partition, IsCanonicalWhateverTheOrder) {
  const auto partitions =
      test::read(
          with_partitions(R"([{"classes": [["c", "a"]]}, {"name": "right", "classes": [["c", "b"], ["a"]]},
                                     {"name": "none", "classes": []}])"))
          .coordination.partitions;
  ASSERT_EQ(partitions.size(), 3U);
  EXPECT_EQ(partitions[0].name, "a+c|b");
  EXPECT_EQ(partitions[0].classes, (Classes{{0, 2}, {1}}));
  EXPECT_EQ(partitions[1].name, "right");
  EXPECT_EQ(partitions[1].canonical, "a|b+c");
  EXPECT_EQ(partitions[1].classes, (Classes{{0}, {1, 2}}));
  EXPECT_EQ(partitions[2].canonical, "a|b|c");
}

TEST(Partition, ErrorsNameThePlace) {
  EXPECT_EQ(test::error_of(with_partitions(R"([{"classes": [["a", "d"]]}])")),
            "'d' is not an agent (/coordination/partitions/0/classes/0/1)");
  EXPECT_EQ(test::error_of(with_partitions(R"([{"classes": [["a"], ["b", "a"]]}])")),
            "the agent 'a' is listed twice (/coordination/partitions/0/classes/1/1)");
  EXPECT_EQ(test::error_of(
                with_partitions(R"([{"classes": [["a", "b"]]}, {"name": "p", "classes": [["b", "a"]]}])")),
            "the partition 'a+b|c' is listed twice, it stands at /coordination/partitions/0 too "
            "(/coordination/partitions/1)");
  EXPECT_EQ(test::error_of(
                with_partitions(R"([{"name": "p", "classes": []}, {"name": "p", "classes": [["b", "a"]]}])")),
            "the partition name 'p' is taken by /coordination/partitions/0 (/coordination/partitions/1)");
  EXPECT_EQ(test::error_of(with_partitions(R"([{"classes": [[]]}])")),
            "expected a list of at least one agent name, found an empty list "
            "(/coordination/partitions/0/classes/0)");
}

TEST(Partition, RequirementNamesItInAnyOrder) {
  nlohmann::json spec = with_partitions(R"([{"classes": []}, {"name": "pair", "classes": [["a", "c"]]}])");
  spec["requirements"] = nlohmann::json::parse(
      R"([{"name": "1", "where": "true", "min_delay": 1, "partition": "pair"},
          {"name": "2", "where": "true", "min_delay": 1, "partition": "b|c+a"},
          {"name": "3", "where": "true", "min_delay": 1, "partition": "c|b|a"}])");
  const std::vector<RequirementSpec> requirements = test::read(spec).requirements;
  EXPECT_EQ(requirements[0].partition, 1);
  EXPECT_EQ(requirements[1].partition, 1);
  EXPECT_EQ(requirements[2].partition, 0);
  spec["requirements"][0].erase("partition");
  EXPECT_EQ(test::error_of(spec), "missing key 'partition', there is more than one (/requirements/0)");
}

std::vector<std::string> names_of(const std::vector<PartitionSpec>& partitions) {
  std::vector<std::string> names;
  for (const PartitionSpec& partition : partitions) {
    EXPECT_EQ(partition.name, partition.canonical);
    names.push_back(partition.name);
  }
  return names;
}

TEST(Partition, AllOfThreeAgentsAreFiveCoarserOnesFirst) {
  const CoordinationSpec coordination = test::read(with_partitions("\"all\"")).coordination;
  EXPECT_TRUE(coordination.all_partitions);
  EXPECT_EQ(names_of(coordination.partitions),
            (std::vector<std::string>{"a+b+c", "a+b|c", "a+c|b", "a|b+c", "a|b|c"}));
  EXPECT_EQ(coordination.partitions[2].classes, (Classes{{0, 2}, {1}}));
}

TEST(Partition, AllAreAsManyAsTheBellNumbers) {
  std::vector<AgentSpec> agents;
  for (const int bell : {1, 2, 5, 15, 52, 203, 877}) {
    agents.push_back({.name = std::string(1, static_cast<char>('a' + agents.size())), .inputs = {0}});
    std::vector<std::string> names = names_of(make_all_partitions(agents));
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::unique(names.begin(), names.end()) - names.begin(), bell);
    EXPECT_EQ(static_cast<int>(names.size()), bell);
  }
}

nlohmann::json with_agents(int count) {
  nlohmann::json spec = with_partitions("\"all\"");
  for (int i = 4; i <= count; ++i) {
    spec["inputs"].push_back({{"name", "u" + std::to_string(i)}, {"values", {0}}});
    spec["agents"].push_back({{"name", "a" + std::to_string(i)}, {"inputs", {"u" + std::to_string(i)}}});
  }
  return spec;
}

TEST(Partition, AllOfEightAgentsAreTooMany) {
  EXPECT_EQ(test::read(with_agents(7)).coordination.partitions.size(), 877U);
  EXPECT_EQ(
      test::error_of(with_agents(8)),
      "'all' is possible for at most 7 agents, which have 877 partitions, found 8 agents; expected a list "
      "of partitions (/coordination/partitions)");
}

TEST(Partition, RequirementOverAllTakesAnyCanonicalName) {
  nlohmann::json spec = with_partitions("\"all\"");
  spec["requirements"] =
      nlohmann::json::parse(R"([{"name": "1", "where": "true", "min_delay": 1, "partition": "b|c+a"}])");
  EXPECT_EQ(test::read(spec).requirements[0].partition, 2);
  spec["requirements"][0]["partition"] = "a+b";
  EXPECT_EQ(test::error_of(spec),
            "expected the canonical name of a partition, found 'a+b' (/requirements/0/partition)");
}

TEST(Partition, ModesTakeUnlistedOnes) {
  nlohmann::json spec = with_partitions(R"([{"name": "pair", "classes": [["a", "c"]]}])");
  spec["network"] = nlohmann::json::parse(
      R"({"modes": [{"name": "m", "partition": "c+b+a"}, {"name": "n", "partition": "b|a+c"}],
          "transitions": [["m", "n"], ["n", "m"]]})");
  const NetworkSpec network = test::read(spec).network.value();
  EXPECT_EQ(network.modes[0].partition.name, "a+b+c");
  EXPECT_EQ(network.modes[0].partition.classes, (Classes{{0, 1, 2}}));
  EXPECT_EQ(network.modes[1].partition.name, "pair");
  for (const std::string wrong : {"a+b", "a+b+c+a", "a||b|c", "", "a+b+d", "|a+b+c"}) {
    spec["network"]["modes"][0]["partition"] = wrong;
    EXPECT_EQ(test::error_of(spec), "expected the name of a partition, such as 'a|b|c', found '" + wrong +
                                        "' (/network/modes/0/partition)");
  }
}

}  // namespace
}  // namespace coordreq
