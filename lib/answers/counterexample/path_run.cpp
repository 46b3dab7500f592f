#include "answers/counterexample/path_run.hpp"

#include "ranks/ranks.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

PathRun::PathRun(const CounterexampleProblem& problem)
    : problem_(problem),
      context_(*problem.context),
      grid_(context_.abstraction->grid),
      tubes_(context_.tubes()),
      posts_(*context_.abstraction),
      real_(context_.spec, *context_.abstraction),
      invariant_(grid_, problem.invariant),
      safe_(grid_, [this](std::int64_t cell) { return tubes_.inside->test(cell); }),
      beyond_(grid_, [this](std::int64_t cell) { return tubes_.beyond->test(cell); }),
      inputs_(context_.spec, posts_, members()),
      progress_(context_.spec, posts_, problem.arrival),
      steps_(problem, posts_, inputs_, real_) {}

void PathRun::start_at(std::int64_t cell, const std::optional<std::vector<Rational>>& start) {
  if (start) {
    real_.start(*start);
  } else {
    real_.start(cell);
  }
}

void PathRun::begin_path(std::int64_t cell) {
  path_ = {};
  path_.cells.push_back(cell);
  phase_ = 0;
  last_.goes_on = true;
}

std::optional<FollowedState> PathRun::position() const {
  if (!goes_on() || !real_.is_followed()) return std::nullopt;
  return FollowedState{path_.cells.back(), phase_, real_.state(), path_.joint_inputs.size()};
}

void PathRun::go_to(const FollowedState& position) {
  path_.joint_inputs.resize(position.steps);
  path_.phases.resize(position.steps);
  path_.cells.resize(position.steps + 1);
  path_.sides.clear();
  path_.end = PathEnd::outside_safe_set;
  path_.followed = static_cast<std::int64_t>(position.steps);
  phase_ = position.phase;
  real_.start(position.state);
  last_.goes_on = true;
}

std::int64_t PathRun::step(std::int64_t number) {
  const std::size_t steps = path_.joint_inputs.size();
  step_alone(number);
  if (real_.is_followed() && path_.joint_inputs.size() > steps) {
    advance();
    if (path_.cells.back() != reached().successor.cell) real_.stop();
    if (real_.is_followed()) ++path_.followed;
  }
  return posts_.inputs().count();
}

bool PathRun::is_whole() const {
  const std::size_t steps = path_.joint_inputs.size();
  const std::size_t nowhere = path_.cells.size() == steps ? 1 : 0;
  return !goes_on() && static_cast<std::size_t>(path_.followed) + nowhere == steps;
}

/// Takes a step, and finds where it leads the system itself.
void PathRun::step_here() {
  const std::int64_t cell = path_.cells.back();
  const std::size_t steps = path_.joint_inputs.size();
  last_ = {};
  last_.goes_on = add_step();
  if (!real_.is_followed() || path_.joint_inputs.size() == steps) return;
  Reached& reached = last_.reached;
  reached.successor = real_.after(cell, path_.joint_inputs.back());
  const bool is_cell = reached.successor.kind == Location::Kind::cell;
  posts_.move_to(cell);
  const CellPost post = posts_.post(path_.joint_inputs.back(), tubes_);
  if (is_cell && !StepFinder::holds(posts_.grid(), post, reached.successor.cell)) {
    reached = {};  // the steps from its cell may not be known
    return;
  }
  const bool has_left = reached.successor.kind == Location::Kind::left_safely;
  reached.is_safe = is_cell ? problem_.collision_time(reached.successor.cell) > 0 : has_left;
  if (problem_.inside) reached.is_inside = is_cell ? problem_.inside(reached.successor.cell) : has_left;
}

/// Takes a step, which the owner of the last cell finds for all processes.
void PathRun::step_alone(std::int64_t number) {
  number_ = number;
  const RowShare* const share = context_.shared_rows();
  if (share == nullptr) return step_here();
  Ranks& ranks = share->ranks();
  const int owner = share->owner(path_.cells.back() / posts_.grid().row_length());
  if (owner != ranks.rank()) return read(ranks.receive(owner));
  const std::size_t cells = path_.cells.size(), inputs = path_.joint_inputs.size();
  step_here();
  const Bytes message = last_step(inputs, cells);
  for (int other = 0; other < ranks.count(); ++other) {
    if (other != owner) ranks.send(other, message);
  }
}

/// The last step, for the other processes. @param inputs, cells numbers of joint inputs and cells of the path
/// before it
Bytes PathRun::last_step(std::size_t inputs, std::size_t cells) const {
  const bool has_step = path_.joint_inputs.size() > inputs;
  const Reached& reached = last_.reached;
  std::vector<std::int64_t> numbers = {last_.goes_on ? 1 : 0,
                                       last_.has_more ? 1 : 0,
                                       static_cast<std::int64_t>(phase_),
                                       reached.successor.is_known ? 1 : 0,
                                       static_cast<std::int64_t>(reached.successor.kind),
                                       reached.successor.cell,
                                       reached.is_inside ? 1 : 0,
                                       reached.is_safe ? 1 : 0,
                                       static_cast<std::int64_t>(path_.end),
                                       has_step ? path_.joint_inputs.back() : -1,
                                       has_step ? static_cast<std::int64_t>(path_.phases.back()) : -1,
                                       path_.cells.size() > cells ? path_.cells.back() : -1};
  for (const DomainSide& side : path_.sides)
    numbers.insert(numbers.end(), {static_cast<std::int64_t>(side.dimension), side.above ? 1 : 0});
  Bytes result;
  put_numbers<std::int64_t>(result, numbers);
  return result;
}

/// Adds the step of another process to the path.
void PathRun::read(const Bytes& message) {
  MessageReader reader(message);
  last_.goes_on = reader.number() != 0;
  last_.has_more = reader.number() != 0;
  phase_ = static_cast<std::size_t>(reader.number());
  Reached& reached = last_.reached;
  reached.successor.is_known = reader.number() != 0;
  reached.successor.kind = static_cast<Location::Kind>(reader.number());
  reached.successor.cell = reader.number();
  reached.is_inside = reader.number() != 0;
  reached.is_safe = reader.number() != 0;
  path_.end = static_cast<PathEnd>(reader.number());
  const std::int64_t input = reader.number(), phase = reader.number(), cell = reader.number();
  if (input >= 0) path_.joint_inputs.push_back(input);
  if (input >= 0) path_.phases.push_back(static_cast<PathPhase>(phase));
  if (cell >= 0) path_.cells.push_back(cell);
  while (!reader.is_at_end()) {
    const auto dimension = static_cast<std::size_t>(reader.number());
    path_.sides.push_back({dimension, reader.number() != 0});
  }
}

}  // namespace coordreq
