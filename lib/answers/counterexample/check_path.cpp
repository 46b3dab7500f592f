#include "answers/counterexample/check_path.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

PathChecker::PathChecker(const CheckContext& context, const RequirementSpec& requirement)
    : context_(context),
      requirement_(requirement),
      value_of_(*context.claims, *context.spec, requirement),
      invariant_(context.claims->members("/invariant")),
      collision_time_(context.claims->values("/collision_time")),
      cell_(context) {
  if (requirement.kind == RequirementKind::max_arrival ||
      requirement.kind == RequirementKind::min_approach_delay)
    progress_.emplace(context);
  if (progress_ && context.spec->is_goal_lasting()) {
    goal_memory_.emplace(*context.spec->goal, *context.grid);
    goal_.emplace(*context.spec, *context.spec->goal, *context.grid, *goal_memory_);
  }
  if (!requirement.partition) return;
  partition_ = static_cast<std::size_t>(*requirement.partition);
  const auto& classes = context.spec->coordination.partitions[*partition_].classes;
  choices_.emplace(context, classes);
  if (requirement.kind != RequirementKind::min_silence) return;
  silent_.emplace(context, classes, ClassChoices::Rules::actions);
  if (context.spec->silence->has_then()) afterwards_.emplace(context, classes, ClassChoices::Rules::then);
}

void PathChecker::wrong(std::size_t number, const std::string& what) {
  tally_->add_wrong(static_cast<std::int64_t>(number),
                    [&] { return fmt::format("step {} of the counterexample: {}", number, what); });
}

void PathChecker::differs(std::size_t number, const std::string& what) {
  if (context_.sound_only()) {
    tally_->add_unproven();
  } else {
    wrong(number, what);
  }
}

void PathChecker::check(const ResultPath& path, Tally& tally) {
  path_ = &path;
  tally_ = &tally;
  tally.add_checked(static_cast<std::int64_t>(path.samples() + path.steps()));
  for (std::size_t s = 0; s < path.samples(); ++s) check_sample(s);
  for (std::size_t s = 0; s < path.steps(); ++s) check_step(s);
  check_end();
}

void PathChecker::check_sample(std::size_t sample) {
  const auto cell = static_cast<std::int64_t>(path_->cell[sample]);
  const UniformGrid& grid = *context_.grid;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (path_->state[sample * grid.size() + i] != nearest_double(grid[i].point(grid.index(cell, i))))
      wrong(sample, "the state is not the centre of the cell");
  }
  if (path_->delay[sample] != value_of_(at(cell))) wrong(sample, "the delay is not that of the cell");
  if (path_->collision_time[sample] != collision_time_[at(cell)])
    wrong(sample, "the collision time is not that of the cell");
}

/// The joint input with the values of a step.
std::optional<std::int64_t> PathChecker::input_of(std::size_t step) const {
  const InputSpace& inputs = *context_.inputs;
  std::int64_t u = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double value = path_->input[step * inputs.size() + i];
    const auto& values = inputs[i].values;
    const auto found = std::find_if(values.begin(), values.end(), [value](const Rational& candidate) {
      return nearest_double(candidate) == value;
    });
    if (found == values.end()) return std::nullopt;
    u += (found - values.begin()) * inputs.stride(i);
  }
  return u;
}

void PathChecker::check_step(std::size_t step) {
  cell_.go_to(static_cast<std::int64_t>(path_->cell[step]));
  const std::optional<std::int64_t> u = input_of(step);
  if (!u) return wrong(step, "not a joint input of the spec");
  if (path_->phase[step] != phase_of(step)) return wrong(step, "another phase than that of the cell");
  if (!cell_.is_safe()) return wrong(step, "continues after it has left the safe set");
  switch (path_->phase[step]) {
    case PathPhase::independent:
      check_independent(step, *u);
      break;
    case PathPhase::evasive:
      check_evasive(step, *u);
      break;
    case PathPhase::together:
      check_together(step, *u);
      break;
    case PathPhase::approaching:
      check_approaching(step, *u);
      break;
    case PathPhase::silent:
      check_silent(step, *u);
      break;
    case PathPhase::afterwards:
      check_afterwards(step, *u);
  }
  if (step + 1 < path_->samples()) {
    check_next(step, *u);
  } else {
    check_last_step(*u);
  }
}

