#include "answers/requirements/escape_path.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "answers/goal/arrival.hpp"
#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/progress_inputs.hpp"
#include "answers/one_cell/silent_inputs.hpp"
#include "answers/requirements/escape_news.hpp"
#include "answers/requirements/escape_step.hpp"
#include "answers/requirements/real_run.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Start = std::optional<std::vector<Rational>>;

constexpr std::int64_t kLeast = EscapeSteps::kLeast;

std::int64_t level_of(const LevelMap& levels, std::int64_t cell) {
  return EscapeSteps::level_of(levels, cell);
}

class EscapeFinder {
 public:
  explicit EscapeFinder(const EscapeSets& sets)
      : sets_(sets),
        ground_(*sets.ground),
        grid_(ground_.abstraction->grid),
        collision_time_(sets.invariance->collision_time),
        tubes_(ground_.tubes()),
        posts_(*ground_.abstraction),
        invariant_(grid_, [&set = sets.invariance->invariant](std::int64_t cell) { return set.test(cell); }),
        safe_(grid_, [this](std::int64_t cell) { return tubes_.inside->test(cell); }),
        beyond_(grid_, [this](std::int64_t cell) { return tubes_.beyond->test(cell); }),
        inputs_(ground_.spec, posts_, members()),
        progress_(ground_.spec, posts_, [this](std::int64_t y) { return arrival(y); }),
        real_(ground_.spec, *ground_.abstraction),
        steps_(sets, posts_, inputs_, real_) {
    if (sets.silence_of == nullptr) return;
    silent_.emplace(ground_.spec, SilentInputs::Part::actions, sets.partition->classes, posts_);
    if (sets.lost != nullptr)
      afterwards_.emplace(ground_.spec, SilentInputs::Part::then, sets.partition->classes, posts_);
  }

  EscapePath run(std::int64_t cell, const Start& start) {
    path_.cells.push_back(cell);
    begin_at(cell, start);
    bool goes_on = true;
    while (goes_on) {
      const std::size_t steps = path_.joint_inputs.size();
      goes_on = step_of_owner();
      if (!real_.is_followed() || path_.joint_inputs.size() == steps) continue;
      real_.advance(path_.joint_inputs.back(), reached_.place);
      if (path_.cells.back() != reached_.place.cell) real_.stop();
      if (real_.is_followed()) ++path_.followed;
    }
    return std::move(path_);
  }

  std::int32_t follow(std::int64_t cell, const Start& start) {
    begin_at(cell, start);
    std::optional<EscapePhase> first;
    const std::int64_t most = std::clamp<std::int64_t>(1'000'000 / posts_.inputs().count(), 20, 1000);
    for (std::int32_t steps = 1; steps <= most; ++steps) {
      path_ = {};
      path_.cells.push_back(cell);
      way_ = Way::unknown;
      static_cast<void>(step_of_owner());
      if (path_.joint_inputs.empty() || !reached_.place.is_known) break;
      if (!first) first = path_.phases.front();
      const bool is_kept = *first == EscapePhase::independent ? reached_.is_invariant : reached_.is_safe;
      if (!is_kept || path_.end == EscapeEnd::not_allowed) return steps;
      if (reached_.place.kind != Location::Kind::cell) break;
      real_.advance(path_.joint_inputs.back(), reached_.place);
      cell = reached_.place.cell;
    }
    return ResultPath::kNotLeft;
  }

 private:
  /// How the path goes on from where it is; before the first step nothing of it is known.
  enum class Way : std::uint8_t { unknown, together, approaching, silent, independent, evasive };

  void begin_at(std::int64_t cell, const Start& start) {
    if (start) {
      real_.start(*start);
    } else {
      real_.start(cell);
    }
  }

  /// A step of the way, and that of the system itself.
  bool step_and_follow() {
    const std::int64_t cell = path_.cells.back();
    const std::size_t steps = path_.joint_inputs.size();
    const bool goes_on = step();
    reached_ = {};
    if (!real_.is_followed() || path_.joint_inputs.size() == steps) return goes_on;
    reached_.place = real_.after(cell, path_.joint_inputs.back());
    const bool is_cell = reached_.place.kind == Location::Kind::cell;
    posts_.move_to(cell);
    if (is_cell && !steps_.holds(posts_.post(path_.joint_inputs.back(), tubes_), reached_.place.cell)) {
      reached_ = {};  // nothing may be known of that cell
      return goes_on;
    }
    const bool has_left = reached_.place.kind == Location::Kind::left_safely;
    reached_.is_safe = is_cell ? level_of(collision_time_, reached_.place.cell) > 0 : has_left;
    reached_.is_invariant = is_cell ? sets_.invariance->invariant.test(reached_.place.cell) : has_left;
    return goes_on;
  }

