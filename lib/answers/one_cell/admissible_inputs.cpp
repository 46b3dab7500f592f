#include "answers/one_cell/admissible_inputs.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/union_find.hpp"
#include "engine/tube_sets.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Whether no index is left inside.
bool is_empty(const IndexRange& range) {
  return range.first > range.last;
}

bool is_literal_true(const Program& program) {
  return program.nodes.back().op == Operator::literal_true;
}

}  // namespace

AdmissibleInputs::AdmissibleInputs(const ProblemSpec& spec, CellPosts& posts, Sets sets)
    : spec_(&spec), posts_(&posts), sets_(std::move(sets)) {
  if (spec.controller.allow && !is_literal_true(*spec.controller.allow)) {
    allow_.emplace(spec, *spec.controller.allow, posts.grid(), posts.inputs(), "'allow'",
                   "/controller/allow");
  }
  find_components();
}

/// Finds the components: states that share an input belong together, and so do all inputs that `allow`
/// mentions.
void AdmissibleInputs::find_components() {
  const std::size_t inputs = posts_->inputs().size();
  const std::size_t states = posts_->grid().size();
  UnionFind sets(inputs);
  for (std::size_t s = 0; s < states; ++s) {
    const std::vector<std::int32_t>& used = posts_->inputs_of(s);
    for (const std::int32_t j : used) sets.merge(at(used.front()), at(j));
  }
  std::size_t first_of_allow = inputs;
  if (allow_) {
    for (const std::uint32_t slot : spec_->controller.allow->variables()) {
      if (slot < spec_->input_slot(0)) continue;
      const std::size_t i = slot - spec_->input_slot(0);
      if (i >= inputs) continue;  // a state's cell
      if (first_of_allow == inputs) first_of_allow = i;
      sets.merge(first_of_allow, i);
    }
  }
  allow_has_inputs_ = first_of_allow < inputs;
  for (std::size_t i = 0; i < inputs; ++i) {
    if (sets.root(i) != i) continue;
    Component& component = components_.emplace_back();
    for (std::size_t j = 0; j < inputs; ++j) {
      if (sets.root(j) == i) component.inputs.push_back(j);
    }
    component.has_allow = allow_has_inputs_ && sets.root(first_of_allow) == i;
    for (std::size_t s = 0; s < states; ++s) {
      const std::vector<std::int32_t>& used = posts_->inputs_of(s);
      if (!used.empty() && sets.root(at(used.front())) == i) component.states.push_back(s);
    }
  }
  Component& autonomous = components_.emplace_back();
  for (std::size_t s = 0; s < states; ++s) {
    if (posts_->inputs_of(s).empty()) autonomous.states.push_back(s);
  }
}

bool AdmissibleInputs::forbids(std::int64_t x, std::int64_t u) {
  if (!allow_) return false;
  allow_->go_to(x);
  return !allow_->holds(u);
}

bool AdmissibleInputs::allows(std::int64_t x, std::int64_t u) {
  return !forbids(x, u) && (!sets_.listed || sets_.listed(x, u));
}

/// The move of a component under `u`; nothing if it is blocked. For `given` all moves are equal.
std::optional<AdmissibleInputs::Move> AdmissibleInputs::move(const Component& component,
                                                             std::int64_t u) const {
  Move result;
  if (spec_->controller.synthesis == Synthesis::given) return result;
  for (const std::size_t s : component.states) {
    const ResolvedRange range = posts_->resolved(s, u);
    if (range.blocked) return std::nullopt;
    result.post.push_back(range.inside);
    if (!posts_->has_tubes()) continue;
    const ResolvedRange tube = posts_->resolved_tube(s, u);
    if (tube.blocked) return std::nullopt;
    result.tube.push_back(tube.inside);
    result.passes_a_limit =
        result.passes_a_limit || passes_a_limit(posts_->raw_tube(s, u), posts_->grid()[s]);
  }
  return result;
}

/// Finds the moves of a component, each with the inputs that lead to it, of those that `allow` permits and
/// that are not blocked.
void AdmissibleInputs::find_moves(Component& component) {
  std::vector<std::int64_t> counts;
  for (const std::size_t i : component.inputs) counts.push_back(posts_->inputs()[i].count());
  std::map<Move, std::vector<std::int64_t>> groups;
  Odometer choice(counts);
  do {
    std::int64_t number = 0;
    for (std::size_t j = 0; j < component.inputs.size(); ++j) {
      number += choice.indices()[j] * posts_->inputs().stride(component.inputs[j]);
    }
    if (component.has_allow && !allow_->holds(number)) continue;
    if (std::optional<Move> next = move(component, number)) groups[std::move(*next)].push_back(number);
  } while (choice.advance());
  component.groups.assign(groups.begin(), groups.end());
}

