#include "answers/goal/approach_layers.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "choices/controller_row.hpp"
#include "choices/independent_actions.hpp"
#include "engine/find_levels.hpp"
#include "engine/level_messages.hpp"

namespace coordreq {
namespace {

/// The cells of `outside_goal` where every choice of IND_P comes nearer to the goal, as P requires.
CellSet nearing_cells(const ApproachSets& sets, const Projections& projections, ThreadTeam& team) {
  const RowEngine& engine = sets.progress->engine();
  CellSet result(engine.rows(), engine.row_length());
  sets.nearness->visit([&]<class Level>(const LevelRows<Level>& levels) {
    const LevelRows<Level>& bounds = bounds_of(Controller{.bounds = sets.bounds}, levels);
    IndependentActions<Level> actions(projections, *sets.outside_goal, team.size());
    const PostReader<Level> first(engine, levels);
    std::deque<PostReader<Level>> readers(static_cast<std::size_t>(team.size()), first);
    first.for_each_local_row(team, [&](ThreadTeam::Range range, int worker) {
      PostReader<Level>& posts = readers[static_cast<std::size_t>(worker)];
      std::vector<Level> least(posts.lanes(), 0);
      for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
           position.advance(engine.grid())) {
        posts.enter(position.row);
        const ConstRow outside_goal = sets.outside_goal->row(position.row);
        if (!any_set(outside_goal)) continue;
        actions.find_minimum(position, posts, least.data(), worker);
        const MutableRow nearing = result.row(position.row);
        posts.kernels().above_bits(least.data(), bounds.row(position.row), nearing.data(),
                                   static_cast<std::size_t>(engine.row_length()));
        for (std::size_t w = 0; w < nearing.size(); ++w) nearing[w] &= outside_goal[w];
      }
    });
  });
  return result;
}

/// The operator of layers under IND_P for the cells where all choices come nearer; other cells keep their
/// levels.
template <class Level>
class ApproachActions final : public RowOperator<Level> {
 public:
  ApproachActions(const ApproachSets& sets, const Projections& projections, const CellSet& nearing,
                  int workers)
      : actions_(projections, *sets.outside_goal, workers),
        nearing_(nearing),
        lanes_(static_cast<std::size_t>(workers)) {}

  bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* old, Level* next,
                   int worker) override {
    constexpr Level kTop = PostReader<Level>::kTop;
    const ConstRow nearing = nearing_.row(position.row);
    if (!any_set(nearing)) return false;
    actions_.find_minimum(position, posts, next, worker);
    std::vector<Level>& lanes = lanes_[static_cast<std::size_t>(worker)];
    lanes.resize(posts.lanes());
    const auto n = static_cast<std::size_t>(nearing_.row_length());
    posts.kernels().spread(nearing.data(), lanes.data(), n);
    for (std::size_t x = 0; x < n; ++x) {
      if (lanes[x] == 0) next[x] = old[x] == kTop || old[x] == 0 ? old[x] : static_cast<Level>(old[x] - 1);
    }
    return true;
  }

 private:
  IndependentActions<Level> actions_;
  const CellSet& nearing_;
  std::vector<std::vector<Level>> lanes_;
};

/// The levels that the wave begins with, as wide as those of the layers.
LevelMap first_levels(const ApproachSets& sets, const CellSet& nearing, const DelayLayers& layers) {
  const RowEngine& engine = sets.progress->engine();
  return layers.layers_of.visit([&]<class Level>(const LevelRows<Level>& safe) {
    auto levels = engine.make_levels<Level>(engine.posts());
    std::vector<Level> cells(static_cast<std::size_t>(levels.row_length()) + kLevelBlock / sizeof(Level));
    const RowShare::Range rows = local_rows(engine.share(), levels.rows());
    for (std::int64_t r = rows.begin; r < rows.end; ++r) {
      const Level* const safe_row = safe.row(r);
      std::fill(cells.begin(), cells.end(), Level{0});
      for_each_bit(sets.outside_goal->row(r),
                   [&](std::int64_t x) { cells[static_cast<std::size_t>(x)] = 1; });
      for_each_bit(nearing.row(r),
                   [&](std::int64_t x) { cells[static_cast<std::size_t>(x)] = LevelRows<Level>::kTop; });
      if (sets.goal != nullptr)
        for_each_bit(sets.goal->row(r),
                     [&](std::int64_t x) { cells[static_cast<std::size_t>(x)] = safe_row[x]; });
      levels.put(r, cells.data());
    }
    if (engine.share() != nullptr) {
      LevelMessages<Level>(levels).exchange(
          [](std::int64_t) { return true; },
          [&levels](std::int64_t row, const Level* others) { levels.put(row, others); });
    }
    return LevelMap(std::move(levels));
  });
}

}  // namespace

LevelMap find_approach_levels(const ApproachSets& sets, const Projections& projections,
                              const DelayLayers& layers, std::optional<std::int64_t> max_delay,
                              const WaveWatch& watch, ThreadTeam& team, WaveCounts& counts) {
  const CellSet nearing = nearing_cells(sets, projections, team);
  const auto make = [&]<class Level>(Level) -> std::unique_ptr<RowOperator<Level>> {
    return std::make_unique<ApproachActions<Level>>(sets, projections, nearing, team.size());
  };
  const LevelProblem problem{.limit = max_delay.value_or(-1),
                             .make8 = [&] { return make(std::uint8_t{}); },
                             .make16 = [&] { return make(std::uint16_t{}); },
                             .make32 = [&] { return make(std::uint32_t{}); }};
  LevelMap start;
  WaveWatch inner_watch = watch;
  if (inner_watch.resumed == nullptr) {
    // Levels above the limit count as kTop: without a step to come nearer in, all of W does.
    start = first_levels(sets, max_delay == 0 ? *sets.outside_goal : nearing, layers);
    inner_watch.resumed = &start;
  }
  return find_levels(sets.progress->engine(), sets.progress->hull(), problem, inner_watch, team, counts);
}

}  // namespace coordreq