  /// The step from the last cell, which the process that owns the cell finds for all. @returns whether to go
  /// on
  bool step_of_owner() {
    const RowShare* const share = ground_.shared_rows();
    if (share == nullptr) return step_and_follow();
    Ranks& ranks = share->ranks();
    const int owner = share->owner(path_.cells.back() / grid_.row_length());
    if (owner != ranks.rank()) {
      const EscapeNews news = read_escape_message(ranks.receive(owner), path_);
      way_ = static_cast<Way>(news.way);
      reached_ = news.reached;
      return news.goes_on;
    }
    const std::size_t cells = path_.cells.size(), inputs = path_.joint_inputs.size();
    const bool goes_on = step_and_follow();
    const EscapeNews news{.goes_on = goes_on, .way = static_cast<std::int64_t>(way_), .reached = reached_};
    const Bytes message = escape_message(news, path_, inputs, cells);
    for (int other = 0; other < ranks.count(); ++other) {
      if (other != owner) ranks.send(other, message);
    }
    return goes_on;
  }

  bool step() {
    const std::int64_t cell = path_.cells.back();
    const bool is_invariant = sets_.invariance->invariant.test(cell);
    if (way_ == Way::unknown) {
      const bool has_goal = sets_.goal != nullptr && is_invariant;
      const bool is_lost =
          has_goal && (sets_.kind == RequirementKind::max_arrival || !sets_.goal->winning.test(cell));
      way_ = is_lost ? Way::together : has_goal ? Way::approaching : Way::independent;
      if (sets_.silence_of != nullptr) way_ = Way::silent;
    }
    if (way_ == Way::silent) {
      if (level_of(*sets_.silence_of, cell) > 0) return take_silent();
      if (sets_.lost != nullptr) return level_of(collision_time_, cell) > 0 && take_afterwards();
      way_ = Way::evasive;
    }
    if (way_ == Way::together) return take_together();
    if (way_ == Way::approaching) {
      if (sets_.goal->away.test(cell)) return take_approaching();
      way_ = Way::independent;
    }
    if (way_ == Way::independent) {
      if (is_invariant) return take_independent();
      way_ = Way::evasive;
    }
    return level_of(collision_time_, cell) > 0 && take_evasive();
  }

  AdmissibleInputs::Sets members() {
    AdmissibleInputs::Sets sets{.invariant = &invariant_, .safe = &safe_, .safe_beyond = {}, .listed = {}};
    if (tubes_.beyond != nullptr) sets.safe_beyond = [this] { return &beyond_; };
    if (ground_.listed) {
      sets.listed = [this](std::int64_t cell, std::int64_t u) {
        return ground_.listed->pairs.test(steps_.number(cell), u);
      };
    }
    return sets;
  }

  /// Of a cell in K.
  [[nodiscard]] std::int32_t arrival(std::int64_t y) const {
    return sets_.invariance->invariant.test(y) ? arrival_at(sets_.goal->nearness, y) : -1;
  }

  /// The product of the projections of joint inputs onto the classes.
  [[nodiscard]] std::vector<bool> independent(const std::vector<std::int64_t>& joint) const {
    std::vector<bool> result(static_cast<std::size_t>(posts_.inputs().count()), true);
    for (const InputClass& own : sets_.classes) {
      std::vector<bool> projection(static_cast<std::size_t>(own.actions()), false);
      for (const std::int64_t a : own.project(joint)) projection[static_cast<std::size_t>(a)] = true;
      for (std::size_t u = 0; u < result.size(); ++u)
        result[u] =
            result[u] && projection[static_cast<std::size_t>(own.action(static_cast<std::int64_t>(u)))];
    }
    return result;
  }

  /// One step of all agents together to the goal, as badly as it can turn out. @returns whether to go on
  bool take_together() {
    const std::int64_t cell = path_.cells.back();
    if (arrival(cell) == 0) {
      path_.end = EscapeEnd::arrived;
      return false;
    }
    const bool is_given = ground_.spec.controller.synthesis == Synthesis::given;
    std::optional<std::pair<std::int32_t, std::int64_t>> best;  // worst arrival, joint input
    for (const std::int64_t u : inputs_.of(cell)) {
      const std::int32_t own = progress_.worst(cell, u);
      if (!best || (is_given ? own > best->first : own < best->first)) best = {own, u};
    }
    const auto [worst, u] = *best;
    path_.joint_inputs.push_back(u);
    path_.phases.push_back(EscapePhase::together);
    const CellPost post = posts_.post(u, tubes_);
    const std::int64_t next =
        steps_.next_cell(cell, post, u, [&, worst = worst](std::int64_t y) { return arrival(y) == worst; });
    path_.end = worst == INT32_MAX ? EscapeEnd::never_arrives : EscapeEnd::arrived;
    if (next < 0) return false;  // all has left
    const bool comes_again = std::find(path_.cells.begin(), path_.cells.end(), next) != path_.cells.end();
    path_.cells.push_back(next);
    return !comes_again;
  }

