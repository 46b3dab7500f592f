#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <set>
#include <vector>

#include "answers/blind/answer.hpp"
#include "answers/step_codes.hpp"
#include "model/odometer.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/plain_blind.hpp"
#include "support/plain_posts.hpp"
#include "support/random_goal.hpp"
#include "support/random_problem.hpp"
#include "support/random_sight.hpp"
#include "support/random_sums.hpp"

namespace coordreq {
namespace {

std::size_t index_of(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

std::vector<std::int32_t> values(const FastAnalysis& fast, const DelayLayers& layers) {
  std::vector<std::int32_t> result;
  for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
    const std::int64_t level = layers.layers_of.at(x);
    const std::int32_t outside = fast.safe.test(x) ? kOutsideInvariant : kOutsideSafe;
    result.push_back(level == LevelMap::kTop ? layers.top_delay()
                     : level == 0            ? outside
                                             : static_cast<std::int32_t>(level - 1));
  }
  return result;
}

std::vector<std::vector<std::vector<bool>>> rows_of(const SilentTable& table, std::size_t steps) {
  std::vector<std::vector<std::vector<bool>>> rows;
  for (std::size_t k = 1; k <= steps; ++k) {
    auto& row = rows.emplace_back();
    for (std::int64_t fibre = 0; fibre < table.fibres(); ++fibre) {
      std::vector<bool>& actions = row.emplace_back();
      for (std::int64_t a = 0; a < table.actions; ++a)
        actions.push_back(table.allows(fibre, a, static_cast<std::int64_t>(k)));
    }
  }
  return rows;
}

void expect_agreement(const ProblemSpec& spec, const FastAnalysis& fast, const PlainAnalysis& safety) {
  const PlainBlind plain = silence_plainly(spec, fast.abstraction, members(fast.safe),
                                           members(fast.beyond.value_or(fast.safe)), safety);
  bool is_lower = false, is_pruned = false, goes_on = false;
  for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
    const PlainBlind::Partition& expected = plain.partitions[p];
    const DelayLayers& layers = blind_layers(*fast.answers, p);
    RC_ASSERT(layers.sizes == expected.sizes);
    RC_ASSERT(layers.fixed_point_index == expected.fixed_point_index);
    RC_ASSERT(layers.truncated == expected.truncated);
    RC_ASSERT(values(fast, layers) == expected.countdown);
    RC_ASSERT(values(fast, blind_delays(*fast.answers, p)) == expected.delay);
    is_lower = is_lower || expected.delay != safety.partitions[p].delay;
    is_pruned = is_pruned || expected.countdown != safety.partitions[p].delay;
    goes_on = goes_on || expected.sizes.size() > 2;
    for (std::size_t c = 0; c < expected.silent.size(); ++c) {
      if (!has_silent_table(spec, spec.coordination.partitions[p], c)) continue;
      const SilentTable& table = fast.answers->get<Blind>().partitions[p].tables[c];
      RC_ASSERT(rows_of(table, expected.silent[c].size()) == expected.silent[c]);
    }
  }
  RC_CLASSIFY(is_lower, "sight is worth something");
  RC_CLASSIFY(is_pruned, "cells leave B_1");
  RC_CLASSIFY(goes_on, "more than two layers");
}

/// Few agents see something, or many have all their partitions.
std::string draw_blind_problem() {
  const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
  const RandomAgents agents = *rc::gen::element(RandomAgents::few, RandomAgents::many);
  return with_sight(perhaps_with_goal(draw_problem(time, RandomEdges::any, agents)));
}

TEST(BlindSilence, RowsAndSinglePairsGiveTheSameBits) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("blind silence of the row engine equals that of the plain one", [&] {
    const ProblemSpec spec = read_spec(draw_blind_problem(), "random");
    const FastAnalysis fast(spec, team);
    expect_agreement(spec, fast, plainly(spec, fast));
  }));
}

TEST(BlindSilence, AgreesOnListedPairs) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("blind silence with a controller from a file", [&] {
    const ProblemSpec spec = read_spec(draw_blind_problem(), "random");
    PackedPairs listed{.inputs = make_input_space(spec).count(), .bytes = {}};
    const std::int64_t cells = make_grid(spec).cells();
    listed.bytes.resize(index_of(cells * listed.bytes_per_cell()));
    const int density = *rc::gen::inRange(3, 9);
    for (std::int64_t x = 0; x < cells; ++x) {
      for (std::int64_t u = 0; u < listed.inputs; ++u) {
        if ((x * 7919 + u * 104729) % 8 < density) listed.set(x, u);
      }
    }
    const FastAnalysis fast(spec, team, &listed);
    expect_agreement(spec, fast, plainly(spec, fast, &listed));
  }));
}

TEST(BlindSilence, AgreesOnAnySums) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("blind silence on hand-made sums", [&] {
    const ProblemSpec spec =
        read_spec(with_sight(draw_problem(RandomTime::any, RandomEdges::plain)), "random");
    RC_PRE(spec.states.size() > 1);
    Abstraction abstraction = build_abstraction(spec, team);
    draw_sums(abstraction);
    const FastAnalysis fast(spec, std::move(abstraction), team);
    expect_agreement(spec, fast, plainly(spec, fast));
  }));
}

