#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "engine/action_groups.hpp"
#include "engine/limits.hpp"
#include "engine/post_reader.hpp"
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
    SumReader<Level> reader(engine, std::make_shared<SumPatches<Level>>(engine));
    const ActionGrouping grouping(engine, single_classes(abstraction.inputs), team);
    const auto fastest = *rc::gen::inRange<std::size_t>(0, grouping.size());
    const RowPosition position(engine.grid(), *rc::gen::inRange<std::int64_t>(0, engine.rows()));
    reader.enter(position.row / engine.unit_rows(), levels);
    RowGroups groups;
    grouping.group(position, groups);
    TupleWalk::Candidates candidates;
    choose_groups(groups, GroupChoice::all, candidates);
    TupleWalk tuple;
    tuple.begin(grouping, position, groups, candidates, fastest);
    do {
      found += compare(engine, reader, tuple.all_slice_ids());
    } while (tuple.next_of_others());
  }));
  EXPECT_GT(4 * found, tried);  // else it says little
}

/// Numbers of the slices of all choices of actions in a row, one choice after the other.
std::vector<std::uint32_t> all_choices(const ActionGrouping& grouping, const RowPosition& position) {
  RowGroups groups;
  grouping.group(position, groups);
  TupleWalk::Candidates candidates;
  choose_groups(groups, GroupChoice::all, candidates);
  TupleWalk tuple;
  tuple.begin(grouping, position, groups, candidates);
  std::vector<std::uint32_t> all;
  do {
    const auto ids = tuple.slice_ids();
    all.insert(all.end(), ids.begin(), ids.end());
  } while (tuple.next());
  return all;
}

/// The sum of the minima of all choices of a row, each weighted by its lane and choice.
std::uint64_t digest(const RowEngine& engine, const ActionGrouping& grouping, const RowPosition& position,
                     PostReader<Level>& posts) {
  const std::vector<std::uint32_t> ids = all_choices(grouping, position);
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < ids.size(); k += engine.tables()) {
    const Level* const row = posts.minimum(std::span(ids).subspan(k, engine.tables()));
    for (std::int64_t c = 0; c < engine.row_length(); ++c) sum = 31 * sum + row[c];
  }
  return sum;
}

TEST(SumPatches, ThreadsThatShareThemReadWhatOneReads) {
  ThreadTeam team(4), alone(1);
  EXPECT_TRUE(rc::check("rows are the same", [&] {
    const SystemSpec spec = read_system(draw_problem(RandomTime::any, RandomEdges::plain), "random");
    RC_PRE(spec.states.size() > 1);
    const Abstraction abstraction = random_sums(spec, alone);
    const RowEngine engine(abstraction, nullptr, {});
    RC_PRE(!engine.posts().is_cut());
    const ActionGrouping grouping(engine, single_classes(abstraction.inputs), alone);
    LevelRows<Level> levels = random_levels(engine);
    const PostReader<Level> first(engine, levels);
    std::deque<PostReader<Level>> readers(4, first);
    for (int round = 0; round < 2; ++round) {
      std::vector<std::uint64_t> read(static_cast<std::size_t>(engine.rows()));
      first.for_each_local_row(team, [&](ThreadTeam::Range range, int worker) {
        PostReader<Level>& posts = readers[static_cast<std::size_t>(worker)];
        for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
             position.advance(engine.grid())) {
          posts.enter(position.row);
          read[static_cast<std::size_t>(position.row)] = digest(engine, grouping, position, posts);
        }
      });
      for (RowPosition position(engine.grid(), 0); position.row < engine.rows();
           position.advance(engine.grid())) {
        PostReader<Level> posts(engine, levels);
        posts.enter(position.row);
        RC_ASSERT(read[static_cast<std::size_t>(position.row)] == digest(engine, grouping, position, posts));
      }
      levels = random_levels(engine);
    }
  }));
}

TEST(SumPatches, PatchesBeyondThoseKeptAreTheSame) {
  ThreadTeam team(1);
  std::size_t refused = 0;
  EXPECT_TRUE(rc::check("patches are the same", [&] {
    const SystemSpec spec = read_system(draw_problem(RandomTime::any, RandomEdges::plain), "random");
    RC_PRE(spec.states.size() > 1);
    const Abstraction abstraction = random_sums(spec, team);
    const RowEngine engine(abstraction, nullptr, {});
    RC_PRE(!engine.posts().is_cut());
    const LevelRows<Level> levels = random_levels(engine);
    SumPatches<Level> some(engine), fresh(engine);
    const std::vector<PatchLayout::Side>& sides = some.layout().sides;
    std::shared_ptr<SumPatches<Level>::Unit> unit, fresh_unit;
    some.enter(0, levels, unit);
    ShortWait wait;
    SumPatches<Level>::Key key{.ranges = std::vector<IndexRange>(engine.outer()), .widths = {}};
    key.widths.resize(sides.size());
    std::vector<Level> made;
    for (std::size_t k = 0; k <= kJoinedPatches; ++k) {
      std::size_t number = k;
      for (std::size_t i = 0; i < engine.outer(); ++i) {
        const auto count = static_cast<std::size_t>(engine.grid()[i].count);
        key.ranges[i].first = key.ranges[i].last = static_cast<std::int32_t>(number % count);
        number /= count;
      }
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto widths = static_cast<std::size_t>(sides[i].reach) + 1;
        key.widths[i] = static_cast<std::int32_t>(number % widths);
        number /= widths;
      }
      const Level* const kept = some.find(*unit, key, wait);
      if (kept == nullptr) ++refused;
      some.make(*unit, key, made);
      fresh.enter(0, levels, fresh_unit);
      const Level* const other = fresh.find(*fresh_unit, key, wait);
      RC_ASSERT(other != nullptr);
      RC_ASSERT(std::equal(other, other + some.layout().cells, made.begin()));
      if (kept != nullptr) RC_ASSERT(std::equal(other, other + some.layout().cells, kept));
      fresh.forget();
    }
  }));
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace coordreq
