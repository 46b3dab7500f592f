#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <span>
#include <vector>

#include "engine/action_groups.hpp"
#include "engine/sum_reader.hpp"
#include "engine/tuple_walk.hpp"
#include "reach/build_abstraction.hpp"
#include "support/random_problem.hpp"
#include "support/random_sums.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

using Level = std::uint8_t;

Abstraction random_sums(const SystemSpec& spec, ThreadTeam& team) {
  Abstraction abstraction = build_abstraction(spec, team);
  draw_sums(abstraction);
  return abstraction;
}

LevelRows<Level> random_levels(const RowEngine& engine) {
  constexpr Level kLevels[] = {0, 1, 2, 3, 254, 255, 255, 255};
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  auto levels = engine.make_levels<Level>(engine.posts());
  std::vector<Level> cells(static_cast<std::size_t>(levels.row_length()) + kLevelBlock);
  for (std::int64_t r = 0; r < levels.rows(); ++r) {
    for (Level& level : cells) level = kLevels[random() % std::size(kLevels)];
    levels.put(r, cells.data());
  }
  return levels;
}

LaneRange random_lanes(const RowEngine& engine) {
  const std::size_t n = engine.all_lanes().size();
  const auto begin = *rc::gen::inRange<std::size_t>(0, n);
  return {begin, *rc::gen::inRange<std::size_t>(begin + 1, n + 1)};
}

/// What the reader says of some choices at once, beside what it says of each.
/// @returns how many bounds of several choices have been found
std::size_t compare(const RowEngine& engine, SumReader<Level>& reader, std::span<const std::uint32_t> ids) {
  const std::size_t choices = ids.size() / engine.tables();
  std::vector<std::vector<Level>> minima;
  for (std::size_t k = 0; k < choices; ++k) {
    const Level* const row = reader.minimum(ids.subspan(k * engine.tables(), engine.tables()));
    minima.emplace_back(row, row + engine.row_length());
  }
  reader.take(ids);
  std::size_t found = 0;
  for (std::size_t k = 0; k < choices; ++k) {
    const LaneRange lanes = random_lanes(engine);
    const Level* const part = reader.minimum_of(k, lanes, 7);
    RC_ASSERT(
        std::equal(part, part + lanes.size(), minima[k].begin() + static_cast<std::ptrdiff_t>(lanes.begin)));
    RC_ASSERT(part[lanes.size()] == 7);
    const auto end = *rc::gen::inRange<std::size_t>(k + 1, choices + 1);
    const Level* const bound = reader.bound(k, end, lanes);
    if (bound == nullptr) continue;
    if (end - k > 1) ++found;
    for (std::size_t other = k; other < end; ++other) {
      for (std::size_t c = 0; c < lanes.size(); ++c) RC_ASSERT(bound[c] <= minima[other][lanes.begin + c]);
    }
  }
  return found;
}

TEST(SumReader, BoundsAreNowhereAboveTheMinimaOfTheirChoices) {
  ThreadTeam team(1);
  std::size_t found = 0, tried = 0;
  EXPECT_TRUE(rc::check("bound <= minimum of each choice", [&] {
    const SystemSpec spec = read_system(draw_problem(RandomTime::any, RandomEdges::plain), "random");
    RC_PRE(spec.states.size() > 1);
    const Abstraction abstraction = random_sums(spec, team);
    const RowEngine engine(abstraction, nullptr, {});
    RC_PRE(!engine.posts().is_cut());
    ++tried;
    const LevelRows<Level> levels = random_levels(engine);
    SumReader<Level> reader(engine, levels);
    const ActionGrouping grouping(engine, single_classes(abstraction.inputs), team);
    const auto fastest = *rc::gen::inRange<std::size_t>(0, grouping.size());
    const RowPlace place(engine.grid(), *rc::gen::inRange<std::int64_t>(0, engine.rows()));
    RowGroups groups;
    grouping.group(place, groups);
    TupleWalk::Candidates candidates;
    choose_groups(groups, GroupChoice::all, candidates);
    TupleWalk tuple;
    tuple.begin(grouping, place, groups, candidates, fastest);
    do {
      found += compare(engine, reader, tuple.all_slice_ids());
    } while (tuple.next_of_others());
  }));
  EXPECT_GT(4 * found, tried);  // else it says little
}

}  // namespace
}  // namespace coordreq
