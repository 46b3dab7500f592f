// All partitions of 3 or 4 agents on random systems: layers are ordered by refinement, what is skipped for
// that makes no difference, and the coalition map is what its definition says of the plain engine's delays.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

#include "answers/coalition/coalition_map.hpp"
#include "answers/layers/refinement.hpp"
#include "answers/step_codes.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/fast_engine.hpp"
#include "support/members.hpp"
#include "support/plain_engine.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

ProblemSpec draw_crowd() {
  const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
  return read_spec(draw_problem(time, RandomEdges::any, RandomAgents::many), "random");
}

/// The layers of all partitions by way of the coarser ones.
std::vector<DelayLayers> refined_layers(const ProblemSpec& spec, const FastAnalysis& fast, ThreadTeam& team) {
  const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
  std::vector<DelayLayers> layers(partitions.size());
  for (const std::size_t p : coarsest_first(partitions)) {
    if (partitions[p].classes.size() == 1) {
      layers[p] =
          coordinated_layers(fast.engine, fast.invariance.invariant, spec.coordination.max_delay, team);
      continue;
    }
    std::vector<const LevelMap*> coarser;
    for (const std::size_t q : next_coarser(partitions, p)) coarser.push_back(&layers[q].layers_of);
    layers[p].layers_of =
        find_layer_levels(fast.engine, fast.hull, fast.invariance.invariant, fast.actions[p].projections,
                          coarser, spec.coordination.max_delay, {}, team, layers[p].counts);
    follow_from_levels(spec.coordination.max_delay, team, layers[p]);
  }
  return layers;
}

std::vector<std::int64_t> levels_of(const DelayLayers& layers) {
  std::vector<std::int64_t> result;
  for (std::int64_t x = 0; x < layers.layers_of.cells(); ++x) result.push_back(layers.layers_of.at(x));
  return result;
}

TEST(AllPartitions, LayersByWayOfCoarserOnesAreTheSame) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("with and without the bounds of coarser partitions", [&] {
    const ProblemSpec spec = draw_crowd();
    const FastAnalysis fast(spec, team);
    const PlainAnalysis plain = plainly(spec, fast);
    const std::vector<DelayLayers> refined = refined_layers(spec, fast, team);
    std::int64_t visited = 0;
    std::int64_t visited_with_bounds = 0;
    std::size_t longest = 0;
    for (std::size_t p = 0; p < refined.size(); ++p) {
      RC_ASSERT(fast.delays(p) == plain.partitions[p].delay);
      RC_ASSERT(levels_of(refined[p]) == levels_of(fast.layers[p]));
      RC_ASSERT(refined[p].sizes == plain.partitions[p].sizes);
      RC_ASSERT(refined[p].fixed_point_index == plain.partitions[p].fixed_point_index);
      RC_ASSERT(refined[p].truncated == plain.partitions[p].truncated);
      visited += fast.layers[p].counts.rows_visited;
      visited_with_bounds += refined[p].counts.rows_visited;
      longest = std::max(longest, refined[p].sizes.size());
    }
    RC_ASSERT(visited_with_bounds <= visited);
    RC_CLASSIFY(visited_with_bounds < visited, "rows skipped");
    RC_CLASSIFY(longest > 2, "more than two layers");
    RC_CLASSIFY(spec.agents.size() == 4, "four agents");
  }));
}

/// Where max_delay cut the layers off, a cell that was left may have any longer delay: as if it had them all.
std::vector<std::int32_t> delays(const ProblemSpec& spec, const PlainAnalysis::Partition& partition) {
  std::vector<std::int32_t> result = partition.delay;
  if (partition.truncated) {
    std::replace(result.begin(), result.end(), static_cast<std::int32_t>(*spec.coordination.max_delay),
                 kUnbounded);
  }
  return result;
}

