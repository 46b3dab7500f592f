#include "cell/explain_delay.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "answers/paths.hpp"
#include "answers/plan.hpp"
#include "answers/silence/answer.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "cell/cell_controller.hpp"
#include "cell/file_sets.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

class Explainer {
 public:
  Explainer(const ResultsReader& results, std::size_t partition, ThreadTeam& team)
      : results_(results),
        partition_(partition),
        sets_(results, partition, team),
        controller_(results, team),
        posts_(*sets_.context().abstraction),
        classes_(input_classes(results.spec(), results.inputs(),
                               results.spec().coordination.partitions[partition])) {
    for (InputClass& input_class : classes_) input_class.tabulate();
  }

  DelayExplanation run(std::int64_t cell, const std::vector<Rational>& state) {
    DelayExplanation found{.delay = delay_at(cell)};
    found.is_lower_bound = sets_.delays().is_lower_bound(cell);
    const bool is_bounded = sets_.delays().is_bounded(cell);
    if (is_bounded) found.path = counterexample(cell, state);
    found.is_terminal = is_terminal(cell);
    if (!found.is_terminal) {
      add_others(cell, is_bounded, found);
      if (results_.spec().silence) found.silence = explain_silence(cell, state);
    }
    if (found.delay < 0) return found;
    found.actions = controller_.actions(partition_, cell);
    const std::vector<bool>& together = controller_.joint_inputs(cell);
    found.together = std::count(together.begin(), together.end(), true);
    found.alone = choices(found.actions);
    if (!is_bounded) return found;
    find_remedies(cell, found);
    find_neighbour(cell, found);
    return found;
  }

 private:
  void add_others(std::int64_t cell, bool is_bounded, DelayExplanation& found) {
    const ExplainContext context{
        .spec = &results_.spec(),
        .partition = &results_.spec().coordination.partitions[partition_],
        .posts = &posts_,
        .cell = cell,
        .delay = found.delay,
        .is_bounded = is_bounded,
        .values = [&](const std::string& path) { return controller_.values(path, partition_); },
        .projections = [&](std::int64_t other) { return controller_.actions(partition_, other); },
        .actions =
            [&](const AnswerPolicy& policy) {
              return controller_.actions(policy, partition_, cell, found.delay);
            }};
    for (const Answer& answer : all_answers()) {
      if (answer.explain == nullptr) continue;
      if (Explained added = answer.explain(context); !added.key.empty())
        found.others.push_back(std::move(added));
    }
  }

  [[nodiscard]] std::int32_t delay_at(std::int64_t cell) const { return sets_.delays().at(cell); }

  /// A goal that ends the task is reached there.
  [[nodiscard]] bool is_terminal(std::int64_t cell) {
    return results_.spec().ends_at_goal() && controller_.values(paths::kArrival, partition_)(cell) == 0;
  }

  [[nodiscard]] ResultPath counterexample(std::int64_t cell, const std::vector<Rational>& state) const {
    CounterexampleProblem problem = sets_.problem(sets_.delays());
    problem.phases = {independent_phase(problem, sets_.delays().layers()), evasive_phase(problem)};
    return find_counterexample(problem, cell, state);
  }

  /// With a fallback rule the path ends outside K': the file does not have the steps after which that rule
  /// leaves S.
  [[nodiscard]] ResultPath silent_counterexample(std::int64_t cell,
                                                 const std::vector<Rational>& state) const {
    const FileSteps& silence = sets_.silence();
    CounterexampleProblem problem = sets_.problem(silence);
    if (results_.spec().silence->has_then()) {
      problem.phases = {silent_phase(silence.layers(), [&silence](std::int64_t y) {
        return silence.at(y) >= 0 ? INT64_MAX : silence.at(y) == kOutsideSafe ? 0 : 1;
      })};
    } else {
      problem.phases = {silent_phase(silence.layers(), problem.collision_time), evasive_phase(problem)};
    }
    return find_counterexample(problem, cell, state);
  }

  [[nodiscard]] DelayExplanation::Silence explain_silence(std::int64_t cell,
                                                          const std::vector<Rational>& state) {
    DelayExplanation::Silence found{.steps = sets_.silence().at(cell),
                                    .is_lower_bound = sets_.silence().is_lower_bound(cell)};
    found.actions = controller_.actions(silence_policies(results_.spec()).front(), partition_, cell, 0);
    if (found.steps >= 0 && sets_.silence().is_bounded(cell)) found.path = silent_counterexample(cell, state);
    return found;
  }

