#include "answers/counterexample/path_run.hpp"

#include <algorithm>

#include "spec/problem_spec.hpp"

namespace coordreq {

AdmissibleInputs::Sets PathRun::members() {
  AdmissibleInputs::Sets sets{.invariant = &invariant_, .safe = &safe_, .safe_beyond = {}, .listed = {}};
  if (tubes_.beyond != nullptr) sets.safe_beyond = [this] { return &beyond_; };
  if (context_.listed) {
    sets.listed = [this](std::int64_t cell, std::int64_t u) {
      return context_.listed->pairs.test(steps_.number_of(cell), u);
    };
  }
  return sets;
}

bool PathRun::add_step() {
  const std::int64_t cell = path_.cells.back();
  while (phase_ < problem_.phases.size() && !problem_.phases[phase_].holds(cell)) ++phase_;
  if (phase_ == problem_.phases.size()) return false;
  const CounterexamplePhase& phase = problem_.phases[phase_];
  if (phase.choices == PathPhase::together) return take_together();
  if (phase.choices == PathPhase::approaching && phase.steps(cell) <= 1) {
    lose_time();
    return false;
  }
  return take_by(phase);
}

/// What classes can choose in a phase; null: all agents choose together.
const ClassChoices* PathRun::choices_at(std::int64_t cell, PathPhase phase) {
  using Rules = ClassChoices::Rules;
  if (phase == PathPhase::evasive) return nullptr;
  const Rules rules = phase == PathPhase::silent       ? Rules::actions
                      : phase == PathPhase::afterwards ? Rules::then
                                                       : Rules::none;
  std::optional<ClassChoices>& choices = choices_.at(static_cast<std::size_t>(rules));
  if (!choices) choices.emplace(context_.spec, grid_, posts_.inputs(), problem_.partition->classes, rules);
  const bool is_known = rules != Rules::then && problem_.invariant(cell);
  ClassChoices::Numbers joint = is_known ? inputs_.of(cell) : ClassChoices::Numbers();
  if (phase == PathPhase::approaching) joint = progress_.of(cell, joint);
  choices->go_to(cell, joint);
  return &*choices;
}

/// One step after which one less is left. @returns whether to go on
bool PathRun::take_by(const CounterexamplePhase& phase) {
  const std::int64_t cell = path_.cells.back();
  const bool is_first = path_.cells.size() == 1;
  if (!is_first && phase.has_no_action && phase.has_no_action(cell)) {
    path_.end = PathEnd::no_common_action;
    return false;
  }
  const ClassChoices* const choices = choices_at(cell, phase.choices);
  const bool is_ruled = phase.choices == PathPhase::silent || phase.choices == PathPhase::afterwards;
  if (is_ruled && choices->is_empty()) {
    path_.end = PathEnd::no_silent_action;
    return false;
  }
  const auto is_choice = [&](std::int64_t u) {
    return choices == nullptr ? inputs_.allows(cell, u) : choices->has(u);
  };
  const std::int64_t left = is_first && phase.first ? phase.first(cell) : phase.steps(cell);
  const bool is_last = left == 1 && phase.after;
  const StepsFrom& steps = is_last ? phase.after : phase.steps;
  return take(steps_.find(cell, steps, is_last ? StepFinder::kLeast : left - 1, is_choice, number_), steps,
              phase.choices);
}

/// How soon the world shows the arrival of a lasting goal after u from the present cell: the less, the
/// sooner.
std::int64_t PathRun::soonest(std::int64_t u, std::int32_t worst) {
  if (progress_.leaves_through_safe_side(u)) return -1;
  const CellPost post = posts_.post(u, tubes_);
  std::int64_t least = INT64_MAX;
  if (post.all_left) return least;
  for_each_cell(grid_, post.box, [&](std::int64_t y) {
    if (problem_.arrival(y) == worst) least = std::min(least, problem_.showing_order(y));
    return true;
  });
  return least;
}

/// The choice of agents who want to arrive soonest, or where they have none what the world chooses for them:
/// (worst arrival, joint input).
std::pair<std::int32_t, std::int64_t> PathRun::choose_together(std::int64_t cell) {
  const bool is_given = context_.spec.controller.synthesis == Synthesis::given;
  std::optional<std::pair<std::int32_t, std::int64_t>> best;
  std::vector<std::int64_t> equal;
  for (const std::int64_t u : inputs_.of(cell)) {
    const std::int32_t worst = progress_.worst(cell, u);
    if (best && worst == best->first) equal.push_back(u);
    if (best && (is_given ? worst <= best->first : worst >= best->first)) continue;
    best = {worst, u};
    equal = {u};
  }
  if (!is_given || !problem_.showing_order) return *best;
  std::int64_t least = INT64_MAX;
  for (const std::int64_t u : equal) {
    const std::int64_t order = soonest(u, best->first);
    if (order < least) best->second = u;
    least = std::min(least, order);
  }
  return *best;
}

/// One step of all agents together to the goal, as badly as it can turn out. @returns whether to go on
bool PathRun::take_together() {
  const std::int64_t cell = path_.cells.back();
  if (problem_.arrival(cell) == 0) {
    path_.end = PathEnd::arrived;
    return false;
  }
  const auto [worst, u] = choose_together(cell);
  add_choice(u, PathPhase::together);
  path_.end = worst == INT32_MAX ? PathEnd::never_arrives : PathEnd::arrived;
  posts_.move_to(cell);
  const CellPost post = posts_.post(u, tubes_);
  const bool is_lasting = problem_.showing_order != nullptr;
  const std::int64_t first = is_lasting ? soonest(u, worst) : 0;
  if (first < 0) return false;  // to T through a `safe` side
  const std::int64_t next = steps_.next_cell(cell, post, u, [&, worst = worst](std::int64_t y) {
    return problem_.arrival(y) == worst && (!is_lasting || problem_.showing_order(y) == first);
  });
  if (next < 0) return false;  // the post has left the domain
  const bool comes_again = std::find(path_.cells.begin(), path_.cells.end(), next) != path_.cells.end();
  path_.cells.push_back(next);
  return !comes_again;
}

/// The last step of agents who act alone before the goal: one without progress.
void PathRun::lose_time() {
  const std::int64_t cell = path_.cells.back();
  const ClassChoices* const choices = choices_at(cell, PathPhase::approaching);
  const std::int32_t most = progress_.limit(cell, inputs_.of(cell));
  posts_.move_to(cell);
  for (std::int64_t u = 0; u < posts_.inputs().count(); ++u) {
    if (!choices->has(u)) continue;
    const bool is_forbidden = inputs_.forbids(cell, u);
    const CellPost post = posts_.post(u, tubes_);
    const bool is_blocked = is_forbidden || post.blocked != CellPost::Blocked::no;
    if (!is_blocked && progress_.worst(cell, u) <= most) continue;
    add_choice(u, PathPhase::approaching);
    if (is_blocked) return end_at_block(post, is_forbidden);
    path_.end = PathEnd::time_lost;
    const std::int64_t next = steps_.next_cell(cell, post, u, [&](std::int64_t y) {
      const std::int32_t arrival = problem_.arrival(y);
      return arrival < 0 || arrival > most;
    });
    if (next >= 0) path_.cells.push_back(next);
    return;
  }
}

void PathRun::add_choice(std::int64_t u, PathPhase phase) {
  path_.joint_inputs.push_back(u);
  path_.phases.push_back(phase);
}

void PathRun::end_at_block(const CellPost& post, bool is_forbidden) {
  path_.end = PathEnd::not_allowed;
  if (is_forbidden) return;
  const bool left = post.blocked == CellPost::Blocked::left_domain;
  path_.end = left ? PathEnd::left_domain : PathEnd::unsafe_between_samples;
  path_.sides = post.sides;
}

/// Adds a step to the path. @returns false if the path ends with it
bool PathRun::take(const std::optional<StepChoice>& choice, const StepsFrom& steps, PathPhase phase) {
  if (!choice) {
    path_.end = PathEnd::no_allowed_action;
    return false;
  }
  add_choice(choice->joint_input, phase);
  last_.has_more = choice->has_more;
  if (choice->is_forbidden || choice->post.blocked != CellPost::Blocked::no) {
    end_at_block(choice->post, choice->is_forbidden);
    return false;
  }
  path_.cells.push_back(steps_.next_cell(path_.cells.back(), choice->post, choice->joint_input,
                                         [&](std::int64_t y) { return steps(y) == choice->steps; }));
  return true;
}

}  // namespace coordreq
