#include "answers/requirements/escape_path.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "answers/checking/class_choices.hpp"
#include "answers/goal/arrival.hpp"
#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/progress_inputs.hpp"
#include "answers/requirements/escape_run.hpp"
#include "answers/requirements/escape_step.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Start = std::optional<std::vector<Rational>>;

constexpr std::int64_t kLeast = EscapeSteps::kLeast;
/// The most looks at joint inputs by which the system itself could go on.
constexpr std::int64_t kMostLooks = 200'000;

std::int64_t level_of(const LevelMap& levels, std::int64_t cell) {
  return EscapeSteps::level_of(levels, cell);
}

/// Finds the steps of agents on the way out.
class EscapeFinder : public EscapeRun {
 public:
  explicit EscapeFinder(const EscapeSets& sets)
      : EscapeRun(sets),
        grid_(context_.abstraction->grid),
        invariant_(grid_, [&set = sets.invariance->invariant](std::int64_t cell) { return set.test(cell); }),
        safe_(grid_, [this](std::int64_t cell) { return tubes_.inside->test(cell); }),
        beyond_(grid_, [this](std::int64_t cell) { return tubes_.beyond->test(cell); }),
        inputs_(context_.spec, posts_, members()),
        progress_(context_.spec, posts_, [this](std::int64_t y) { return arrival(y); }),
        steps_(sets, posts_, inputs_, real_) {
    if (sets.silence_of == nullptr) return;
    silent_.emplace(context_.spec, grid_, posts_.inputs(), sets.partition->classes,
                    ClassChoices::Rules::actions);
    if (sets.lost != nullptr)
      afterwards_.emplace(context_.spec, grid_, posts_.inputs(), sets.partition->classes,
                          ClassChoices::Rules::then);
  }

 private:
  bool add_step() override {
    const std::int64_t cell = path_.cells.back();
    const bool is_invariant = sets_.invariance->invariant.test(cell);
    if (way() == Way::unknown) {
      const bool has_goal = sets_.goal != nullptr && is_invariant;
      const bool is_lost =
          has_goal && (sets_.kind == RequirementKind::max_arrival || !sets_.goal->winning.test(cell));
      change_way(is_lost ? Way::together : has_goal ? Way::approaching : Way::independent);
      if (sets_.silence_of != nullptr) change_way(Way::silent);
    }
    if (way() == Way::silent) {
      if (level_of(*sets_.silence_of, cell) > 0) return take_silent();
      if (sets_.ends_after_silence) return false;
      if (sets_.lost != nullptr) return level_of(collision_time_, cell) > 0 && take_afterwards();
      change_way(Way::evasive);
    }
    if (way() == Way::together) return take_together();
    if (way() == Way::approaching) {
      if (sets_.goal->away.test(cell)) return take_approaching();
      change_way(Way::independent);
    }
    if (way() == Way::independent) {
      if (is_invariant) return take_independent();
      change_way(Way::evasive);
    }
    return level_of(collision_time_, cell) > 0 && take_evasive();
  }

  AdmissibleInputs::Sets members() {
    AdmissibleInputs::Sets sets{.invariant = &invariant_, .safe = &safe_, .safe_beyond = {}, .listed = {}};
    if (tubes_.beyond != nullptr) sets.safe_beyond = [this] { return &beyond_; };
    if (context_.listed) {
      sets.listed = [this](std::int64_t cell, std::int64_t u) {
        return context_.listed->pairs.test(steps_.number_of(cell), u);
      };
    }
    return sets;
  }

  /// The arrival of a cell in K.
  [[nodiscard]] std::int32_t arrival(std::int64_t y) const {
    return sets_.invariance->invariant.test(y) ? arrival_at(sets_.goal->nearness, y) : -1;
  }