  /// One step of agents that act alone on the way to the goal. @returns whether to go on
  bool take_approaching() {
    const std::int64_t cell = path_.cells.back();
    const std::vector<bool> choices = independent(progress_.of(cell, inputs_.of(cell)));
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
      if (!is_blocked && progress_.worst(cell, u) < arrival(cell)) continue;
      path_.joint_inputs.push_back(u);
      path_.phases.push_back(EscapePhase::approaching);
      if (is_blocked) {
        end_at_block(post, is_forbidden);
        return false;
      }
      path_.end = EscapeEnd::time_lost;
      const std::int64_t next = steps_.next_cell(cell, post, u, [&](std::int64_t y) {
        const std::int32_t own = arrival(y);
        return own < 0 || own >= arrival(cell);
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
    // From the last layer that holds the cell the way out of K is a single step.
    const bool is_last = layers == 1;
    const LevelMap& levels = is_last ? collision_time_ : next;
    return take(find(levels, is_last ? kLeast : layers - 1, is_choice), levels, EscapePhase::independent);
  }

  bool take_silent() {
    const std::int64_t cell = path_.cells.back();
    const std::int64_t layers = level_of(*sets_.silence_of, cell);
    const bool is_invariant = sets_.invariance->invariant.test(cell);
    const auto choices = silent_->joint(cell, is_invariant ? inputs_.of(cell) : SilentInputs::Numbers());
    const bool is_last = layers == 1;
    const LevelMap& levels = !is_last                ? *sets_.silence_of
                             : sets_.lost != nullptr ? *sets_.lost
                                                     : collision_time_;
    return take_ruled(choices, is_last ? kLeast : layers - 1, levels, EscapePhase::silent);
  }

  bool take_afterwards() {
    const std::int64_t cell = path_.cells.back();
    return take_ruled(afterwards_->joint(cell, {}), level_of(*sets_.lost, cell) - 1, *sets_.lost,
                      EscapePhase::afterwards);
  }

  /// A step of agents who have rules.
  bool take_ruled(const SilentInputs::Numbers& choices, std::int64_t target, const LevelMap& levels,
                  EscapePhase phase) {
    if (choices.empty()) {
      path_.end = EscapeEnd::no_silent_action;
      return false;
    }
    const auto is_choice = [&](std::int64_t u) { return std::ranges::binary_search(choices, u); };
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
    return steps_.find(path_.cells.back(), levels, target, is_candidate);
  }

  /// Goes the step. @returns false if the path ends with it
  bool take(const std::optional<EscapeChoice>& choice, const LevelMap& levels, EscapePhase phase) {
    if (!choice) {
      path_.end = EscapeEnd::no_allowed_action;
      return false;
    }
    path_.joint_inputs.push_back(choice->joint_input);
    path_.phases.push_back(phase);
    if (choice->is_forbidden || choice->post.blocked != CellPost::Blocked::no) {
      end_at_block(choice->post, choice->is_forbidden);
      return false;
    }
    path_.cells.push_back(
        steps_.next_cell(path_.cells.back(), choice->post, choice->joint_input,
                         [&](std::int64_t y) { return level_of(levels, y) == choice->level; }));
    return true;
  }

  const EscapeSets& sets_;
  const Ground& ground_;
  const UniformGrid& grid_;
  const LevelMap& collision_time_;
  TubeSets tubes_;
  CellPosts posts_;
  MembersByCell invariant_, safe_, beyond_;
  AdmissibleInputs inputs_;
  ProgressInputs progress_;
  std::optional<SilentInputs> silent_, afterwards_;  ///< of `min_silence`; the second one with `then`
  EscapePath path_;
  Way way_ = Way::unknown;
  RealRun real_;
  EscapeSteps steps_;
  Reached reached_;
};

}  // namespace

EscapePath find_escape(const EscapeSets& sets, std::int64_t cell, const Start& start) {
  return EscapeFinder(sets).run(cell, start);
}

std::int32_t follow_escape(const EscapeSets& sets, std::int64_t cell, const Start& start) {
  return EscapeFinder(sets).follow(cell, start);
}

}  // namespace coordreq