  [[nodiscard]] static std::int64_t choices(const std::vector<std::vector<bool>>& actions) {
    std::int64_t product = 1;
    for (const std::vector<bool>& allowed : actions)
      product *= std::count(allowed.begin(), allowed.end(), true);
    return product;
  }

  /// The number of steps that a post leaves, this one included; a blocked one leaves none.
  [[nodiscard]] std::int32_t steps_after(const CellPost& post) {
    if (post.blocked != CellPost::Blocked::no) return 0;
    if (post.all_left) return kUnbounded;
    const auto [entry, is_new] = known_.try_emplace(post.box, kUnbounded);
    if (!is_new) return entry->second;
    for_each_cell(posts_.grid(), post.box, [&, &worst = entry->second](std::int64_t next) {
      const std::int32_t delay = delay_at(next);
      worst = std::min(worst, delay == kUnbounded ? kUnbounded : std::max(delay, -1) + 1);
      return worst > 0;
    });
    return entry->second;
  }

  /// For each class and each of its actions the worst that the others can make of it.
  void find_remedies(std::int64_t cell, DelayExplanation& found) {
    std::vector<std::vector<std::int32_t>> worst;
    for (const InputClass& input_class : classes_) worst.emplace_back(at(input_class.actions()), kUnbounded);
    posts_.move_to(cell);
    for (std::int64_t u = 0; u < posts_.inputs().count(); ++u) {
      const bool is_choice = std::equal(classes_.begin(), classes_.end(), found.actions.begin(),
                                        [u](const InputClass& input_class, const std::vector<bool>& actions) {
                                          return actions[at(input_class.action(u))];
                                        });
      if (!is_choice) continue;
      const bool is_forbidden = controller_.forbids(cell, u);
      const std::int32_t steps = is_forbidden ? 0 : steps_after(posts_.post(u, sets_.context().tubes()));
      for (std::size_t c = 0; c < classes_.size(); ++c) {
        std::int32_t& least = worst[c][at(classes_[c].action(u))];
        least = std::min(least, steps);
      }
    }
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      std::optional<DelayExplanation::Remedy> best;
      for (std::size_t a = 0; a < worst[c].size(); ++a) {
        if (!found.actions[c][a] || worst[c][a] <= (best ? best->delay : found.delay)) continue;
        best = {.class_number = c, .action = static_cast<std::int64_t>(a), .delay = worst[c][a]};
      }
      if (best) found.remedies.push_back(*best);
    }
  }

  void find_neighbour(std::int64_t cell, DelayExplanation& found) {
    const UniformGrid& grid = posts_.grid();
    std::int64_t nearest = INT64_MAX;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      for (const std::int64_t step : {-1, 1}) {
        const std::int64_t index = grid.index(cell, i);
        const std::int64_t most = step < 0 ? index : grid[i].count - 1 - index;
        std::int64_t k = 1;
        while (k <= most && delay_at(cell + k * step * grid.stride(i)) <= found.delay) ++k;
        if (k > most || k >= nearest) continue;
        const std::int64_t other = cell + k * step * grid.stride(i);
        if (is_terminal(other)) continue;  // no choices there
        const std::int64_t alone = choices(controller_.actions(partition_, other));
        if (alone >= found.alone) continue;
        nearest = k;
        found.freer_is_shorter = {.cell = other, .delay = delay_at(other), .alone = alone};
      }
    }
  }

  const ResultsReader& results_;
  std::size_t partition_;
  FileSets sets_;
  CellController controller_;
  CellPosts posts_;
  std::vector<InputClass> classes_;
  std::map<std::vector<IndexRange>, std::int32_t> known_;
};

}  // namespace

MemoryDemand explain_demand(const ResultsReader& results, std::size_t partition, std::int64_t cell) {
  constexpr double kBytesOfNumber = 1100;  // of a step of a counterexample, as it is found and written
  MemoryDemand demand = controller_demand(results, false);
  // Neighbours may be so many that all posts are computed once more.
  demand.once += FileSets::bytes(results) + abstraction_bytes(results);
  const auto numbers = static_cast<double>(results.grid().size() + results.inputs().size() + 2);
  for (const char* const path : {paths::kDelay, paths::kSilence}) {
    if (!results.has(path)) continue;
    const std::int32_t steps = results.values(path, partition, one_cell(results.grid(), cell)).front();
    if (steps > 0 && steps != kUnbounded) demand.once += kBytesOfNumber * numbers * steps;
  }
  return demand;
}

DelayExplanation explain_delay(const ResultsReader& results, std::size_t partition, std::int64_t cell,
                               const std::vector<Rational>& state, ThreadTeam& team) {
  return Explainer(results, partition, team).run(cell, state);
}

}  // namespace coordreq
