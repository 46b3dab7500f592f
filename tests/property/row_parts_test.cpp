// The parts that the row engine is made of, against the abstraction cell by cell.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "answers/invariance/safe_set.hpp"
#include "engine/row_hull.hpp"
#include "engine/tuple_walk.hpp"
#include "spec/read_spec.hpp"
#include "support/draw.hpp"
#include "support/fast_engine.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

/// f(x, u) as the rules for leaving the domain leave it.
struct Post {
  bool blocked = false;
  bool gone = false;
  std::vector<IndexRange> box;

  Post(const Abstraction& abstraction, std::int64_t x, std::int64_t u) {
    for (std::size_t i = 0; i < abstraction.grid.size(); ++i) {
      const ResolvedRange range = abstraction.resolved(i, x, u);
      blocked = blocked || range.blocked;
      gone = gone || range.all_left();
      box.push_back(range.inside);
    }
  }
  /// Calls visit(cell) for every cell of the post.
  template <class Visit>
  void for_each(const UniformGrid& grid, const Visit& visit) const {
    if (!blocked && !gone) go(grid, 0, 0, visit);
  }

 private:
  template <class Visit>
  void go(const UniformGrid& grid, std::size_t i, std::int64_t cell, const Visit& visit) const {
    if (i == box.size()) return visit(cell);
    for (std::int64_t k = box[i].first; k <= box[i].last; ++k)
      go(grid, i + 1, cell + k % grid[i].count * grid.stride(i), visit);
  }
};

struct RandomEngine {
  ProblemSpec spec = read_spec(draw_problem(), "random");
  ThreadTeam team{1};
  Abstraction abstraction = build_abstraction(spec, team);
  PairRules pairs = pair_rules(spec, abstraction, team);
  RowEngine engine{abstraction, &pairs, {}};
};

bool holds(const IndexRange& range, std::int64_t count, std::int64_t k) {
  return (range.first <= k && k <= range.last) || (range.first <= k + count && k + count <= range.last);
}

/// Which rows are skipped rests on this box.
TEST(RowHull, HoldsThePostsOfTheRow) {
  EXPECT_TRUE(rc::check("rows of posts", [] {
    const RandomEngine random;
    const Abstraction& f = random.abstraction;
    const UniformGrid& grid = f.grid;
    const RowHull hull(random.engine);
    for (RowPosition position(grid, 0); position.row < grid.rows(); position.advance(grid)) {
      RowBox box;
      hull.box(position, box);
      for (std::int64_t c = 0; c < grid.row_length(); ++c) {
        for (std::int64_t u = 0; u < f.inputs.count(); ++u) {
          const Post post(f, position.row * grid.row_length() + c, u);
          post.for_each(grid, [&](std::int64_t cell) {
            for (std::size_t i = 0; i + 1 < grid.size(); ++i)
              RC_ASSERT(holds(box.ranges[i], grid[i].count, grid.index(cell, i)));
          });
        }
      }
    }
  }));
}

/// The joint input of one action a class, row-major over the inputs of each.
std::int64_t joint_input(const ActionGrouping& grouping, const std::vector<std::uint32_t>& actions) {
  std::int64_t u = 0;
  for (std::size_t c = 0; c < grouping.size(); ++c) {
    u += grouping[c].offsets()[actions[c]];
  }
  return u;
}

/// The segment of a slice says the same as the resolved range of cell c.
bool says(const RowSegment& segment, const ResolvedRange& range, const GridDimension& target,
          std::int64_t c) {
  using Kind = RowSegment::Kind;
  if (segment.kind == Kind::blocked) return range.blocked;
  if (segment.kind == Kind::gone) return !range.blocked && range.all_left();
  if (segment.kind == Kind::fixed) return !range.blocked && segment.range == range.inside;
  // A shifted one is resolved at the ends of the row, by margins; it may be shortened to what is in sight.
  const ResolvedRange moved = resolve(
      {static_cast<std::int32_t>(c + segment.range.first), static_cast<std::int32_t>(c + segment.range.last)},
      target.count, target.below, target.above);
  if (moved.blocked || range.blocked) return moved.blocked == range.blocked;
  return moved.inside == range.inside || (moved.all_left() && range.all_left());
}