const std::vector<std::int64_t>& AdmissibleInputs::of(std::int64_t x) {
  admissible_.clear();
  if (allow_) allow_->go_to(x);
  if (allow_ && !allow_has_inputs_ && !allow_->holds(0)) return admissible_;
  if (spec_->controller.synthesis != Synthesis::given) posts_->move_to(x);
  std::vector<std::int64_t> counts;
  for (Component& component : components_) {
    find_moves(component);
    if (component.groups.empty()) return admissible_;
    counts.push_back(static_cast<std::int64_t>(component.groups.size()));
  }
  prepare_sets();
  Odometer choice(counts);
  do {
    if (is_safe(choice.indices())) collect(choice.indices());
  } while (choice.advance());
  if (sets_.listed) std::erase_if(admissible_, [&](std::int64_t u) { return !sets_.listed(x, u); });
  sort();
  return admissible_;
}

/// Calls cover() of a set for a box around all products of one move for each component.
void AdmissibleInputs::cover(Box Move::*member, CellMembers& set) const {
  Box hull(posts_->grid().size(), IndexRange{1, 0});
  for (const Component& component : components_) {
    for (const auto& [next, inputs] : component.groups) {
      const Box& box = next.*member;
      for (std::size_t j = 0; j < box.size(); ++j) {
        if (is_empty(box[j])) continue;
        IndexRange& range = hull[component.states[j]];
        if (is_empty(range)) range = box[j];
        range = {std::min(range.first, box[j].first), std::max(range.last, box[j].last)};
      }
    }
  }
  // If one state has left under all inputs, no box is queried.
  if (std::none_of(hull.begin(), hull.end(), is_empty)) set.cover(hull);
}

void AdmissibleInputs::prepare_sets() {
  if (spec_->controller.synthesis == Synthesis::given) return;
  cover(&Move::post, *sets_.invariant);
  if (!posts_->has_tubes()) return;
  cover(&Move::tube, *sets_.safe);
  safe_beyond_ = sets_.safe;
  const bool any_passes = std::any_of(components_.begin(), components_.end(), [](const Component& component) {
    return std::any_of(component.groups.begin(), component.groups.end(),
                       [](const auto& group) { return group.first.passes_a_limit; });
  });
  CellMembers* const beyond = any_passes && sets_.safe_beyond ? sets_.safe_beyond() : nullptr;
  if (beyond == nullptr) return;
  safe_beyond_ = beyond;
  cover(&Move::tube, *safe_beyond_);
}

/// Sorts the joint inputs found; by marks where they are a large part of all, which is faster.
void AdmissibleInputs::sort() {
  const std::size_t inputs = at(posts_->inputs().count());
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

/// Whether empty != f(x,u) subset of K, for one move of each component; true for `given`.
bool AdmissibleInputs::is_safe(const std::vector<std::int64_t>& choice) const {
  if (spec_->controller.synthesis == Synthesis::given) return true;
  if (!stays_in(choice, &Move::post, *sets_.invariant)) return false;
  if (!posts_->has_tubes()) return true;
  bool beyond = false;
  for (std::size_t c = 0; c < components_.size(); ++c) {
    beyond = beyond || components_[c].groups[at(choice[c])].first.passes_a_limit;
  }
  return stays_in(choice, &Move::tube, beyond ? *safe_beyond_ : *sets_.safe);
}

/// Whether the box of posts, or of tubes, is in the set.
bool AdmissibleInputs::stays_in(const std::vector<std::int64_t>& choice, Box Move::*member,
                                const CellMembers& set) const {
  Box box(posts_->grid().size());
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const Box& chosen = components_[c].groups[at(choice[c])].first.*member;
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      if (is_empty(chosen[j])) return true;  // the post has left safely
      box[components_[c].states[j]] = chosen[j];
    }
  }
  return set.contains(box);
}

/// Adds all joint inputs that lead to the chosen moves.
void AdmissibleInputs::collect(const std::vector<std::int64_t>& choice) {
  std::vector<std::int64_t> sums = {0};
  for (std::size_t c = 0; c < components_.size(); ++c) {
    std::vector<std::int64_t> longer;
    for (const std::int64_t number : components_[c].groups[at(choice[c])].second) {
      for (const std::int64_t sum : sums) longer.push_back(sum + number);
    }
    sums = std::move(longer);
  }
  admissible_.insert(admissible_.end(), sums.begin(), sums.end());
}

}  // namespace coordreq