/// The phase of agents in the present cell. Agents that have reached the goal go on as without a goal.
PathPhase PathChecker::phase_of(std::size_t step) const {
  if (silent_ && value_of_(cell_.at()) >= 0) return PathPhase::silent;
  if (afterwards_) return PathPhase::afterwards;
  if (invariant_[cell_.at()] == 0) return PathPhase::evasive;
  if (!progress_) return PathPhase::independent;
  if (requirement_.kind == RequirementKind::max_arrival) return PathPhase::together;
  const std::int32_t arrival = progress_->arrival(cell_.at());
  if (step == 0 && arrival == kUnbounded) return PathPhase::together;
  const PathPhase before = step == 0 ? PathPhase::approaching : path_->phase[step - 1];
  const bool is_terminal = before == PathPhase::approaching && arrival == 0 && !goal_;
  return is_terminal ? PathPhase::independent : before;
}

void PathChecker::check_together(std::size_t step, std::int64_t u) {
  if (cell_.admitted()[at(u)] == 0) return differs(step, "the joint input is not admissible");
  const std::int32_t arrival = progress_->arrival(cell_.at());
  const std::int32_t expected = arrival == kUnbounded ? kUnbounded
                                : goal_               ? progress_->best(cell_)
                                                      : arrival - 1;
  if (arrival <= 0 || progress_->worst(cell_, u) != expected)
    differs(step, "the joint input does not have the shortest time to the goal");
  if (step + 1 < path_->samples() && progress_->arrival(path_->cell[step + 1]) != expected)
    differs(step, "the next cell is not the one farthest from the goal");
}

void PathChecker::check_approaching(std::size_t step, std::int64_t u) {
  if (!is_choice(u, progress_->of(cell_))) differs(step, "the joint input is not an independent choice");
  const std::int32_t delay = path_->delay[step];
  if (delay > 0) {
    if (step + 1 >= path_->samples() || path_->delay[step + 1] != delay - 1)
      differs(step, fmt::format("leads to another approach delay than {}", delay - 1));
    return;
  }
  const bool stays = step + 1 < path_->samples();
  const std::int32_t next = stays ? progress_->arrival(path_->cell[step + 1]) : kUnbounded;
  if (next >= 0 && next <= progress_->limit(cell_)) differs(step, "no time is lost");
}

void PathChecker::check_independent(std::size_t step, std::int64_t u) {
  if (!partition_) return wrong(step, "begins in the invariance set");
  if (!is_choice(u, cell_.admitted())) differs(step, "the joint input is not an independent choice");
  // Agents who see only themselves know the first cell, and then count down.
  const bool is_blind = requirement_.kind == RequirementKind::min_blind_delay;
  const auto delay_of = [&](std::size_t sample) {
    const char* const path = !is_blind ? "/delay" : sample == 0 ? "/blind_delay" : "/blind_countdown";
    return context_.claims->values(path, *partition_)[path_->cell[sample]];
  };
  const std::int32_t delay = delay_of(step);
  const bool goes_on = step + 1 < path_->samples();
  const std::int32_t next = goes_on ? std::max(delay_of(step + 1), kOutsideInvariant) : kOutsideInvariant;
  if (next != delay - 1) differs(step, fmt::format("leads to delay {}, expected {}", next, delay - 1));
}

void PathChecker::check_evasive(std::size_t step, std::int64_t u) {
  if (!cell_.is_allowed(u)) differs(step, "the joint input is not allowed");
  const std::int32_t expected = path_->collision_time[step] - 1;
  const std::int32_t worst = cell_.least(u, collision_time_, 0);
  if (worst != expected)
    differs(step, fmt::format("leads to collision time {}, expected {}", worst, expected));
  if (step + 1 < path_->samples() && path_->collision_time[step + 1] != expected)
    differs(step, "the next cell is not the worst one");
}

void PathChecker::check_silent(std::size_t step, std::int64_t u) {
  if (!is_permitted(u, *silent_))
    differs(step, "the communication-loss rule does not permit the joint input");
  const std::int32_t delay = path_->delay[step];
  const bool goes_on = step + 1 < path_->samples();
  const std::int32_t next = goes_on ? std::max(path_->delay[step + 1], kOutsideInvariant) : kOutsideInvariant;
  if (next != delay - 1) differs(step, fmt::format("leads to silence {}, expected {}", next, delay - 1));
}

/// Checks a step by `then`; the file does not have the times at which steps leave S.
void PathChecker::check_afterwards(std::size_t step, std::int64_t u) {
  if (!is_permitted(u, *afterwards_)) differs(step, "the fallback rule does not permit the joint input");
  if (step + 1 < path_->samples() && path_->delay[step + 1] >= 0) differs(step, "returns to the silence set");
}