  /// The product of the projections of joint inputs onto the classes.
  [[nodiscard]] std::vector<bool> independent(const std::vector<std::int64_t>& joint) const {
    std::vector<bool> result(static_cast<std::size_t>(posts_.inputs().count()), true);
    for (const InputClass& input_class : sets_.classes) {
      std::vector<bool> projection(static_cast<std::size_t>(input_class.actions()), false);
      for (const std::int64_t a : input_class.project(joint)) projection[static_cast<std::size_t>(a)] = true;
      for (std::size_t u = 0; u < result.size(); ++u)
        result[u] = result[u] &&
                    projection[static_cast<std::size_t>(input_class.action(static_cast<std::int64_t>(u)))];
    }
    return result;
  }

  /// How soon the world shows the arrival of a lasting goal after u from the present cell: the less, the
  /// sooner.
  std::int64_t soonest(std::int64_t u, std::int32_t worst) {
    if (progress_.leaves_through_safe_side(u)) return -1;
    const CellPost post = posts_.post(u, tubes_);
    std::int64_t least = INT64_MAX;
    if (post.all_left) return least;
    for_each_cell(grid_, post.box, [&](std::int64_t y) {
      if (arrival(y) == worst) least = std::min(least, level_of(*sets_.showing_order, y));
      return true;
    });
    return least;
  }

  /// The choice of agents who want to arrive soonest, or where they have none what the world chooses for
  /// them: (worst arrival, joint input).
  std::pair<std::int32_t, std::int64_t> choose_together(std::int64_t cell) {
    const bool is_given = context_.spec.controller.synthesis == Synthesis::given;
    std::optional<std::pair<std::int32_t, std::int64_t>> best;
    std::vector<std::int64_t> equal;
    for (const std::int64_t u : inputs_.of(cell)) {
      const std::int32_t own = progress_.worst(cell, u);
      if (best && own == best->first) equal.push_back(u);
      if (best && (is_given ? own <= best->first : own >= best->first)) continue;
      best = {own, u};
      equal = {u};
    }
    if (!is_given || sets_.showing_order == nullptr) return *best;
    std::int64_t least = INT64_MAX;
    for (const std::int64_t u : equal) {
      const std::int64_t own = soonest(u, best->first);
      if (own < least) best->second = u;
      least = std::min(least, own);
    }
    return *best;
  }

  /// One step of all agents together to the goal, as badly as it can turn out. @returns whether to go on
  bool take_together() {
    const std::int64_t cell = path_.cells.back();
    if (arrival(cell) == 0) {
      path_.end = EscapeEnd::arrived;
      return false;
    }
    const auto [worst, u] = choose_together(cell);
    path_.joint_inputs.push_back(u);
    path_.phases.push_back(EscapePhase::together);
    path_.end = worst == INT32_MAX ? EscapeEnd::never_arrives : EscapeEnd::arrived;
    posts_.move_to(cell);
    const CellPost post = posts_.post(u, tubes_);
    const bool is_lasting = sets_.showing_order != nullptr;
    const std::int64_t first = is_lasting ? soonest(u, worst) : 0;
    if (first < 0) return false;  // to T through a `safe` side
    const std::int64_t next = steps_.next_cell(cell, post, u, [&, worst = worst](std::int64_t y) {
      return arrival(y) == worst && (!is_lasting || level_of(*sets_.showing_order, y) == first);
    });
    if (next < 0) return false;  // the post has left the domain
    const bool comes_again = std::find(path_.cells.begin(), path_.cells.end(), next) != path_.cells.end();
    path_.cells.push_back(next);
    return !comes_again;
  }

