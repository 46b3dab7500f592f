#include "answers/goal/lasting_goal.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "answers/goal/arrival.hpp"
#include "answers/goal/best_steps.hpp"
#include "choices/joint_actions.hpp"
#include "engine/find_levels.hpp"
#include "engine/level_messages.hpp"

namespace coordreq {
namespace {

/// Calls `change` with the rows of levels, whatever their width.
template <class Change>
void change_levels(LevelMap& map, const Change& change) {
  if (auto* const narrow = map.get_if<std::uint8_t>()) return change(*narrow);
  if (auto* const middle = map.get_if<std::uint16_t>()) return change(*middle);
  change(*map.get_if<std::uint32_t>());
}

/// The observer of one of several waves: work cannot be resumed from the levels of a single wave.
WaveWatch watch_of_run(const WaveWatch& watch, std::int64_t sweeps_before) {
  if (!watch.step) return {};
  return {.step = [&watch, sweeps_before](WaveStep step) {
    step.sweep += sweeps_before;
    step.layer = -1;
    step.state = {};
    watch.step(step);
  }};
}

/// The equation of v, once for cells of G alone with levels that sink, and once for all with levels that
/// rise. The waves count a step for each cell; it is taken back where the equation has none.
template <class Level>
class StayActions final : public RowOperator<Level> {
 public:
  StayActions(const LastingProblem& problem, const ActionGrouping& grouping, bool rises, int workers)
      : goal_(*problem.goal),
        rises_(rises),
        best_(make_joint_actions<Level>(grouping, problem.synthesis, true, workers)) {}

  bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* old, Level* next,
                   int worker) override {
    constexpr Level kTop = PostReader<Level>::kTop;
    const ConstRow goal = goal_.row(position.row);
    if (!rises_ && !any_set(goal)) return false;
    best_->next_levels(position, posts, old, next, worker);
    if (rises_) {
      for_each_bit(goal, [next](std::int64_t x) {
        if (next[x] < kTop) ++next[x];
      });
      return true;
    }
    const auto before = [](Level level) {
      return level == kTop || level == 0 ? level : static_cast<Level>(level - 1);
    };
    const std::int64_t length = goal_.row_length();
    std::int64_t done = 0;  // cells outside G keep their levels
    for_each_bit(goal, [&](std::int64_t x) {
      std::transform(old + done, old + x, next + done, before);
      next[x] = before(next[x]);
      done = x + 1;
    });
    std::transform(old + done, old + length, next + done, before);
    return true;
  }
  [[nodiscard]] bool rises() const override { return rises_; }

 private:
  const CellSet& goal_;
  bool rises_;
  std::unique_ptr<RowOperator<Level>> best_;
};

class StayFinder {
 public:
  StayFinder(const LastingProblem& problem, const WaveWatch& watch, ThreadTeam& team, WaveCounts& counts)
      : problem_(problem),
        engine_(problem.progress->engine()),
        watch_(watch),
        team_(team),
        counts_(counts),
        grouping_(engine_, single_classes(engine_.abstraction().inputs), team),
        levels_(first_nearness(engine_, *problem.invariant, *problem.goal, false)) {}

  LevelMap find() {
    std::optional<std::int64_t> before;
    while (true) {
      sink_in_goal();
      // Levels are nowhere below those before, so that they are the same if their sum is.
      if (before && *before == sum()) return std::move(levels_);
      rise();
      before = sum();
      open_goal();
    }
  }

 private:
  /// Of arrivals in all cells, infinite ones and those outside K as the levels have them.
  [[nodiscard]] std::int64_t sum() const {
    std::vector<std::int64_t> sums(static_cast<std::size_t>(team_.size()), 0);
    levels_.visit([&]<class Level>(const LevelRows<Level>& levels) {
      for_each_local_row(team_, levels.share(), levels.rows(), 256, [&](ThreadTeam::Range range, int worker) {
        std::int64_t& sum = sums[static_cast<std::size_t>(worker)];
        for (std::int64_t r = range.begin; r < range.end; ++r) {
          levels.shape().for_each_run([&, row = levels.row(r)](std::int64_t lane, std::int64_t count) {
            for (std::int64_t x = lane; x < lane + count; ++x) sum += LevelRows<Level>::kTop - row[x];
          });
        }
      });
    });
    return sum_of_all(levels_.share(), std::accumulate(sums.begin(), sums.end(), std::int64_t{0}));
  }

