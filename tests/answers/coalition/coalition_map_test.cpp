#include "answers/coalition/coalition_map.hpp"

#include <gtest/gtest.h>

#include <string>

#include "answers/agents.hpp"
#include "answers/step_codes.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/partition_names.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kNone = -1;  ///< no delay: outside K

/// Layers of one row of cells with these delays.
template <class Level>
DelayLayers layers(const std::vector<std::int64_t>& delays, bool truncated = false) {
  LevelRows<Level> levels(1, static_cast<std::int64_t>(delays.size()), {}, {});
  std::int64_t longest = 0;
  for (std::size_t c = 0; c < delays.size(); ++c) {
    const bool is_finite = delays[c] != kUnbounded;
    if (is_finite) longest = std::max(longest, delays[c]);
    levels.change_row(0, [&](Level* row) {
      row[c] = is_finite ? static_cast<Level>(delays[c] + 1) : LevelRows<Level>::kTop;
    });
  }
  DelayLayers result{.layers_of = LevelMap(std::move(levels)), .truncated = truncated};
  result.sizes.resize(static_cast<std::size_t>(longest) + 2);
  return result;
}

template <class... Layers>
std::vector<DelayLayers> several(Layers... layers) {
  std::vector<DelayLayers> result;
  (result.push_back(std::move(layers)), ...);
  return result;
}

struct Case {
  std::vector<std::string> partitions;
  std::vector<DelayLayers> layers;
  std::int64_t horizon = 0;
  std::vector<LinkCostSpec> link_cost;
  std::size_t agents = 3;
};

class Found {
 public:
  explicit Found(const Case& one) {
    CoordinationSpec coordination{.horizon = one.horizon, .link_cost = one.link_cost};
    for (const std::string& name : one.partitions)
      coordination.partitions.push_back(parse_partition_name(agents(one.agents), name).value());
    std::vector<const DelayLayers*> all;
    for (const DelayLayers& layers : one.layers) all.push_back(&layers);
    const std::int64_t cells = one.layers[0].layers_of.cells();
    CellSet invariant(1, cells);
    for (std::int64_t c = 0; c < cells; ++c) {
      if (one.layers[0].layers_of.at(c) != 0) invariant.set(c);
    }
    ThreadTeam team(2);
    map_ = find_coalitions(coordination, one.agents, invariant, all, team);
    names_ = one.partitions;
  }

  /// Of each cell the name of the partition, "-" outside K, "none" where none is enough.
  [[nodiscard]] std::vector<std::string> chosen() const {
    std::vector<std::string> result;
    for (std::int64_t c = 0; c < map_.chosen.cells(); ++c) {
      const std::int64_t level = map_.chosen.at(c);
      result.push_back(level == 0 ? "-"
                       : level == LevelMap::kTop
                           ? "none"
                           : names_[map_.choices[static_cast<std::size_t>(level - 1)].partition]);
    }
    return result;
  }
  /// Of each cell the critical pairs, as "ab bc".
  [[nodiscard]] std::vector<std::string> critical() const {
    std::vector<std::string> result(static_cast<std::size_t>(map_.chosen.cells()));
    for (std::size_t pair = 0; pair < map_.pairs.size(); ++pair) {
      for (std::size_t c = 0; c < result.size(); ++c) {
        if (!map_.critical[pair].test(static_cast<std::int64_t>(c))) continue;
        result[c] += result[c].empty() ? "" : " ";
        result[c] += static_cast<char>('a' + map_.pairs[pair].first);
        result[c] += static_cast<char>('a' + map_.pairs[pair].second);
      }
    }
    return result;
  }
  [[nodiscard]] const CoalitionMap& map() const { return map_; }

 private:
  CoalitionMap map_;
  std::vector<std::string> names_;
};

using Labels = std::vector<std::string>;

TEST(CoalitionMap, GivesEachCellTheCheapestPartitionThatIsEnough) {
  const Found found(
      {.partitions = {"a+b+c", "a+b|c", "a|b+c", "a|b|c"},
       .layers = several(
           layers<std::uint8_t>({kNone, kUnbounded, kUnbounded, kUnbounded, kUnbounded, kUnbounded}),
           layers<std::uint16_t>({kNone, kUnbounded, 5, 4, 7, kUnbounded}),
           layers<std::uint8_t>({kNone, 9, 2, 4, 5, 5}), layers<std::uint32_t>({kNone, 5, 0, 4, 4, 3})),
       .horizon = 5});
  EXPECT_EQ(found.chosen(), (Labels{"-", "a|b|c", "a+b|c", "a+b+c", "a+b|c", "a+b|c"}));
  // Where a|b+c is as cheap and enough too, neither pair must be together.
  EXPECT_EQ(found.critical(), (Labels{"", "", "ab", "ab ac bc", "", ""}));
  EXPECT_EQ(found.map().cells, (std::vector<std::int64_t>{1, 3, 0, 1}));
  EXPECT_EQ(found.map().without, 0);
  EXPECT_EQ(found.map().critical_cells, (std::vector<std::int64_t>{2, 1, 1}));
}