/// What ranks tell each other rests on this.
TEST(RowHull, RowsMetAreThoseInTheBoxes) {
  EXPECT_TRUE(rc::check("of some rows, with cells of a set or all", [] {
    const RandomEngine random;
    const UniformGrid& grid = random.engine.grid();
    const RowHull hull(random.engine);
    CellSet set(grid.rows(), grid.row_length());
    for (std::int64_t r = 0; r < grid.rows(); ++r) {
      if (draw(0, 2) > 0) set.set(r * grid.row_length() + draw(0, static_cast<int>(grid.row_length()) - 1));
    }
    const CellSet* looked_at = draw(0, 1) == 0 ? &set : nullptr;
    const std::int64_t begin = draw(0, static_cast<int>(grid.rows()) - 1);
    const RowShare::Range rows{begin, draw(static_cast<int>(begin), static_cast<int>(grid.rows()))};
    std::vector<std::uint8_t> expected(static_cast<std::size_t>(grid.rows()), 0);
    RowBox box;
    std::vector<std::int64_t> counter;
    for (RowPosition position(grid, rows.begin); position.row < rows.end; position.advance(grid)) {
      if (looked_at != nullptr && !any_set(set.row(position.row))) continue;
      hull.box(position, box);
      for_each_row(grid, 0, box.ranges, counter,
                   [&](std::int64_t row) { expected[static_cast<std::size_t>(row)] = 1; });
    }
    RC_CLASSIFY(grid.across() > 1, "more than one dimension across");
    RC_CLASSIFY(std::ranges::count(expected, 0) > 0, "not all");
    RC_ASSERT(hull.rows_reached(looked_at, rows) == expected);
  }));
}

TEST(TupleWalk, GoesThroughAllJointGroupsOfARow) {
  EXPECT_TRUE(rc::check("slices and `allow` of every choice of groups", [] {
    const RandomEngine random;
    const Abstraction& f = random.abstraction;
    const UniformGrid& grid = f.grid;
    std::vector<std::vector<std::int32_t>> members(
        static_cast<std::size_t>(draw(1, static_cast<int>(f.inputs.size()))));
    for (std::size_t i = 0; i < f.inputs.size(); ++i) {
      const std::size_t c =
          i < members.size() ? i : static_cast<std::size_t>(draw(0, static_cast<int>(members.size()) - 1));
      members[c].push_back(static_cast<std::int32_t>(i));
    }
    std::vector<InputClass> classes;
    for (const auto& inputs : members) classes.emplace_back(f.inputs, inputs);
    ThreadTeam team(1);
    const ActionGrouping grouping(random.engine, classes, team);
    RowGroups groups;
    TupleWalk::Candidates candidates;
    TupleWalk walk;
    for (RowPosition position(grid, 0); position.row < grid.rows(); position.advance(grid)) {
      grouping.group(position, groups);
      choose_groups(groups, GroupChoice::all, candidates);
      walk.begin(grouping, position, groups, candidates);
      std::vector<std::uint32_t> expected(grouping.size(), 0);
      for (bool more = true; more;) {
        std::vector<std::uint32_t> actions;
        for (std::size_t c = 0; c < grouping.size(); ++c) {
          RC_ASSERT(walk.chosen(c) == expected[c]);
          actions.push_back(groups.classes[c]->representative[expected[c]]);
        }
        const std::int64_t u = joint_input(grouping, actions);
        const auto ids = walk.slice_ids();
        for (std::size_t t = 0; t < grid.size(); ++t) {
          for (const RowSegment& segment : random.engine.slices()[t].slices[ids[t]]) {
            for (std::int64_t c = segment.begin; c < segment.end; ++c)
              RC_ASSERT(says(segment, f.resolved(t, position.row * grid.row_length() + c, u), grid[t], c));
          }
        }
        RC_ASSERT(walk.allowed().empty() == (random.engine.allow() == nullptr));
        if (random.engine.allow() != nullptr)
          RC_ASSERT(std::ranges::equal(walk.allowed(), random.engine.allow()->row(position.row, u)));
        // The last class is the fastest.
        std::size_t c = grouping.size();
        while (c > 0 && ++expected[c - 1] == groups.classes[c - 1]->size()) expected[--c] = 0;
        more = walk.next();
        RC_ASSERT(more == (c > 0));
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
