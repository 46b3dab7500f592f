#include "cell/action_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "answers/countdown/delay_layers.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "cell/smallest_score.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// C(x) outside K.
const std::vector<std::int64_t> kNoInputs;

double known(double score) {
  return std::isnan(score) ? outward::kInfinity : score;
}

}  // namespace

ActionChooser::ActionChooser(const LoopProblem& problem, Policy policy, PointDynamics& dynamics,
                             KeptInputs& controller)
    : problem_(problem),
      policy_(policy),
      delay_(problem.delay()),
      invariant_(problem.abstraction->grid,
                 [delay = delay_](std::int64_t cell) { return delay[at(cell)] >= 0; }),
      safe_(problem.abstraction->grid,
            [delay = delay_](std::int64_t cell) { return delay[at(cell)] != kOutsideSafe; }),
      safe_beyond_(problem.abstraction->grid,
                   [beyond = problem.safe_beyond](std::int64_t cell) { return beyond->test(cell); }),
      posts_(*problem.abstraction),
      inputs_(*problem.spec, posts_, sets()),
      controller_(&controller),
      classes_(input_classes(*problem.spec, problem.abstraction->inputs, *problem.partition)),
      margin_(*problem.spec, problem.abstraction->inputs, dynamics),
      nominal_(*problem.spec, *problem.abstraction, dynamics),
      no_error_(problem.spec->states.size()),
      slots_(problem.spec->slot_count()),
      doubles_(problem.spec->slot_count()) {
  const PolicyContext context{.spec = problem.spec,
                              .partition = problem.partition,
                              .tables = problem.tables,
                              .posts = &posts_,
                              .values = [this](const std::string& path) -> CellValue {
                                return [values = problem_.values.at(path)](std::int64_t cell) {
                                  return values[at(cell)];
                                };
                              }};
  for (const AnswerPolicy& answer : problem.policies) {
    cell_policies_.push_back(answer.make(context));
    then_.push_back(answer.make_then == nullptr ? nullptr : answer.make_then(context));
  }
  for (InputClass& input_class : classes_) {
    input_class.tabulate();
    class_offsets_.push_back(input_class.offsets());
  }
  for (const AgentSpec& agent : problem.spec->agents) {
    prefer_.emplace_back();
    if (agent.prefer) prefer_.back().emplace(*agent.prefer);
  }
  for (const DisturbanceSpec& w : problem.spec->disturbances) middle_.emplace_back((w.lower + w.upper) / 2);
  find_nominal();
}

AdmissibleInputs::Sets ActionChooser::sets() {
  AdmissibleInputs::Sets sets{.invariant = &invariant_, .safe = &safe_, .safe_beyond = {}, .listed = {}};
  if (problem_.safe_beyond != nullptr) sets.safe_beyond = [this] { return &safe_beyond_; };
  if (problem_.listed != nullptr) {
    sets.listed = [listed = problem_.listed](std::int64_t cell, std::int64_t u) {
      return listed->test(cell, u);
    };
  }
  return sets;
}

void ActionChooser::find_nominal() {
  const InputSpace& space = problem_.abstraction->inputs;
  for (std::size_t i = 0; i < space.size(); ++i) {
    const std::vector<Rational>& values = space[i].values;
    const auto nearest = std::min_element(values.begin(), values.end(), [](const auto& a, const auto& b) {
      return abs(a) != abs(b) ? abs(a) < abs(b) : a < b;
    });
    input_values_.emplace_back();
    for (const Rational& value : values) input_values_.back().push_back(nearest_double(value));
    nominal_offsets_.push_back((nearest - values.begin()) * space.stride(i));
  }
}

std::optional<std::int64_t> ActionChooser::choose(std::int64_t cell, std::span<const Rational> measured,
                                                  Turn turn, NextStates& next, RandomStream& random) {
  CellPolicy& cell_policy = *(turn.is_after_silence ? then_ : cell_policies_)[turn.policy];
  const AnswerPolicy& policy = problem_.policies[turn.policy];
  compared_ = policy.is_anywhere ? problem_.values.at(policy.delay) : delay_;
  const Numbers& admissible = controller(cell);
  const Numbers& together = cell_policy.together(cell, admissible);
  if (together.empty() && !policy.is_anywhere) return std::nullopt;
  choices_.clear();
  if (turn.countdown == 0) {
    choices_.push_back(together);
  } else {
    choices_ = cell_policy.alone(cell, turn.countdown, together, classes_);
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (choices_[c].empty()) return std::nullopt;
      for (std::int64_t& a : choices_[c]) a = class_offsets_[c][at(a)];
    }
  }
  if (policy_ == Policy::random) return choose_randomly(random);
  return policy_ == Policy::adversarial ? choose_worst(next) : choose_preferred(cell, measured);
}