/// Whether in a cell the rules leave agents no action.
bool PathChecker::ends_without_rule(std::size_t cell) {
  if (!silent_) return false;
  const bool is_silent = value_of_(cell) >= 0;
  if (!is_silent && !afterwards_) return false;
  ClassChoices& rules = is_silent ? *silent_ : *afterwards_;
  rules.go_to(cell_.number(), cell_.admitted());
  return rules.is_empty();
}

void PathChecker::check_next(std::size_t step, std::int64_t u) {
  if (cell_.is_forbidden(u)) return differs(step, "continues with a joint input that is forbidden");
  if (is_blocked(u) || !cell_.is_tube_safe(u))
    return differs(step, "continues although no transition is safe");
  if (!is_in_post(u, static_cast<std::int64_t>(path_->cell[step + 1])))
    differs(step, "the next cell is not in the successor set");
}

/// Checks a last action that leads to no cell.
void PathChecker::check_last_step(std::int64_t u) {
  const std::size_t step = path_->steps() - 1;
  if ((path_->end == PathEnd::not_allowed) != cell_.is_forbidden(u))
    return differs(step, cell_.is_forbidden(u) ? "the last joint input is forbidden, but the end is another"
                                               : "the last joint input is not forbidden");
  if (path_->end == PathEnd::not_allowed) return;
  // The end says whether there is an action.
  if (path_->end == PathEnd::no_common_action || path_->end == PathEnd::no_silent_action) return;
  if (path_->end == PathEnd::never_arrives || path_->end == PathEnd::time_lost) {
    if (!progress_ || !progress_->leaves_through_safe_side(cell_, u))
      differs(step, "the last action does not leave through a safe side");
    return;
  }
  if (path_->end >= PathEnd::arrived) return;  // the post has left through a `goal` side
  if (path_->end == PathEnd::unsafe_between_samples) {
    if (is_blocked(u) || cell_.is_tube_safe(u)) differs(step, "the motion to the next sample is safe");
  } else if (path_->end != PathEnd::left_domain || !path_->left_side) {
    wrong(step, "the last action leads nowhere, but the end is another");
  } else if (!leaves_domain(u, *path_->left_side)) {
    differs(step, "the last action does not lead out of the domain there");
  }
}

void PathChecker::check_end() {
  const bool stays = path_->samples() > path_->steps();
  const auto last = static_cast<std::int64_t>(path_->cell.back());
  cell_.go_to(last);
  const bool safe = cell_.is_safe();
  if (path_->end == PathEnd::outside_safe_set) {
    if (!stays || safe) wrong(path_->samples(), "the last cell is in the safe set");
  } else if (path_->end == PathEnd::no_allowed_action) {
    bool any = false;
    for (std::int64_t u = 0; safe && u < context_.inputs->count() && !any; ++u) any = cell_.is_allowed(u);
    if (!stays || !safe || any) wrong(path_->samples(), "in the last cell some joint input is allowed");
  } else if (path_->end == PathEnd::too_risky || requirement_.kind == RequirementKind::max_risk) {
    const bool is_alone = path_->samples() == 1 && path_->steps() == 0;
    if (!is_alone || path_->end != PathEnd::too_risky || requirement_.kind != RequirementKind::max_risk)
      wrong(path_->samples(), "a risk is that of one cell");
  } else if (path_->end == PathEnd::no_common_action) {
    if (!stays || path_->steps() == 0 || !ends_in_sight(static_cast<std::size_t>(last)))
      wrong(path_->samples(), "in the last cell all classes may have an action");
  } else if (path_->end == PathEnd::no_silent_action) {
    if (!stays || !safe || !ends_without_rule(static_cast<std::size_t>(last)))
      wrong(path_->samples(), "in the last cell agents may have an action");
  } else if (path_->end >= PathEnd::arrived && path_->end != PathEnd::not_allowed) {
    check_goal_end();
  } else if (stays) {
    wrong(path_->samples(), "the end is another");
  }
  if (path_->left_side.has_value() != (path_->end == PathEnd::left_domain))
    wrong(path_->samples(), "a side that belongs to another end");
}

/// Whether a class has no action for all cells that it may be in, though agents who see everything would have
/// one.
bool PathChecker::ends_in_sight(std::size_t cell) const {
  return requirement_.kind == RequirementKind::min_blind_delay &&
         context_.claims->values("/blind_countdown", *partition_)[cell] == 0 &&
         context_.claims->values("/delay", *partition_)[cell] >= 1;
}

