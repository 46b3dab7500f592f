#include "safety/invariance.hpp"

#include "safety/wave.hpp"

namespace coordreq {
namespace {

struct Workspace {
  RowEngine::Scratch scratch;
  RowGroups groups;
  std::vector<Word> inside;
  std::vector<Word> found;
};

/// Every input by itself: the finest classes give the fewest joint groups to try.
std::vector<InputClass> single_inputs(const InputSpace& inputs) {
  std::vector<InputClass> classes;
  for (std::size_t i = 0; i < inputs.size(); ++i) classes.push_back({static_cast<std::int32_t>(i)});
  return classes;
}

class Predecessor {
 public:
  Predecessor(const RowEngine& engine, const ActionGrouping& grouping)
      : engine_(engine), grouping_(grouping) {}

  /// keep n {x : some allowed u has its post inside `current`}.
  void some(std::int64_t row, const RowTarget& current, MutableRow keep, Workspace& work) const {
    work.found.assign(keep.size(), 0);
    grouping_.group(row, work.groups);
    // A larger post is never of use where a smaller one of the same class is allowed alike.
    for_each_tuple(row, ActionGrouping::minimal_groups(work.groups), work,
                   [&](ActionGrouping::Tuples& tuple) {
                     inside(tuple, current, work);
                     bool all_found = true;
                     for (std::size_t w = 0; w < keep.size(); ++w) {
                       work.found[w] |= work.inside[w];
                       all_found = all_found && (keep[w] & ~work.found[w]) == 0;
                     }
                     return !all_found;
                   });
    for (std::size_t w = 0; w < keep.size(); ++w) keep[w] &= work.found[w];
  }

  /// keep n {x : some u is allowed, and every allowed u has its post inside `current`}.
  void every(std::int64_t row, const RowTarget& current, MutableRow keep, Workspace& work) const {
    work.found.assign(keep.size(), 0);
    grouping_.group(row, work.groups);
    for_each_tuple(row, ActionGrouping::all_groups(work.groups), work, [&](ActionGrouping::Tuples& tuple) {
      const ConstRow allowed = tuple.allowed();
      engine_.inside(tuple.slice_ids(), current, prepared(work), work.scratch);
      Word left = 0;
      for (std::size_t w = 0; w < keep.size(); ++w) {
        const Word may = allowed.empty() ? ~Word{0} : allowed[w];
        work.found[w] |= may;
        keep[w] &= work.inside[w] | ~may;
        left |= keep[w];
      }
      return left != 0;
    });
    for (std::size_t w = 0; w < keep.size(); ++w) keep[w] &= work.found[w];
  }

 private:
  MutableRow prepared(Workspace& work) const {
    work.inside.resize(engine_.row_words());
    return work.inside;
  }

  void inside(ActionGrouping::Tuples& tuple, const RowTarget& current, Workspace& work) const {
    const ConstRow allowed = tuple.allowed();
    prepared(work);
    if (!allowed.empty() && !any_set(allowed)) {
      work.inside.assign(work.inside.size(), 0);
      return;
    }
    engine_.inside(tuple.slice_ids(), current, work.inside, work.scratch);
    for (std::size_t w = 0; w < allowed.size(); ++w) work.inside[w] &= allowed[w];
  }

  /// Until `visit` returns false.
  template <class Visit>
  void for_each_tuple(std::int64_t row, std::vector<std::vector<std::uint32_t>> candidates, Workspace& work,
                      const Visit& visit) const {
    ActionGrouping::Tuples tuple(grouping_, row, work.groups, std::move(candidates));
    do {
      if (!visit(tuple)) return;
    } while (tuple.next());
  }

  const RowEngine& engine_;
  const ActionGrouping& grouping_;
};

}  // namespace

Invariance find_invariance(const RowEngine& engine, const RowReach& reach, const CellSet& safe,
                           Synthesis synthesis,
                           const std::function<void(std::int64_t, std::int64_t)>& stepped, ThreadTeam& team) {
  const ActionGrouping grouping(engine, single_inputs(engine.abstraction().inputs), team);
  const Predecessor predecessor(engine, grouping);
  std::vector<Workspace> work(static_cast<std::size_t>(team.size()));

  Invariance result{.invariant = safe, .collision_time = {}, .iterations = 0};
  result.collision_time.assign(static_cast<std::size_t>(safe.cells()), 0);
  for (std::int64_t r = 0; r < safe.rows(); ++r) {
    for_each_bit(safe.row(r), [&](std::int64_t c) {
      result.collision_time[static_cast<std::size_t>(r * safe.row_length() + c)] = Invariance::kNever;
    });
  }
  const Wave wave{.shrink =
                      [&](std::int64_t row, const RowTarget& current, MutableRow keep, int worker) {
                        Workspace& own = work[static_cast<std::size_t>(worker)];
                        if (synthesis == Synthesis::maximal) {
                          predecessor.some(row, current, keep, own);
                        } else {
                          predecessor.every(row, current, keep, own);
                        }
                      },
                  .removed =
                      [&](std::int64_t row, ConstRow removed, std::int64_t step) {
                        for_each_bit(removed, [&](std::int64_t c) {
                          result.collision_time[static_cast<std::size_t>(row * safe.row_length() + c)] =
                              static_cast<std::int32_t>(step);
                        });
                      },
                  .stepped = stepped};
  result.iterations = run_wave(result.invariant, wave, engine, reach, -1, team).steps;
  return result;
}

}  // namespace coordreq
