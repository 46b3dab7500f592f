#include "answers/requirements/escape_run.hpp"

#include "answers/requirements/escape_step.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

EscapeRun::EscapeRun(const EscapeSets& sets)
    : sets_(sets),
      context_(*sets.context),
      collision_time_(sets.invariance->collision_time),
      tubes_(context_.tubes()),
      posts_(*context_.abstraction),
      real_(context_.spec, *context_.abstraction) {}

void EscapeRun::begin_at(std::int64_t cell, const std::optional<std::vector<Rational>>& start) {
  if (start) {
    real_.start(*start);
  } else {
    real_.start(cell);
  }
}

void EscapeRun::begin_way(std::int64_t cell) {
  path_ = {};
  path_.cells.push_back(cell);
  way_ = Way::unknown;
  goes_on_ = true;
}

std::optional<FollowedPlace> EscapeRun::place() const {
  if (!goes_on_ || !real_.is_followed()) return std::nullopt;
  return FollowedPlace{path_.cells.back(), static_cast<std::int64_t>(way_), real_.state(),
                       path_.joint_inputs.size()};
}

void EscapeRun::go_to(const FollowedPlace& place) {
  path_.joint_inputs.resize(place.steps);
  path_.phases.resize(place.steps);
  path_.cells.resize(place.steps + 1);
  path_.sides.clear();
  path_.end = EscapeEnd::outside_safe_set;
  path_.followed = static_cast<std::int64_t>(place.steps);
  way_ = static_cast<Way>(place.way);
  real_.start(place.state);
  goes_on_ = true;
}

std::int64_t EscapeRun::step(std::int64_t number) {
  const std::size_t steps = path_.joint_inputs.size();
  step_alone(number);
  if (real_.is_followed() && path_.joint_inputs.size() > steps) {
    advance();
    if (path_.cells.back() != reached_.place.cell) real_.stop();
    if (real_.is_followed()) ++path_.followed;
  }
  return posts_.inputs().count();
}

bool EscapeRun::is_whole() const {
  const std::size_t steps = path_.joint_inputs.size();
  const std::size_t nowhere = path_.cells.size() == steps ? 1 : 0;
  return !goes_on_ && static_cast<std::size_t>(path_.followed) + nowhere == steps;
}

bool EscapeRun::step_alone(std::int64_t number) {
  number_ = number;
  return goes_on_ = step_of_owner();
}

/// Whether the cell is in K, or for silence in K'.
bool EscapeRun::is_inside(std::int64_t cell) const {
  return sets_.silence_of == nullptr ? sets_.invariance->invariant.test(cell)
                                     : EscapeSteps::level_of(*sets_.silence_of, cell) > 0;
}

/// Takes a step of the way, and finds where it leads the system itself. @returns whether the way goes on
bool EscapeRun::step_and_look() {
  const std::int64_t cell = path_.cells.back();
  const std::size_t steps = path_.joint_inputs.size();
  has_more_ = false;
  const bool goes_on = add_step();
  reached_ = {};
  if (!real_.is_followed() || path_.joint_inputs.size() == steps) return goes_on;
  reached_.place = real_.after(cell, path_.joint_inputs.back());
  const bool is_cell = reached_.place.kind == Location::Kind::cell;
  posts_.move_to(cell);
  const CellPost post = posts_.post(path_.joint_inputs.back(), tubes_);
  if (is_cell && !EscapeSteps::holds(posts_.grid(), post, reached_.place.cell)) {
    reached_ = {};  // the levels of its cell may not be known
    return goes_on;
  }
  const bool has_left = reached_.place.kind == Location::Kind::left_safely;
  reached_.is_safe = is_cell ? EscapeSteps::level_of(collision_time_, reached_.place.cell) > 0 : has_left;
  reached_.is_inside = is_cell ? is_inside(reached_.place.cell) : has_left;
  return goes_on;
}

/// Takes the step from the last cell, which the owner of the cell finds for all processes.
bool EscapeRun::step_of_owner() {
  const RowShare* const share = context_.shared_rows();
  if (share == nullptr) return step_and_look();
  Ranks& ranks = share->ranks();
  const int owner = share->owner(path_.cells.back() / posts_.grid().row_length());
  if (owner != ranks.rank()) {
    const EscapeProgress progress = read_escape_message(ranks.receive(owner), path_);
    way_ = static_cast<Way>(progress.way);
    reached_ = progress.reached;
    has_more_ = progress.has_more;
    return progress.goes_on;
  }
  const std::size_t cells = path_.cells.size(), inputs = path_.joint_inputs.size();
  const bool goes_on = step_and_look();
  const EscapeProgress progress{
      .goes_on = goes_on, .has_more = has_more_, .way = static_cast<std::int64_t>(way_), .reached = reached_};
  const Bytes message = escape_message(progress, path_, inputs, cells);
  for (int other = 0; other < ranks.count(); ++other) {
    if (other != owner) ranks.send(other, message);
  }
  return goes_on;
}

}  // namespace coordreq
