#include "answers/requirements/check_path.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/checking/claimed_values.hpp"
#include "base/index.hpp"

namespace coordreq {

PathChecker::PathChecker(const CheckGround& ground, std::optional<std::size_t> partition)
    : ground_(ground), partition_(partition), cell_(ground) {
  if (!partition) return;
  for (const auto& agents : ground.spec->coordination.partitions[*partition].classes)
    classes_.emplace_back(class_of(*ground.spec, *ground.inputs, agents)).tabulate();
}

void PathChecker::wrong(std::size_t number, const std::string& what) {
  tally_->add_wrong(static_cast<std::int64_t>(number),
                    [&] { return fmt::format("step {} of the counterexample: {}", number, what); });
}

void PathChecker::differs(std::size_t number, const std::string& what) {
  if (ground_.sound_only()) {
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
  const UniformGrid& grid = *ground_.grid;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (path_->state[sample * grid.size() + i] != nearest_double(grid[i].point(grid.index(cell, i))))
      wrong(sample, "the state is not the centre of the cell");
  }
  if (path_->delay[sample] != claimed_delay(*ground_.claims, partition_, at(cell)))
    wrong(sample, "the delay is not that of the cell");
  if (path_->collision_time[sample] != ground_.claims->collision_time[at(cell)])
    wrong(sample, "the collision time is not that of the cell");
}

/// The joint input with the values of a step.
std::optional<std::int64_t> PathChecker::input_of(std::size_t step) const {
  const InputSpace& inputs = *ground_.inputs;
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
  const bool in_invariant = ground_.claims->invariant[cell_.at()] != 0;
  if (!u) return wrong(step, "not a joint input of the spec");
  if (in_invariant != (path_->phase[step] == EscapePhase::independent))
    return wrong(step, "another phase than that of the cell");
  if (!cell_.is_safe()) return wrong(step, "goes on after it has left the safe set");
  if (in_invariant) {
    check_independent(step, *u);
  } else {
    check_evasive(step, *u);
  }
  if (step + 1 < path_->samples()) {
    check_next(step, *u);
  } else {
    check_last_step(*u);
  }
}

void PathChecker::check_independent(std::size_t step, std::int64_t u) {
  if (!partition_) return wrong(step, "begins in the invariance set");
  if (!is_choice(u)) differs(step, "the joint input is not an independent choice");
  const std::int32_t delay = path_->delay[step];
  const bool goes_on = step + 1 < path_->samples();
  const std::int32_t next = goes_on ? std::max(path_->delay[step + 1], kOutsideInvariant) : kOutsideInvariant;
  if (next != delay - 1) differs(step, fmt::format("leads to delay {}, expected {}", next, delay - 1));
}

void PathChecker::check_evasive(std::size_t step, std::int64_t u) {
  if (!cell_.is_allowed(u)) differs(step, "the joint input is not allowed");
  const std::int32_t expected = path_->collision_time[step] - 1;
  const std::int32_t worst = cell_.least(u, ground_.claims->collision_time, 0);
  if (worst != expected)
    differs(step, fmt::format("leads to collision time {}, expected {}", worst, expected));
  if (step + 1 < path_->samples() && path_->collision_time[step + 1] != expected)
    differs(step, "the next cell is not the worst one");
}

void PathChecker::check_next(std::size_t step, std::int64_t u) {
  if (is_blocked(u) || !cell_.is_way_safe(u)) return differs(step, "goes on where there is no post");
  if (!is_in_post(u, static_cast<std::int64_t>(path_->cell[step + 1])))
    differs(step, "the next cell is not in the post");
}

/// The last action leads nowhere.
void PathChecker::check_last_step(std::int64_t u) {
  const std::size_t step = path_->steps() - 1;
  if (path_->end == EscapeEnd::unsafe_between_samples) {
    if (is_blocked(u) || cell_.is_way_safe(u)) differs(step, "the way to the next sample is safe");
  } else if (path_->end != EscapeEnd::left_domain || !path_->left_side) {
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
  if (path_->end == EscapeEnd::outside_safe_set) {
    if (!stays || safe) wrong(path_->samples(), "the last cell is in the safe set");
  } else if (path_->end == EscapeEnd::no_allowed_action) {
    bool any = false;
    for (std::int64_t u = 0; safe && u < ground_.inputs->count() && !any; ++u) any = cell_.is_allowed(u);
    if (!stays || !safe || any) wrong(path_->samples(), "in the last cell something is allowed");
  } else if (stays) {
    wrong(path_->samples(), "the end is another");
  }
  if (path_->left_side.has_value() != (path_->end == EscapeEnd::left_domain))
    wrong(path_->samples(), "a side that belongs to another end");
}

/// Whether each class's part of u is part of some joint input in C(x).
bool PathChecker::is_choice(std::int64_t u) const {
  return std::all_of(classes_.begin(), classes_.end(), [&](const InputClass& own) {
    for (std::size_t v = 0; v < cell_.admitted().size(); ++v) {
      if (cell_.admitted()[v] != 0 && own.action(static_cast<std::int64_t>(v)) == own.action(u)) return true;
    }
    return false;
  });
}

std::size_t PathChecker::entry(const Posts& posts, std::size_t i, std::int64_t u) const {
  return posts.tables[i]->entry_of(*ground_.grid, cell_.number()) + at(posts.input_part[i][at(u)]);
}

const ResolvedRange& PathChecker::range(std::size_t i, std::int64_t u) const {
  return ground_.posts->resolved[i][entry(*ground_.posts, i, u)];
}

bool PathChecker::is_blocked(std::int64_t u) const {
  for (std::size_t i = 0; i < ground_.grid->size(); ++i) {
    if (range(i, u).blocked) return true;
  }
  return false;
}

bool PathChecker::is_in_post(std::int64_t u, std::int64_t next) const {
  for (std::size_t i = 0; i < ground_.grid->size(); ++i) {
    const IndexRange inside = range(i, u).inside;
    const std::int64_t k = ground_.grid->index(next, i);
    const std::int64_t again = k + (*ground_.grid)[i].count;
    const bool holds = (inside.first <= k && k <= inside.last) ||
                       ((*ground_.grid)[i].periodic() && inside.first <= again && again <= inside.last);
    if (!holds) return false;
  }
  return true;
}

/// At the sample, or on the way where that counts.
bool PathChecker::leaves_domain(std::int64_t u, const ResultSide& side) const {
  const GridDimension& dimension = (*ground_.grid)[side.state];
  if ((side.above ? dimension.above : dimension.below) != Outside::unsafe) return false;
  const auto passes = [&](IndexRange raw) {
    return side.above ? raw.last >= dimension.count : raw.first < 0;
  };
  const auto raw_of = [&](const Posts& posts) {
    return posts.tables[side.state]->entries[entry(posts, side.state, u)];
  };
  return passes(raw_of(*ground_.posts)) ||
         (ground_.tubes != nullptr && passes(raw_of(ground_.tubes->covering)));
}

}  // namespace coordreq