  /// The first equation of find_stay_nearness(), from v = 0 in G.
  void sink_in_goal() {
    const WaveWatch watch = watch_of_run(watch_, counts_.sweeps);
    change_levels(levels_, [&]<class Level>(LevelRows<Level>& levels) {
      StayActions<Level> actions(problem_, grouping_, false, team_.size());
      counts_.add(run_wave(levels, engine_, problem_.progress->hull(),
                           static_cast<Level>(LevelRows<Level>::kTop - 1), actions, watch, team_));
    });
  }

  void rise() {
    const auto make = [&]<class Level>(Level) -> std::unique_ptr<RowOperator<Level>> {
      return std::make_unique<StayActions<Level>>(problem_, grouping_, true, team_.size());
    };
    const LevelProblem rising{.make8 = [&] { return make(std::uint8_t{}); },
                              .make16 = [&] { return make(std::uint16_t{}); },
                              .make32 = [&] { return make(std::uint32_t{}); }};
    WaveWatch watch = watch_of_run(watch_, 0);  // find_levels() counts sweeps on
    LevelMap start = std::move(levels_);
    watch.resumed = &start;
    levels_ = find_levels(engine_, problem_.progress->hull(), rising, watch, team_, counts_);
  }

  /// v = 0 in G.
  void open_goal() {
    change_levels(levels_, [&]<class Level>(LevelRows<Level>& levels) {
      for (const RowShare::Range run : held_rows(levels.share(), levels.rows())) {
        for (std::int64_t r = run.begin; r < run.end; ++r) {
          const ConstRow goal = problem_.goal->row(r);
          if (!any_set(goal)) continue;
          levels.change_row(r, [&](Level* cells) {
            for_each_bit(goal, [cells](std::int64_t x) { cells[x] = LevelRows<Level>::kTop; });
          });
        }
      }
    });
  }

  const LastingProblem& problem_;
  const RowEngine& engine_;
  const WaveWatch& watch_;
  ThreadTeam& team_;
  WaveCounts& counts_;
  ActionGrouping grouping_;
  LevelMap levels_;
};

/// The cells of a set from which some action (`given`: every one) keeps in W.
CellSet keeping_cells(const LastingProblem& problem, const ActionGrouping& grouping, const LevelMap& nearness,
                      const CellSet& cells, ThreadTeam& team) {
  CellSet result(cells.rows(), cells.row_length());
  nearness.visit([&]<class Level>(const LevelRows<Level>& levels) {
    for_each_best(problem, grouping, levels, cells, team,
                  [&](const RowPosition& position, PostReader<Level>&, const Level* best, int) {
                    const MutableRow row = result.row(position.row);
                    for_each_bit(cells.row(position.row), [&](std::int64_t x) {
                      if (best[x] > 1)
                        row[static_cast<std::size_t>(x / CellSet::kWordBits)] |= Word{1}
                                                                                 << (x % CellSet::kWordBits);
                    });
                  });
  });
  return result;
}

std::int64_t count_of_all(const CellSet& cells, const RowShare* share) {
  const RowShare::Range local = local_rows(share, cells.rows());
  return sum_of_all(share, cells.count(local.begin, local.end));
}

/// first_nearness() of cells that only their owner knows.
LevelMap first_local_nearness(const LastingProblem& problem, const CellSet& visits) {
  LevelMap start = first_nearness(problem.progress->engine(), *problem.invariant, visits, false);
  change_levels(start, []<class Level>(LevelRows<Level>& levels) {
    if (levels.share() == nullptr) return;
    LevelMessages<Level>(levels).exchange(
        [](std::int64_t) { return true; },
        [&levels](std::int64_t row, const Level* others) { levels.put(row, others); });
  });
  return start;
}

/// The greatest arrival after one step, plus that step, by whatever is chosen from P in one row.
template <class Level>
class WorstChoices {
 public:
  explicit WorstChoices(const ActionGrouping& grouping) : grouping_(grouping) {}

  /// least[x] = the least level of a post in W, over all choices whose posts lie in W.
  void find(const RowPosition& position, PostReader<Level>& posts, ConstRow cells,
            std::vector<Level>& least) {
    least.assign(posts.lanes(), PostReader<Level>::kTop);
    grouping_.group(position, groups_);
    choose_groups(groups_, GroupChoice::all, candidates_);
    tuple_.begin(grouping_, position, groups_, candidates_);
    do {
      const ConstRow allowed = tuple_.allowed();
      const Level* const levels = posts.minimum(tuple_.slice_ids());
      for_each_bit(cells, [&](std::int64_t x) {
        const auto lane = static_cast<std::size_t>(x);
        const bool is_allowed =
            allowed.empty() || (allowed[lane / CellSet::kWordBits] >> (lane % CellSet::kWordBits) & 1) != 0;
        if (is_allowed && levels[x] > 1) least[lane] = std::min(least[lane], levels[x]);
      });
    } while (tuple_.next());
  }