const std::vector<std::int64_t>& ActionChooser::controller(std::int64_t cell) {
  if (delay_[at(cell)] < 0) return kNoInputs;
  posts_.move_to(cell);  // policies look at posts too
  const Numbers* const known = controller_->find(cell);
  return known != nullptr ? *known : controller_->keep(cell, inputs_.of(cell));
}

std::int64_t ActionChooser::choose_randomly(RandomStream& random) const {
  std::int64_t u = 0;
  for (const Numbers& offsets : choices_) u += offsets[random.below(offsets.size())];
  return u;
}

template <class Visit>
void ActionChooser::for_each_choice(const Visit& visit) const {
  std::vector<std::int64_t> counts;
  for (const Numbers& offsets : choices_) counts.push_back(static_cast<std::int64_t>(offsets.size()));
  Odometer choice(counts);
  do {
    std::int64_t u = 0;
    for (std::size_t c = 0; c < choices_.size(); ++c) u += choices_[c][at(choice.indices()[c])];
    visit(u);
  } while (choice.advance());
}

std::int64_t ActionChooser::delay_after(NextStates& next, std::int64_t u) const {
  const NextStates::CellLocation location = next.location(u);
  if (location.kind == Location::Kind::cell) return compared_[at(location.cell)];
  return location.kind == Location::Kind::left_safely ? std::numeric_limits<std::int64_t>::max()
                                                      : kOutsideSafe;
}

std::int64_t ActionChooser::choose_worst(NextStates& next) {
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
  Numbers worst;
  for_each_choice([&](std::int64_t u) {
    const std::int64_t delay = delay_after(next, u);
    if (delay > lowest) return;
    if (delay < lowest) worst.clear();
    lowest = delay;
    worst.push_back(u);
  });
  return worst.size() == 1 ? worst.front() : margin_.smallest(next, worst);
}

std::int64_t ActionChooser::choose_preferred(std::int64_t cell, std::span<const Rational> measured) {
  nominal_.begin(measured, middle_, no_error_, cell);
  if (choices_.size() == 1) {  // coordinated, or one class of all
    std::vector<std::int32_t> everyone(prefer_.size());
    std::iota(everyone.begin(), everyone.end(), 0);
    return smallest_preference(everyone, choices_.front());
  }
  std::int64_t u = 0;
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    std::int64_t others = 0;
    for (std::size_t i = 0; i < nominal_offsets_.size(); ++i) {
      if (!classes_[c].contains(static_cast<std::int32_t>(i))) others += nominal_offsets_[i];
    }
    Numbers candidates = choices_[c];
    for (std::int64_t& candidate : candidates) candidate += others;
    u += smallest_preference(problem_.partition->classes[c], candidates) - others;
  }
  return u;
}

std::int64_t ActionChooser::smallest_preference(const std::vector<std::int32_t>& agents,
                                                const Numbers& candidates) {
  const auto sum = [&](const auto& value_of) {
    double total = 0;
    for (const std::int32_t agent : agents) {
      if (std::optional<PointValue>& prefer = prefer_[at(agent)]) total += value_of(*prefer);
    }
    return known(total);
  };
  return smallest_score(
      candidates,
      [&](std::int64_t u) {
        if (!nominal_.is_known(u)) return outward::kInfinity;
        fill_approximately(nominal_, u);
        return sum([&](PointValue& prefer) { return prefer.approximate(doubles_); });
      },
      [&](std::int64_t u) {
        if (!nominal_.is_known(u)) return outward::kInfinity;
        fill(nominal_, u);
        return sum([&](PointValue& prefer) { return prefer.value(slots_); });
      });
}

/// The next state and the inputs that lead to it, at their slots. @pre the state is known
void ActionChooser::fill(NextStates& next, std::int64_t u) {
  REQUIRES(next.is_known(u));
  const ProblemSpec& spec = *problem_.spec;
  for (std::size_t i = 0; i < spec.states.size(); ++i) slots_[spec.state_slot(i)] = next.state(i, u).value;
  const InputSpace& space = problem_.abstraction->inputs;
  for (std::size_t i = 0; i < space.size(); ++i) {
    slots_[spec.input_slot(i)] = space[i].values[at(space.index(u, i))];
  }
}

void ActionChooser::fill_approximately(NextStates& next, std::int64_t u) {
  const ProblemSpec& spec = *problem_.spec;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    doubles_[spec.state_slot(i)] = next.state(i, u).approximate;
  }
  const InputSpace& space = problem_.abstraction->inputs;
  for (std::size_t i = 0; i < space.size(); ++i) {
    doubles_[spec.input_slot(i)] = input_values_[i][at(space.index(u, i))];
  }
}

}  // namespace coordreq
