#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "engine/action_groups.hpp"
#include "engine/tuple_walk.hpp"
#include "engine/wave.hpp"
#include "spec/spec_types.hpp"

// Operators on levels for the joint actions of all agents together.
namespace coordreq {

template <class Level>
struct JointWorkspace {
  RowGroups groups;
  TupleWalk::Candidates candidates;
  TupleWalk tuple;
  std::vector<Level> lanes;
  std::vector<Level> everywhere;
  std::vector<Level> most;
  std::vector<Word> some_allowed;
};

/// level(x) = 1 + max over allowed u of min over f(x,u): one safe action is enough. Where levels rise it is
/// level(x) = -1 + max ...: the action that comes nearest to the goal.
template <class Level>
class SomeAction final : public RowOperator<Level> {
 public:
  SomeAction(const ActionGrouping& grouping, bool rises, int workers)
      : grouping_(grouping), rises_(rises), work_(static_cast<std::size_t>(workers)) {}

  bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* old, Level* next,
                   int worker) override {
    JointWorkspace<Level>& work = work_[static_cast<std::size_t>(worker)];
    const LevelKernels<Level>& kernels = posts.kernels();
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    std::fill_n(next, posts.lanes(), Level{0});
    grouping_.group(position, work.groups);
    // An action is not needed if another one of its class has a smaller post and is allowed at the same
    // cells.
    choose_groups(work.groups, GroupChoice::minimal, work.candidates);
    work.tuple.begin(grouping_, position, work.groups, work.candidates);
    LaneRange open = grouping_.engine().all_lanes();
    // Rows that are cut are read as a whole: to read fewer lanes only cost there.
    const bool is_cut = grouping_.engine().posts().is_cut();
    if (!is_cut) allow_at_most(old, posts.lanes(), work);
    do {
      raise(open, work, posts, next);
      if (rises_) continue;
      // No action can do better than to leave all levels as they were.
      if (is_cut && kernels.is_settled(next, old, n)) return false;
      if (is_cut) continue;
      const LaneRange still = kernels.below(next + open.begin, work.everywhere.data(),
                                            work.most.data() + open.begin, open.size());
      if (still.size() == 0) return false;
      open = {open.begin + still.begin, open.begin + still.end};
    } while (work.tuple.next());
    return true;
  }
  [[nodiscard]] bool rises() const override { return rises_; }

 private:
  /// work.most = the levels in `next` below which cells would sink.
  void allow_at_most(const Level* old, std::size_t lanes, JointWorkspace<Level>& work) const {
    work.everywhere.resize(lanes, PostReader<Level>::kTop);
    work.most.resize(lanes);
    std::transform(old, old + lanes, work.most.begin(),
                   [](Level level) { return static_cast<Level>(level == 0 ? 0 : level - 1); });
  }

  void raise(LaneRange lanes, JointWorkspace<Level>& work, PostReader<Level>& posts, Level* next) const {
    const ConstRow allowed = work.tuple.allowed();
    Level* const open = next + lanes.begin;
    if (allowed.empty()) {
      posts.kernels().raise(posts.minimum(work.tuple.slice_ids(), lanes, 0), open, lanes.size());
    } else if (any_set(allowed)) {
      work.lanes.resize(posts.lanes(), 0);
      posts.kernels().spread(allowed.data(), work.lanes.data(), grouping_.engine().all_lanes().size());
      posts.kernels().raise_where(posts.minimum(work.tuple.slice_ids(), lanes, 0),
                                  work.lanes.data() + lanes.begin, open, lanes.size());
    }
  }

  const ActionGrouping& grouping_;
  bool rises_;
  std::vector<JointWorkspace<Level>> work_;
};

/// level(x) = 1 + min over allowed u of min over f(x,u), 1 where nothing is allowed: all must be safe. This
/// is PRE of the paper, Eq. (9), for all sets of the sequence at once.
template <class Level>
class EveryAction final : public RowOperator<Level> {
 public:
  EveryAction(const ActionGrouping& grouping, bool rises, int workers)
      : grouping_(grouping), rises_(rises), work_(static_cast<std::size_t>(workers)) {}

  bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* /*old*/, Level* next,
                   int worker) override {
    JointWorkspace<Level>& work = work_[static_cast<std::size_t>(worker)];
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    work.lanes.assign(posts.lanes(), static_cast<Level>(-1));
    work.some_allowed.assign(grouping_.engine().row_words(), 0);
    std::fill_n(next, posts.lanes(), PostReader<Level>::kTop);
    grouping_.group(position, work.groups);
    choose_groups(work.groups, GroupChoice::maximal, work.candidates);
    work.tuple.begin(grouping_, position, work.groups, work.candidates);
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
  [[nodiscard]] bool rises() const override { return rises_; }

 private:
  const ActionGrouping& grouping_;
  bool rises_;
  std::vector<JointWorkspace<Level>> work_;
};

/// @param rises whether levels are nearness to a goal
template <class Level>
std::unique_ptr<RowOperator<Level>> make_joint_actions(const ActionGrouping& grouping, Synthesis synthesis,
                                                       bool rises, int workers) {
  if (synthesis == Synthesis::maximal) return std::make_unique<SomeAction<Level>>(grouping, rises, workers);
  return std::make_unique<EveryAction<Level>>(grouping, rises, workers);
}

}  // namespace coordreq