  /// One step of agents that act alone on the way to the goal. @returns whether to go on
  bool take_approaching() {
    const std::int64_t cell = path_.cells.back();
    const std::vector<std::int64_t>& admissible = inputs_.of(cell);
    const std::vector<bool> choices = independent(progress_.of(cell, admissible));
    const std::int32_t most = progress_.limit(cell, admissible);
    const std::int64_t layers = level_of(*sets_.approach_of, cell);
    if (layers > 1) {
      const auto is_choice = [&](std::int64_t u) { return choices[static_cast<std::size_t>(u)]; };
      return take(find(*sets_.approach_of, layers - 1, is_choice), *sets_.approach_of,
                  EscapePhase::approaching);
    }
    posts_.move_to(cell);
    for (std::int64_t u = 0; u < posts_.inputs().count(); ++u) {
      if (!choices[static_cast<std::size_t>(u)]) continue;
      const bool is_forbidden = inputs_.forbids(cell, u);
      const CellPost post = posts_.post(u, tubes_);
      const bool is_blocked = is_forbidden || post.blocked != CellPost::Blocked::no;
      if (!is_blocked && progress_.worst(cell, u) <= most) continue;
      path_.joint_inputs.push_back(u);
      path_.phases.push_back(EscapePhase::approaching);
      if (is_blocked) {
        end_at_block(post, is_forbidden);
        return false;
      }
      path_.end = EscapeEnd::time_lost;
      const std::int64_t next = steps_.next_cell(cell, post, u, [&](std::int64_t y) {
        const std::int32_t own = arrival(y);
        return own < 0 || own > most;
      });
      if (next >= 0) path_.cells.push_back(next);
      return false;
    }
    return false;
  }

  void end_at_block(const CellPost& post, bool is_forbidden) {
    path_.end = EscapeEnd::not_allowed;
    if (is_forbidden) return;
    const bool left = post.blocked == CellPost::Blocked::left_domain;
    path_.end = left ? EscapeEnd::left_domain : EscapeEnd::unsafe_between_samples;
    path_.sides = post.sides;
  }

  bool take_independent() {
    const std::int64_t cell = path_.cells.back();
    const bool is_blind = sets_.blind_countdown_of != nullptr;
    const bool is_known = path_.cells.size() == 1;
    const LevelMap& next = is_blind ? *sets_.blind_countdown_of : *sets_.layers_of;
    const std::int64_t layers = level_of(is_blind && is_known ? *sets_.blind_delay_of : next, cell);
    if (is_blind && !is_known && layers == 1 && level_of(*sets_.layers_of, cell) > 1) {
      path_.end = EscapeEnd::no_common_action;
      return false;
    }
    const std::vector<bool> choices = independent(inputs_.of(cell));
    const auto is_choice = [&](std::int64_t u) { return choices[static_cast<std::size_t>(u)]; };
    // If the cell is in its last layer, the way out of K is a single step.
    const bool is_last = layers == 1;
    const LevelMap& levels = is_last ? collision_time_ : next;
    return take(find(levels, is_last ? kLeast : layers - 1, is_choice), levels, EscapePhase::independent);
  }

  bool take_silent() {
    const std::int64_t cell = path_.cells.back();
    const std::int64_t layers = level_of(*sets_.silence_of, cell);
    const bool is_invariant = sets_.invariance->invariant.test(cell);
    silent_->go_to(cell, is_invariant ? inputs_.of(cell) : ClassChoices::Numbers());
    const bool is_last = layers == 1;
    const LevelMap& levels = !is_last                ? *sets_.silence_of
                             : sets_.lost != nullptr ? *sets_.lost
                                                     : collision_time_;
    return take_ruled(*silent_, is_last ? kLeast : layers - 1, levels, EscapePhase::silent);
  }

  bool take_afterwards() {
    const std::int64_t cell = path_.cells.back();
    afterwards_->go_to(cell, ClassChoices::Numbers());
    return take_ruled(*afterwards_, level_of(*sets_.lost, cell) - 1, *sets_.lost, EscapePhase::afterwards);
  }

  /// One step of agents who act by rules.
  bool take_ruled(const ClassChoices& choices, std::int64_t target, const LevelMap& levels,
                  EscapePhase phase) {
    if (choices.is_empty()) {
      path_.end = EscapeEnd::no_silent_action;
      return false;
    }
    const auto is_choice = [&](std::int64_t u) { return choices.has(u); };
    return take(find(levels, target, is_choice), levels, phase);
  }