/// Where runs can be that are silent from one cell on, whatever agents choose of what they may.
class SilentRuns {
 public:
  SilentRuns(const ProblemSpec& spec, const FastAnalysis& fast, std::size_t p)
      : fast_(fast),
        safe_(members(fast.safe)),
        safe_beyond_(members(fast.beyond.value_or(fast.safe))),
        invariant_(members(fast.invariance.invariant)),
        plain_(plainly(spec, fast)),
        posts_{fast.abstraction, safe_, safe_beyond_},
        partition_(spec.coordination.partitions[p]),
        projection_(plain_.partitions[p].projection),
        classes_(input_classes(spec, fast.abstraction.inputs, partition_)),
        blind_(fast.answers->get<Blind>().partitions[p]) {
    for (const auto& agents : partition_.classes) sights_.emplace_back(spec, fast.abstraction.grid, agents);
  }

  /// Whether all runs of the promise from x on are safe and end in K.
  bool keep_promise(std::int64_t x, std::int32_t delay) {
    cells_ = {x};
    if (delay == 0) return true;
    if (!step([&](std::size_t c, std::int64_t y, std::int64_t a) {
          return bool(projection_[c][index_of(y)][index_of(a)]);
        }))
      return false;
    const bool for_ever = delay == INT32_MAX;
    if (for_ever) {
      std::set<std::int64_t> all;
      while (!std::includes(all.begin(), all.end(), cells_.begin(), cells_.end())) {
        all.insert(cells_.begin(), cells_.end());
        if (!silent_step(blind_.table_steps())) return false;
      }
      return true;
    }
    for (std::int64_t k = delay - 1; k >= 1; --k) {
      if (!silent_step(std::min(k, blind_.table_steps()))) return false;
    }
    return std::all_of(cells_.begin(), cells_.end(), [&](std::int64_t y) { return invariant_[index_of(y)]; });
  }

 private:
  bool silent_step(std::int64_t k) {
    return step([&](std::size_t c, std::int64_t y, std::int64_t a) {
      if (sights_[c].sees_all()) return bool(projection_[c][index_of(y)][index_of(a)]);
      return blind_.tables[c].allows(static_cast<std::int64_t>(sights_[c].fibre(y)), a, k);
    });
  }

  /// All next cells, if each class takes any action that it may. @returns false if one is not safe, or a
  /// class may do nothing
  template <class May>
  bool step(const May& may) {
    std::set<std::int64_t> next;
    for (const std::int64_t x : cells_) {
      if (plain_.terminal[index_of(x)]) continue;
      bool some = false;
      for (std::int64_t u = 0; u < fast_.abstraction.inputs.count(); ++u) {
        bool is_chosen = true;
        for (std::size_t c = 0; c < classes_.size(); ++c)
          is_chosen = is_chosen && may(c, x, classes_[c].action(u));
        if (!is_chosen) continue;
        some = true;
        if (!plain_.permitted[index_of(x)][index_of(u)] || !posts_.stays_in(x, u, safe_)) return false;
        add_post(x, u, next);
      }
      if (!some) return false;
    }
    cells_ = std::move(next);
    return true;
  }

  void add_post(std::int64_t x, std::int64_t u, std::set<std::int64_t>& next) const {
    const UniformGrid& grid = fast_.abstraction.grid;
    std::vector<std::int64_t> counts, first;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const ResolvedRange range = fast_.abstraction.resolved(i, x, u);
      if (range.all_left()) return;
      first.push_back(range.inside.first);
      counts.push_back(range.inside.last - range.inside.first + 1);
    }
    Odometer index(counts);
    do {
      std::int64_t cell = 0;
      for (std::size_t i = 0; i < grid.size(); ++i)
        cell += (first[i] + index[i]) % grid[i].count * grid.stride(i);
      next.insert(cell);
    } while (index.advance());
  }

  const FastAnalysis& fast_;
  std::vector<bool> safe_, safe_beyond_, invariant_;
  PlainAnalysis plain_;
  PlainPosts posts_;
  const PartitionSpec& partition_;
  const std::vector<std::vector<std::vector<bool>>>& projection_;
  std::vector<InputClass> classes_;
  const BlindPartition& blind_;
  std::vector<PlainSight> sights_;
  std::set<std::int64_t> cells_;
};

TEST(BlindSilence, KeepsItsPromiseWhateverAgentsChoose) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("all silent runs are safe and end in K", [&] {
    const ProblemSpec spec = read_spec(with_sight(perhaps_with_goal(draw_problem())), "random");
    RC_PRE(spec.coordination.partitions.front().classes.size() > 1U);
    const FastAnalysis fast(spec, team);
    SilentRuns runs(spec, fast, 0);
    const std::vector<std::int32_t> delays = values(fast, blind_delays(*fast.answers, 0));
    bool is_long = false;
    for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
      const std::int32_t delay = delays[index_of(x)];
      // What `max_delay` has cut is a lower bound.
      if (delay >= 0) RC_ASSERT(runs.keep_promise(x, delay));
      is_long = is_long || (delay > 1 && delay != INT32_MAX);
    }
    RC_CLASSIFY(is_long, "delays of several steps");
  }));
}

}  // namespace
}  // namespace coordreq