 private:
  const ActionGrouping& grouping_;
  RowGroups groups_;
  TupleWalk::Candidates candidates_;
  TupleWalk tuple_;
};

}  // namespace

LevelMap find_stay_nearness(const LastingProblem& problem, const WaveWatch& watch, ThreadTeam& team,
                            WaveCounts& counts) {
  return StayFinder(problem, watch, team, counts).find();
}

LevelMap find_return_nearness(const LastingProblem& problem, const WaveWatch& watch, ThreadTeam& team,
                              WaveCounts& counts, const AfterRound& after_round) {
  const RowEngine& engine = problem.progress->engine();
  const RowShare* const share = engine.share();
  const ActionGrouping grouping(engine, single_classes(engine.abstraction().inputs), team);
  LevelMap nearness = first_nearness(engine, *problem.invariant, *problem.invariant, false);
  CellSet visits = keeping_cells(problem, grouping, nearness, *problem.goal, team);
  for (std::int64_t count = count_of_all(visits, share), before = -1; count != before;) {
    LevelMap start = first_local_nearness(problem, visits);
    nearness = {};
    WaveWatch round = watch_of_run(watch, 0);
    round.resumed = &start;
    nearness = find_nearness(engine, problem.progress->hull(), *problem.invariant, visits, problem.synthesis,
                             round, team, counts);
    if (after_round) after_round(nearness);
    visits = keeping_cells(problem, grouping, nearness, visits, team);
    before = std::exchange(count, count_of_all(visits, share));
  }
  return nearness;
}

LongestReturns find_longest_returns(const LastingProblem& problem, const LevelMap& nearness,
                                    ThreadTeam& team) {
  const RowEngine& engine = problem.progress->engine();
  const ActionGrouping grouping(engine, single_classes(engine.abstraction().inputs), team);
  const CellSet visits = nearness.top_cells(team);  // G and W
  std::vector<std::int32_t> forced(static_cast<std::size_t>(team.size()), 0), any_choice = forced;
  nearness.visit([&]<class Level>(const LevelRows<Level>& levels) {
    std::vector<WorstChoices<Level>> choices(static_cast<std::size_t>(team.size()),
                                             WorstChoices<Level>(grouping));
    const auto take = [](std::int32_t& longest, Level level) {
      longest = std::max(longest, arrival_of(level) + 1);
    };
    for_each_best(problem, grouping, levels, visits, team,
                  [&](const RowPosition& position, PostReader<Level>& posts, const Level* best, int worker) {
                    const auto w = static_cast<std::size_t>(worker);
                    const ConstRow cells = visits.row(position.row);
                    for_each_bit(cells, [&](std::int64_t x) { take(forced[w], best[x]); });
                    if (problem.synthesis == Synthesis::given) return;
                    std::vector<Level> least;
                    choices[w].find(position, posts, cells, least);
                    for_each_bit(cells, [&](std::int64_t x) {
                      take(any_choice[w], least[static_cast<std::size_t>(x)]);
                    });
                  });
  });
  const auto of_all = [&](const std::vector<std::int32_t>& longest) -> std::optional<std::int32_t> {
    const std::int32_t local_longest = *std::max_element(longest.begin(), longest.end());
    const auto all = engine.share() == nullptr
                         ? local_longest
                         : static_cast<std::int32_t>(engine.share()->ranks().greatest(local_longest));
    return all == 0 ? std::nullopt : std::optional(all);
  };
  LongestReturns result{of_all(forced), {}};
  result.any_choice = problem.synthesis == Synthesis::given ? result.forced : of_all(any_choice);
  return result;
}

LevelMap progress_bounds(const LastingProblem& problem, const LevelMap& nearness, GoalThen then) {
  const RowEngine& engine = problem.progress->engine();
  return nearness.visit([&]<class Level>(const LevelRows<Level>& levels) {
    auto bounds = engine.make_levels<Level>(engine.posts());
    std::vector<Level> cells(static_cast<std::size_t>(levels.row_length()) + kLevelBlock / sizeof(Level));
    for (const RowShare::Range run : held_rows(levels.share(), levels.rows())) {
      for (std::int64_t r = run.begin; r < run.end; ++r) {
        std::copy_n(levels.row(r), levels.row_length(), cells.begin());
        for_each_bit(problem.goal->row(r), [&](std::int64_t x) {
          Level& cell = cells[static_cast<std::size_t>(x)];
          cell = then == GoalThen::stay && cell > 1 ? static_cast<Level>(cell - 1) : Level{1};
        });
        bounds.put(r, cells.data());
      }
    }
    return LevelMap(std::move(bounds));
  });
}

}  // namespace coordreq
