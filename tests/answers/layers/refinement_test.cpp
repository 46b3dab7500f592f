#include "answers/layers/refinement.hpp"

#include <gtest/gtest.h>

#include <string>

#include "answers/agents.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/partition_names.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

std::vector<PartitionSpec> named(std::size_t count, const std::vector<std::string>& names) {
  std::vector<PartitionSpec> result;
  for (const std::string& name : names) result.push_back(parse_partition_name(agents(count), name).value());
  return result;
}

std::vector<std::string> names_of(const std::vector<PartitionSpec>& partitions,
                                  const std::vector<std::size_t>& numbers) {
  std::vector<std::string> names;
  for (const std::size_t p : numbers) names.push_back(partitions[p].name);
  return names;
}

TEST(Refinement, IsAboutClassesWithinClasses) {
  const auto p = named(4, {"a|b|c|d", "a+b|c|d", "a+c|b+d", "a+b|c+d", "a+b+c|d", "a+b+c+d"});
  for (const PartitionSpec& one : p) {
    EXPECT_TRUE(refines(one, one));
    EXPECT_TRUE(refines(p[0], one));
    EXPECT_TRUE(refines(one, p[5]));
  }
  EXPECT_TRUE(refines(p[1], p[3]));
  EXPECT_TRUE(refines(p[1], p[4]));
  EXPECT_FALSE(refines(p[3], p[1]));
  EXPECT_FALSE(refines(p[1], p[2]));
  EXPECT_FALSE(refines(p[3], p[4]));
  EXPECT_FALSE(refines(p[5], p[0]));
}

TEST(Refinement, CoarsestFirstKeepsTheOrderOfEquals) {
  const auto p = named(3, {"a|b|c", "b+c|a", "a+b+c", "a+b|c"});
  EXPECT_EQ(coarsest_first(p), (std::vector<std::size_t>{2, 1, 3, 0}));
}

TEST(Refinement, NextCoarserLeavesOutWhatFollows) {
  const auto p = named(4, {"a+b+c+d", "a+b+c|d", "a+b|c+d", "a+b|c|d", "a|b|c+d", "a|b|c|d"});
  EXPECT_EQ(names_of(p, next_coarser(p, 0)), (std::vector<std::string>{}));
  EXPECT_EQ(names_of(p, next_coarser(p, 2)), (std::vector<std::string>{"a+b+c+d"}));
  EXPECT_EQ(names_of(p, next_coarser(p, 3)), (std::vector<std::string>{"a+b+c|d", "a+b|c+d"}));
  EXPECT_EQ(names_of(p, next_coarser(p, 5)), (std::vector<std::string>{"a+b|c|d", "a|b|c+d"}));
}

/// Two classes of c can be merged in c (c - 1) / 2 ways.
TEST(Refinement, AmongAllPartitionsTheNextCoarserHaveTwoClassesMerged) {
  const std::vector<PartitionSpec> all = make_all_partitions(agents(5));
  for (std::size_t p = 0; p < all.size(); ++p) {
    const std::size_t classes = all[p].classes.size();
    const std::vector<std::size_t> next = next_coarser(all, p);
    EXPECT_EQ(next.size(), classes * (classes - 1) / 2);
    for (const std::size_t q : next) EXPECT_EQ(all[q].classes.size(), classes - 1);
  }
}

}  // namespace
}  // namespace coordreq