void PathChecker::check_goal_end() {
  const bool stays = path_->samples() > path_->steps();
  const bool before_goal = !path_->phase.empty() && path_->phase.back() >= PathPhase::together;
  if (!progress_ || !before_goal)
    return wrong(path_->samples(), "an end of a path to the goal, which it is not");
  const auto last = path_->cell.end() - 1;
  if (path_->end == PathEnd::arrived && stays && progress_->arrival(*last) != 0)
    wrong(path_->samples(), "the last cell is not in the goal");
  if (path_->end == PathEnd::never_arrives && stays) {
    const auto first = std::find(path_->cell.begin(), last, *last);
    if (first == last) wrong(path_->samples(), "the last cell does not repeat");
    if (first != last && goal_) check_cycle(static_cast<std::size_t>(first - path_->cell.begin()));
  }
  if (path_->end == PathEnd::time_lost && path_->phase.back() != PathPhase::approaching)
    wrong(path_->samples(), "only independent choices can lose time");
}

/// Whether the samples from this one on, which the last one repeats, show that the goal cannot be kept, or is
/// not visited again.
void PathChecker::check_cycle(std::size_t begin) {
  bool some_inside = false, some_outside = false, some_open = false;
  for (std::size_t s = begin; s + 1 < path_->samples(); ++s) {
    const SafeVerdict verdict = goal_->judge(static_cast<std::int64_t>(path_->cell[s]), true);
    some_inside = some_inside || verdict == SafeVerdict::safe;
    some_outside = some_outside || verdict == SafeVerdict::unsafe;
    some_open = some_open || (verdict != SafeVerdict::safe && verdict != SafeVerdict::unsafe);
  }
  const bool is_stay = context_.spec->goal_then == GoalThen::stay;
  if (is_stay ? some_outside : !some_inside && !some_open) return;
  const bool is_open = is_stay ? some_open : !some_inside;
  if (is_open) return tally_->add_unproven();
  wrong(path_->samples(), is_stay ? "the cells that repeat are in the goal" : "the goal is visited again");
}

bool PathChecker::is_choice(std::int64_t u, const std::vector<std::uint8_t>& joint) {
  choices_->go_to(cell_.number(), joint);
  return choices_->has(u);
}

bool PathChecker::is_permitted(std::int64_t u, ClassChoices& rules) const {
  rules.go_to(cell_.number(), cell_.admitted());
  return rules.has(u);
}

std::size_t PathChecker::entry(const Posts& posts, std::size_t i, std::int64_t u) const {
  return posts.tables[i]->entry_of(*context_.grid, cell_.number()) + at(posts.input_offset[i][at(u)]);
}

const ResolvedRange& PathChecker::range(std::size_t i, std::int64_t u) const {
  return context_.posts->resolved[i][entry(*context_.posts, i, u)];
}

bool PathChecker::is_blocked(std::int64_t u) const {
  for (std::size_t i = 0; i < context_.grid->size(); ++i) {
    if (range(i, u).blocked) return true;
  }
  return false;
}

bool PathChecker::is_in_post(std::int64_t u, std::int64_t next) const {
  for (std::size_t i = 0; i < context_.grid->size(); ++i) {
    const IndexRange inside = range(i, u).inside;
    const std::int64_t k = context_.grid->index(next, i);
    const std::int64_t again = k + (*context_.grid)[i].count;
    const bool holds = (inside.first <= k && k <= inside.last) ||
                       ((*context_.grid)[i].periodic() && inside.first <= again && again <= inside.last);
    if (!holds) return false;
  }
  return true;
}

/// Whether u leads out through a side, at the sample or, if tubes count, before it.
bool PathChecker::leaves_domain(std::int64_t u, const ResultSide& side) const {
  const GridDimension& dimension = (*context_.grid)[side.state];
  if ((side.above ? dimension.above : dimension.below) != Outside::unsafe) return false;
  const auto passes = [&](IndexRange raw) {
    return side.above ? raw.last >= dimension.count : raw.first < 0;
  };
  const auto raw_of = [&](const Posts& posts) {
    return posts.tables[side.state]->entries[entry(posts, side.state, u)];
  };
  return passes(raw_of(*context_.posts)) ||
         (context_.tubes != nullptr && passes(raw_of(context_.tubes->covering)));
}

}  // namespace coordreq
