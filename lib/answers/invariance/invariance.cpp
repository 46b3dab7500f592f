#include "answers/invariance/invariance.hpp"

#include <algorithm>
#include <utility>

#include "engine/find_levels.hpp"
#include "engine/tuple_walk.hpp"

namespace coordreq {
namespace {

template <class Level>
struct Workspace {
  RowGroups groups;
  TupleWalk::Candidates candidates;
  TupleWalk tuple;
  RowBox box;
  std::vector<Level> lanes;
  std::vector<Word> some_allowed;
};

/// level(x) = 1 + max over allowed u of min over f(x,u): one safe action is enough.
template <class Level>
class SomeAction final : public RowOperator<Level> {
 public:
  SomeAction(const ActionGrouping& grouping, const RowHull& hull, int workers)
      : grouping_(grouping), hull_(hull), work_(static_cast<std::size_t>(workers)) {}

  bool next_levels(const RowPlace& place, PostReader<Level>& posts, const Level* old, Level* next,
                   int worker) override {
    Workspace<Level>& work = work_[static_cast<std::size_t>(worker)];
    const LevelKernels<Level>& kernels = posts.kernels();
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    if (grouping_.engine().allow() == nullptr) {
      hull_.box(place, work.box);
      if (work.box.covers && kernels.is_settled(posts.minimum(work.box), old, n)) return false;
    }
    std::fill_n(next, posts.lanes(), Level{0});
    grouping_.group(place, work.groups);
    // A larger post is never of use where a smaller one of the same class is allowed alike.
    choose_groups(work.groups, GroupChoice::minimal, work.candidates);
    work.tuple.begin(grouping_, place, work.groups, work.candidates);
    do {
      raise(work, posts, next);
      // No action can do better than to leave all as it was.
      if (kernels.is_settled(next, old, n)) return false;
    } while (work.tuple.next());
    return true;
  }

 private:
  void raise(Workspace<Level>& work, PostReader<Level>& posts, Level* next) const {
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    const ConstRow allowed = work.tuple.allowed();
    if (allowed.empty()) {
      posts.kernels().raise(posts.minimum(work.tuple.slice_ids()), next, n);
    } else if (any_set(allowed)) {
      work.lanes.resize(posts.lanes(), 0);
      posts.kernels().spread(allowed.data(), work.lanes.data(), n);
      posts.kernels().raise_where(posts.minimum(work.tuple.slice_ids()), work.lanes.data(), next, n);
    }
  }

  const ActionGrouping& grouping_;
  const RowHull& hull_;
  std::vector<Workspace<Level>> work_;
};

/// level(x) = 1 + min over allowed u of min over f(x,u), 1 where nothing is allowed: all must be safe. That
/// is PRE of the paper, Eq. (9), for all sets of the sequence at once.
template <class Level>
class EveryAction final : public RowOperator<Level> {
 public:
  EveryAction(const ActionGrouping& grouping, int workers)
      : grouping_(grouping), work_(static_cast<std::size_t>(workers)) {}

  bool next_levels(const RowPlace& place, PostReader<Level>& posts, const Level* /*old*/, Level* next,
                   int worker) override {
    Workspace<Level>& work = work_[static_cast<std::size_t>(worker)];
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    work.lanes.assign(posts.lanes(), static_cast<Level>(-1));
    work.some_allowed.assign(grouping_.engine().row_words(), 0);
    std::fill_n(next, posts.lanes(), PostReader<Level>::kTop);
    grouping_.group(place, work.groups);
    choose_groups(work.groups, GroupChoice::maximal, work.candidates);
    work.tuple.begin(grouping_, place, work.groups, work.candidates);
    do {
      const ConstRow allowed = work.tuple.allowed();
      if (!allowed.empty()) {
        posts.kernels().spread(allowed.data(), work.lanes.data(), n);
        for (std::size_t w = 0; w < allowed.size(); ++w) work.some_allowed[w] |= allowed[w];
      }
      posts.kernels().lower_where(posts.minimum(work.tuple.slice_ids()), work.lanes.data(), next, n);
    } while (work.tuple.next());
    if (grouping_.engine().allow() != nullptr) {
      posts.kernels().spread(work.some_allowed.data(), work.lanes.data(), n);
      for (std::size_t c = 0; c < n; ++c) next[c] = static_cast<Level>(next[c] & work.lanes[c]);
    }
    return true;
  }

 private:
  const ActionGrouping& grouping_;
  std::vector<Workspace<Level>> work_;
};

template <class Level>
std::unique_ptr<RowOperator<Level>> make_operator(const ActionGrouping& grouping, const RowHull& hull,
                                                  Synthesis synthesis, int workers) {
  if (synthesis == Synthesis::maximal) return std::make_unique<SomeAction<Level>>(grouping, hull, workers);
  return std::make_unique<EveryAction<Level>>(grouping, workers);
}

}  // namespace

Invariance find_invariance(const RowEngine& engine, const RowHull& hull, const CellSet& safe,
                           Synthesis synthesis, const WaveWatch& watch, ThreadTeam& team,
                           const Tiles* tiles) {
  // The finest classes give the fewest joint groups to try.
  const ActionGrouping grouping(engine, single_classes(engine.abstraction().inputs), team);
  const int workers = team.size();
  const LevelProblem problem{
      .start = &safe,
      .equal = {tiles, tiles == nullptr ? nullptr : &tiles->tables()},
      .make8 = [&] { return make_operator<std::uint8_t>(grouping, hull, synthesis, workers); },
      .make16 = [&] { return make_operator<std::uint16_t>(grouping, hull, synthesis, workers); },
      .make32 = [&] { return make_operator<std::uint32_t>(grouping, hull, synthesis, workers); }};
  WaveCounts counts;
  Invariance result{.collision_time = find_levels(engine, hull, problem, watch, team, counts)};
  result.counts = counts;
  follow_from_collision_times(result, team);
  return result;
}

void follow_from_collision_times(Invariance& invariance, ThreadTeam& team) {
  invariance.invariant = invariance.collision_time.top_cells(team);
  // Synchronously, one sweep loses the cells of each collision time, and one more finds nothing to lose.
  const std::size_t levels = invariance.collision_time.histogram(team).finite.size();
  invariance.iterations = static_cast<std::int64_t>(std::max<std::size_t>(levels, 1));
}

}  // namespace coordreq