  bool take_evasive() {
    const std::int64_t cell = path_.cells.back();
    const auto is_allowed = [this, cell](std::int64_t u) { return inputs_.allows(cell, u); };
    const std::int64_t target = level_of(collision_time_, cell) - 1;
    return take(find(collision_time_, target, is_allowed), collision_time_, EscapePhase::evasive);
  }

  template <class IsCandidate>
  std::optional<EscapeChoice> find(const LevelMap& levels, std::int64_t target,
                                   const IsCandidate& is_candidate) {
    return steps_.find(path_.cells.back(), levels, target, is_candidate, number());
  }

  /// Adds a step to the path. @returns false if the path ends with it
  bool take(const std::optional<EscapeChoice>& choice, const LevelMap& levels, EscapePhase phase) {
    if (!choice) {
      path_.end = EscapeEnd::no_allowed_action;
      return false;
    }
    path_.joint_inputs.push_back(choice->joint_input);
    path_.phases.push_back(phase);
    note_more(choice->has_more);
    if (choice->is_forbidden || choice->post.blocked != CellPost::Blocked::no) {
      end_at_block(choice->post, choice->is_forbidden);
      return false;
    }
    path_.cells.push_back(
        steps_.next_cell(path_.cells.back(), choice->post, choice->joint_input,
                         [&](std::int64_t y) { return level_of(levels, y) == choice->level; }));
    return true;
  }

  const UniformGrid& grid_;
  MembersByCell invariant_, safe_, beyond_;
  AdmissibleInputs inputs_;
  ProgressInputs progress_;
  std::optional<ClassChoices> silent_, afterwards_;  ///< of `min_silence`; the second one with `then`
  EscapeSteps steps_;
};

/// Finds which of equal steps to take from a cell on.
EscapeSearch::Choices find_choices(std::int64_t cell, EscapeSearch& search, EscapeRun& run) {
  run.begin_way(cell);
  const FollowedPlace here = *run.place();
  EscapeSearch::Choices choices = search.find(run);
  run.go_to(here);
  return choices;
}

}  // namespace

EscapePath find_escape(const EscapeSets& sets, std::int64_t cell, const Start& start) {
  EscapeFinder run(sets);
  run.begin_at(cell, start);
  EscapeSearch search(kMostLooks);
  const EscapeSearch::Choices choices = find_choices(cell, search, run);
  for (std::size_t k = 0; run.goes_on(); ++k) run.step(k < choices.size() ? choices[k] : 0);
  return std::move(run.path());
}

std::int32_t follow_escape(const EscapeSets& sets, std::int64_t cell, const Start& start) {
  EscapeFinder run(sets);
  run.begin_at(cell, start);
  EscapeSearch search(kMostLooks);
  std::optional<EscapePhase> first;
  EscapeSearch::Choices choices;
  std::size_t next = 0;
  const std::int64_t inputs = sets.context->abstraction->inputs.count();
  const std::int64_t most = std::clamp<std::int64_t>(1'000'000 / inputs, 20, 1000);
  for (std::int32_t steps = 1; steps <= most; ++steps) {
    if (next == choices.size()) {
      choices = find_choices(cell, search, run);
      next = 0;
    }
    run.begin_way(cell);
    run.step_alone(next < choices.size() ? choices[next++] : 0);
    const Reached& reached = run.reached();
    const EscapePath& path = run.path();
    if (path.joint_inputs.empty() || !reached.place.is_known) break;
    if (!first) first = path.phases.front();
    const bool is_inside = *first == EscapePhase::independent || *first == EscapePhase::silent;
    const bool is_kept = is_inside ? reached.is_inside : reached.is_safe;
    if (!is_kept || path.end == EscapeEnd::not_allowed) return steps;
    if (!is_inside && reached.is_inside) break;  // the actions outside lead it back inside
    if (reached.place.kind != Location::Kind::cell) break;
    run.advance();
    cell = reached.place.cell;
  }
  return ResultPath::kNotLeft;
}

}  // namespace coordreq
