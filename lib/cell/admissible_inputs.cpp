#include "cell/admissible_inputs.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "engine/tube_sets.hpp"
#include "reach/counter.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Sets that are merged: the root of each element.
class Merger {
 public:
  explicit Merger(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  [[nodiscard]] std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void merge(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

bool is_literal_true(const Program& program) {
  return program.nodes.back().op == Operator::literal_true;
}

}  // namespace

AdmissibleInputs::AdmissibleInputs(const ProblemSpec& spec, const Abstraction& abstraction, Sets sets)
    : spec_(&spec), abstraction_(&abstraction), sets_(std::move(sets)), point_(spec.slot_count()) {
  safe_beyond_ = sets_.safe;
  if (sets_.safe_beyond != nullptr) {
    safe_beyond_ = [beyond = sets_.safe_beyond](std::int64_t cell) { return beyond->test(cell); };
  }
  if (spec.controller.allow && !is_literal_true(*spec.controller.allow)) {
    allow_ = std::make_unique<Evaluator<RationalInterval>>(*spec.controller.allow);
  }
  find_components();
}

/// States that share an input belong together, and so do all inputs that `allow` mentions.
void AdmissibleInputs::find_components() {
  const std::size_t inputs = abstraction_->inputs.size();
  Merger merger(inputs);
  for (const TransitionTable& table : abstraction_->tables) {
    for (const std::int32_t j : table.inputs) merger.merge(at(table.inputs.front()), at(j));
  }
  std::size_t first_of_allow = inputs;
  if (allow_) {
    for (const std::uint32_t slot : spec_->controller.allow->variables()) {
      if (slot < spec_->input_slot(0)) continue;
      const std::size_t i = slot - spec_->input_slot(0);
      if (first_of_allow == inputs) first_of_allow = i;
      merger.merge(first_of_allow, i);
    }
  }
  allow_has_inputs_ = first_of_allow < inputs;
  for (std::size_t i = 0; i < inputs; ++i) {
    if (merger.root(i) != i) continue;
    Component& component = components_.emplace_back();
    for (std::size_t j = 0; j < inputs; ++j) {
      if (merger.root(j) == i) component.inputs.push_back(j);
    }
    component.has_allow = allow_has_inputs_ && merger.root(first_of_allow) == i;
    for (std::size_t s = 0; s < abstraction_->tables.size(); ++s) {
      const auto& used = abstraction_->tables[s].inputs;
      if (!used.empty() && merger.root(at(used.front())) == i) component.states.push_back(s);
    }
  }
  Component& autonomous = components_.emplace_back();
  for (std::size_t s = 0; s < abstraction_->tables.size(); ++s) {
    if (abstraction_->tables[s].inputs.empty()) autonomous.states.push_back(s);
  }
}

bool AdmissibleInputs::is_allowed(std::int64_t x, std::int64_t u) {
  for (std::size_t i = 0; i < abstraction_->grid.size(); ++i) {
    const Rational centre = abstraction_->grid[i].point(abstraction_->grid.index(x, i));
    point_[spec_->state_slot(i)] = {.lower = centre, .upper = centre};
  }
  for (std::size_t i = 0; i < abstraction_->inputs.size(); ++i) {
    const Rational& value = abstraction_->inputs[i].values[at(abstraction_->inputs.index(u, i))];
    point_[spec_->input_slot(i)] = {.lower = value, .upper = value};
  }
  return allow_->condition(point_) == Truth::yes;
}

/// The component's states under `u`; nothing if blocked. `given` does not ask: all moves are alike.
std::optional<AdmissibleInputs::Move> AdmissibleInputs::move(const Component& component, std::int64_t x,
                                                             std::int64_t u) const {
  Move result;
  if (spec_->controller.synthesis == Synthesis::given) return result;
  for (const std::size_t s : component.states) {
    const ResolvedRange range = abstraction_->resolved(s, x, u);
    if (range.blocked) return std::nullopt;
    result.post.push_back(range.inside);
    if (abstraction_->tubes.empty()) continue;
    const ResolvedRange tube = abstraction_->resolved_tube(s, x, u);
    if (tube.blocked) return std::nullopt;
    result.tube.push_back(tube.inside);
    result.passes_a_limit =
        result.passes_a_limit || passes_a_limit(abstraction_->raw_tube(s, x, u), abstraction_->grid[s]);
  }
  return result;
}

/// All inputs of a component that `allow` permits and that are not blocked, by the move that they lead to.
void AdmissibleInputs::find_moves(Component& component, std::int64_t x) {
  std::vector<std::int64_t> counts;
  for (const std::size_t i : component.inputs) counts.push_back(abstraction_->inputs[i].count());
  std::map<Move, std::vector<std::int64_t>> groups;
  Counter choice(counts);
  do {
    std::int64_t part = 0;
    for (std::size_t j = 0; j < component.inputs.size(); ++j) {
      part += choice.indices()[j] * abstraction_->inputs.stride(component.inputs[j]);
    }
    if (component.has_allow && !is_allowed(x, part)) continue;
    if (std::optional<Move> next = move(component, x, part)) groups[std::move(*next)].push_back(part);
  } while (choice.next());
  component.groups.assign(groups.begin(), groups.end());
}

const std::vector<std::int64_t>& AdmissibleInputs::of(std::int64_t x) {
  admissible_.clear();
  if (allow_ && !allow_has_inputs_ && !is_allowed(x, 0)) return admissible_;
  std::vector<std::int64_t> counts;
  for (Component& component : components_) {
    find_moves(component, x);
    if (component.groups.empty()) return admissible_;
    counts.push_back(static_cast<std::int64_t>(component.groups.size()));
  }
  Counter choice(counts);
  do {
    if (is_safe(choice.indices())) collect(choice.indices());
  } while (choice.next());
  if (sets_.listed != nullptr)
    std::erase_if(admissible_, [&](std::int64_t u) { return !sets_.listed->test(x, u); });
  sort();
  return admissible_;
}

/// By marks where C(x) is a good part of all joint inputs, which is faster.
void AdmissibleInputs::sort() {
  const std::size_t inputs = at(abstraction_->inputs.count());
  if (admissible_.size() < inputs / 32) {
    std::sort(admissible_.begin(), admissible_.end());
    return;
  }
  marks_.assign(inputs, false);
  for (const std::int64_t u : admissible_) marks_[at(u)] = true;
  admissible_.clear();
  for (std::size_t u = 0; u < inputs; ++u) {
    if (marks_[u]) admissible_.push_back(static_cast<std::int64_t>(u));
  }
}

/// empty != f(x,u) subset of K, for one move a component. `given` does not ask.
bool AdmissibleInputs::is_safe(const std::vector<std::int64_t>& choice) const {
  if (spec_->controller.synthesis == Synthesis::given) return true;
  if (!stays_in(choice, &Move::post, sets_.invariant)) return false;
  if (abstraction_->tubes.empty()) return true;
  bool beyond = false;
  for (std::size_t c = 0; c < components_.size(); ++c) {
    beyond = beyond || components_[c].groups[at(choice[c])].first.passes_a_limit;
  }
  return stays_in(choice, &Move::tube, beyond ? safe_beyond_ : sets_.safe);
}

/// Whether the box of posts, or of tubes, is in the set.
bool AdmissibleInputs::stays_in(const std::vector<std::int64_t>& choice, Box Move::*part,
                                const IsMember& set) const {
  std::vector<std::int64_t> counts(abstraction_->grid.size(), 1);
  std::vector<IndexRange> box(abstraction_->grid.size());
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const Box& chosen = components_[c].groups[at(choice[c])].first.*part;
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      if (chosen[j].first > chosen[j].last) return true;  // all of it has left safely
      const std::size_t s = components_[c].states[j];
      box[s] = chosen[j];
      counts[s] = std::int64_t{box[s].last} - box[s].first + 1;
    }
  }
  Counter offset(counts);
  do {
    std::int64_t cell = 0;
    for (std::size_t s = 0; s < box.size(); ++s) {
      const std::int64_t k = (box[s].first + offset.indices()[s]) % abstraction_->grid[s].count;
      cell += k * abstraction_->grid.stride(s);
    }
    if (!set(cell)) return false;
  } while (offset.next());
  return true;
}

/// All joint inputs whose parts lead to the chosen moves.
void AdmissibleInputs::collect(const std::vector<std::int64_t>& choice) {
  std::vector<std::int64_t> sums = {0};
  for (std::size_t c = 0; c < components_.size(); ++c) {
    std::vector<std::int64_t> longer;
    for (const std::int64_t part : components_[c].groups[at(choice[c])].second) {
      for (const std::int64_t sum : sums) longer.push_back(sum + part);
    }
    sums = std::move(longer);
  }
  admissible_.insert(admissible_.end(), sums.begin(), sums.end());
}

}  // namespace coordreq