TEST(CoalitionMap, SaysWhereNoListedPartitionIsEnough) {
  const Found found({.partitions = {"a+b|c", "a|b|c"},
                     .layers = several(layers<std::uint8_t>({kNone, 3, kUnbounded, 2}),
                                       layers<std::uint8_t>({kNone, 3, 1, 0})),
                     .horizon = 3});
  EXPECT_EQ(found.chosen(), (Labels{"-", "a|b|c", "a+b|c", "none"}));
  EXPECT_EQ(found.critical(), (Labels{"", "", "ab", ""}));
  EXPECT_EQ(found.map().without, 1);
}

TEST(CoalitionMap, HasTiesInPairsThoughNotInCosts) {
  // a+b|c+d, a+c|b+d and a+b+c|d cost two links each.
  const Found found({.partitions = {"a+c|b+d", "a+b|c+d", "a+b+c|d"},
                     .layers = several(layers<std::uint8_t>({1, 0, 0, 1}), layers<std::uint8_t>({1, 1, 0, 0}),
                                       layers<std::uint8_t>({1, 1, 1, 1})),
                     .horizon = 1,
                     .agents = 4});
  EXPECT_EQ(found.chosen(), (Labels{"a+b|c+d", "a+b|c+d", "a+b+c|d", "a+c|b+d"}));
  EXPECT_EQ(found.critical(), (Labels{"", "ab", "ab ac bc", "ac"}));
}

TEST(CoalitionMap, LinksThatCostMoreMakeOtherPairsCritical) {
  Case one{.partitions = {"a+b|c", "a|b+c"},
           .layers = several(layers<std::uint8_t>({1}), layers<std::uint8_t>({1})),
           .horizon = 1};
  EXPECT_EQ(Found(one).chosen(), Labels{"a+b|c"});
  EXPECT_EQ(Found(one).critical(), Labels{""});
  one.link_cost = {{0, 1, Rational(1, 2)}};
  EXPECT_EQ(Found(one).critical(), Labels{"ab"});
  one.link_cost = {{0, 1, 2}};
  EXPECT_EQ(Found(one).chosen(), Labels{"a|b+c"});
  EXPECT_EQ(Found(one).critical(), Labels{"bc"});
}

TEST(CoalitionMap, HorizonsAroundTheEndOfEightBits) {
  for (const std::int64_t horizon : {252, 253, 254, 255, 256}) {
    const Found found({.partitions = {"a|b|c"},
                       .layers = several(layers<std::uint8_t>({252, 253, kUnbounded})),
                       .horizon = horizon});
    EXPECT_EQ(found.chosen(),
              (Labels{horizon <= 252 ? "a|b|c" : "none", horizon <= 253 ? "a|b|c" : "none", "a|b|c"}));
  }
}

TEST(CoalitionMap, CellsThatMaxDelayCutOffHaveShownThatMuchAndNoMore) {
  // Stopped after 5 steps: sizes |Z_0|, ..., |Z_5|.
  const auto cut = [] {
    DelayLayers result = layers<std::uint8_t>({4, kUnbounded}, true);
    result.sizes.resize(6);
    return result;
  };
  EXPECT_EQ(Found({.partitions = {"a|b|c"}, .layers = several(cut()), .horizon = 5}).chosen(),
            (Labels{"none", "a|b|c"}));
  EXPECT_EQ(Found({.partitions = {"a|b|c"}, .layers = several(cut()), .horizon = 6}).chosen(),
            (Labels{"none", "none"}));
}

TEST(CoalitionMap, OneAgentHasNoPairs) {
  const Found found(
      {.partitions = {"a"}, .layers = several(layers<std::uint8_t>({kUnbounded, kNone})), .agents = 1});
  EXPECT_EQ(found.chosen(), (Labels{"a", "-"}));
  EXPECT_TRUE(found.map().pairs.empty());
}

/// 877 partitions do not fit into eight bits.
TEST(CoalitionMap, OfAllPartitionsOfSevenAgents) {
  const std::vector<PartitionSpec> all = make_all_partitions(agents(7));
  Case one{.horizon = 1, .agents = 7};
  for (const PartitionSpec& partition : all) {
    one.partitions.push_back(partition.name);
    // Cell 0: only all together are enough; cell 1: only g with someone; cell 2: everybody.
    const bool with_g = partition.classes.back() != std::vector<std::int32_t>{6};
    one.layers.push_back(layers<std::uint8_t>({partition.classes.size() == 1 ? 1 : 0, with_g ? 1 : 0, 1}));
  }
  const Found found(one);
  EXPECT_EQ(found.chosen(), (Labels{"a+b+c+d+e+f+g", "a+g|b|c|d|e|f", "a|b|c|d|e|f|g"}));
  EXPECT_EQ(found.critical()[0].size(), 21U * 3 - 1);
  EXPECT_EQ(found.critical()[1], "");
}

}  // namespace
}  // namespace coordreq