TEST(AllPartitions, FinerOnesHaveSmallerLayers) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("delays are monotone in refinement", [&] {
    const ProblemSpec spec = draw_crowd();
    const PlainAnalysis plain = plainly(spec, FastAnalysis(spec, team));
    const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
    for (std::size_t p = 0; p < partitions.size(); ++p) {
      for (std::size_t q = 0; q < partitions.size(); ++q) {
        if (!refines(partitions[p], partitions[q])) continue;
        const std::vector<std::int32_t> finer = delays(spec, plain.partitions[p]);
        const std::vector<std::int32_t> coarser = delays(spec, plain.partitions[q]);
        RC_ASSERT(std::equal(finer.begin(), finer.end(), coarser.begin(), std::less_equal<>()));
      }
    }
  }));
}

/// The definition, one cell at a time: least cost of any sufficing partition, then the ties.
class PlainCoalition {
 public:
  PlainCoalition(const ProblemSpec& spec, const PlainAnalysis& plain) : spec_(spec), plain_(plain) {}

  /// The partitions of least cost that are enough at a cell.
  [[nodiscard]] std::vector<std::size_t> cheapest(std::size_t x) const {
    std::vector<std::size_t> result;
    const CoordinationSpec& coordination = spec_.coordination;
    std::optional<Rational> least;
    for (std::size_t p = 0; p < coordination.partitions.size(); ++p) {
      if (plain_.partitions[p].delay[x] < *coordination.horizon) continue;
      const Rational cost = network_cost(coordination.partitions[p], coordination.link_cost);
      if (least && cost > *least) continue;
      if (!least || cost < *least) result.clear();
      least = cost;
      result.push_back(p);
    }
    return result;
  }

  [[nodiscard]] std::size_t first(const std::vector<std::size_t>& equals) const {
    const auto key = [&](std::size_t p) {
      const PartitionSpec& partition = spec_.coordination.partitions[p];
      std::size_t largest = 0;
      for (const auto& agents : partition.classes) largest = std::max(largest, agents.size());
      return std::pair(largest, partition.name);
    };
    return *std::min_element(equals.begin(), equals.end(),
                             [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  }

 private:
  const ProblemSpec& spec_;
  const PlainAnalysis& plain_;
};

TEST(AllPartitions, CoalitionsAreTheCheapestThatAreEnough) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("coalition map", [&] {
    const ProblemSpec spec = draw_crowd();
    const FastAnalysis fast(spec, team);
    const PlainAnalysis plain = plainly(spec, fast);
    std::vector<const DelayLayers*> layers;
    for (const DelayLayers& own : fast.layers) layers.push_back(&own);
    const CoalitionMap map =
        find_coalitions(spec.coordination, spec.agents.size(), fast.invariance.invariant, layers, team);
    const PlainCoalition expected(spec, plain);
    std::set<std::int64_t> different;
    for (std::int64_t x = 0; x < map.chosen.cells(); ++x) {
      const auto cell = static_cast<std::size_t>(x);
      const std::int64_t level = map.chosen.at(x);
      different.insert(level);
      const std::vector<std::size_t> cheapest = expected.cheapest(cell);
      // All together are always enough in K.
      RC_ASSERT((level == 0) == !plain.invariant[cell]);
      RC_ASSERT(level != LevelMap::kTop);
      if (level == 0) continue;
      RC_ASSERT(map.choices[static_cast<std::size_t>(level - 1)].partition == expected.first(cheapest));
      for (std::size_t pair = 0; pair < map.pairs.size(); ++pair) {
        const bool together = std::all_of(cheapest.begin(), cheapest.end(), [&](std::size_t p) {
          return are_together(spec.coordination.partitions[p], map.pairs[pair]);
        });
        RC_ASSERT(map.critical[pair].test(x) == together);
      }
    }
    RC_CLASSIFY(different.size() > 2, "several partitions");
    RC_CLASSIFY(different.size() > 4, "many partitions");
  }));
}

}  // namespace
}  // namespace coordreq
