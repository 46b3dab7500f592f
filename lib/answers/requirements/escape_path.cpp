#include "answers/requirements/escape_path.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "answers/goal/arrival.hpp"
#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/progress_inputs.hpp"
#include "answers/one_cell/silent_inputs.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kNeverLost = INT64_MAX;
/// Instead of a level to look for: the least there is.
constexpr std::int64_t kLeast = -1;

std::int64_t level_of(const LevelMap& levels, std::int64_t cell) {
  const std::int64_t level = levels.at(cell);
  return level == LevelMap::kTop ? kNeverLost : level;
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
        progress_(ground_.spec, posts_, [this](std::int64_t y) { return arrival(y); }) {
    if (sets.silence_of == nullptr) return;
    silent_.emplace(ground_.spec, SilentInputs::Part::actions, sets.partition->classes, posts_);
    if (sets.lost != nullptr)
      afterwards_.emplace(ground_.spec, SilentInputs::Part::then, sets.partition->classes, posts_);
  }

  EscapePath run(std::int64_t cell) {
    path_.cells.push_back(cell);
    while (step_of_owner()) {
    }
    return std::move(path_);
  }

 private:
  /// How the path goes on from where it is; before the first step nothing of it is known.
  enum class Way : std::uint8_t { unknown, together, approaching, silent, independent, evasive };

  /// The step from the last cell, which the process that owns the cell finds for all. @returns whether to go
  /// on
  bool step_of_owner() {
    const RowShare* const share = ground_.shared_rows();
    if (share == nullptr) return step();
    Ranks& ranks = share->ranks();
    const int owner = share->owner(path_.cells.back() / grid_.row_length());
    Bytes message;
    if (owner == ranks.rank()) {
      const std::size_t cells = path_.cells.size(), inputs = path_.joint_inputs.size();
      const bool goes_on = step();
      std::vector<std::int64_t> news = {
          goes_on ? 1 : 0,
          static_cast<std::int64_t>(way_),
          static_cast<std::int64_t>(path_.end),
          path_.joint_inputs.size() > inputs ? path_.joint_inputs.back() : -1,
          path_.joint_inputs.size() > inputs ? static_cast<std::int64_t>(path_.phases.back()) : -1,
          path_.cells.size() > cells ? path_.cells.back() : -1};
      for (const DomainSide& side : path_.sides)
        news.insert(news.end(), {static_cast<std::int64_t>(side.dimension), side.above ? 1 : 0});
      put_numbers<std::int64_t>(message, news);
      for (int other = 0; other < ranks.count(); ++other) {
        if (other != owner) ranks.send(other, message);
      }
      return goes_on;
    }
    message = ranks.receive(owner);
    MessageReader reader(message);
    const bool goes_on = reader.number() != 0;
    way_ = static_cast<Way>(reader.number());
    path_.end = static_cast<EscapeEnd>(reader.number());
    const std::int64_t input = reader.number(), phase = reader.number(), cell = reader.number();
    if (input >= 0) path_.joint_inputs.push_back(input);
    if (input >= 0) path_.phases.push_back(static_cast<EscapePhase>(phase));
    if (cell >= 0) path_.cells.push_back(cell);
    while (!reader.is_at_end()) {
      const auto dimension = static_cast<std::size_t>(reader.number());
      path_.sides.push_back({dimension, reader.number() != 0});
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

  /// A joint input, where it leads to, and the level of the worst cell there.
  struct Choice {
    std::int64_t joint_input = 0;
    std::int64_t level = kNeverLost;
    CellPost post;
    bool is_forbidden = false;
  };

  AdmissibleInputs::Sets members() {
    AdmissibleInputs::Sets sets{.invariant = &invariant_, .safe = &safe_, .safe_beyond = {}, .listed = {}};
    if (tubes_.beyond != nullptr) sets.safe_beyond = [this] { return &beyond_; };
    if (ground_.listed) {
      sets.listed = [this](std::int64_t cell, std::int64_t u) {
        return ground_.listed->pairs.test(number(cell), u);
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
        lowest_cell(post, [&, worst = worst](std::int64_t y) { return arrival(y) == worst; });
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
      const std::int64_t next = lowest_cell(post, [&](std::int64_t y) {
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

  /// The lowest joint input of the candidates whose worst successor has the level that is looked for.
  template <class IsCandidate>
  std::optional<Choice> find(const LevelMap& levels, std::int64_t target, const IsCandidate& is_candidate) {
    std::map<std::vector<IndexRange>, std::int64_t> known;
    std::optional<Choice> best;
    posts_.move_to(path_.cells.back());
    for (std::int64_t u = 0; u < posts_.inputs().count(); ++u) {
      if (!is_candidate(u)) continue;
      Choice choice{.joint_input = u, .post = posts_.post(u, tubes_)};
      choice.is_forbidden = inputs_.forbids(path_.cells.back(), u);
      choice.level = choice.is_forbidden ? 0 : worst_level(choice.post, levels, known);
      if (target == kLeast ? !best || choice.level < best->level : choice.level == target) {
        best = std::move(choice);
      }
      if (best && (target != kLeast || best->level == 0)) break;
    }
    return best;
  }

  /// 0 for a post that is blocked. @param known of boxes that were asked for before
  std::int64_t worst_level(const CellPost& post, const LevelMap& levels,
                           std::map<std::vector<IndexRange>, std::int64_t>& known) const {
    if (post.blocked != CellPost::Blocked::no) return 0;
    if (post.all_left) return kNeverLost;
    const auto [place, is_new] = known.try_emplace(post.box, kNeverLost);
    if (is_new) {
      for_each_cell(grid_, post.box, [&worst = place->second, &levels](std::int64_t next) {
        worst = std::min(worst, level_of(levels, next));
        return worst > 0;
      });
    }
    return place->second;
  }

  /// Goes the step. @returns false if the path ends with it
  bool take(const std::optional<Choice>& choice, const LevelMap& levels, EscapePhase phase) {
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
        lowest_cell(choice->post, [&](std::int64_t y) { return level_of(levels, y) == choice->level; }));
    return true;
  }

  /// The lowest-numbered cell of a post that is wanted; negative: there is none.
  template <class IsWanted>
  [[nodiscard]] std::int64_t lowest_cell(const CellPost& post, const IsWanted& is_wanted) const {
    std::int64_t lowest = -1;
    if (post.all_left) return lowest;
    for_each_cell(grid_, post.box, [&](std::int64_t next) {
      if (is_wanted(next) && (lowest < 0 || number(next) < number(lowest))) lowest = next;
      return true;
    });
    return lowest;
  }

  [[nodiscard]] std::int64_t number(std::int64_t cell) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < sets_.number_stride.size(); ++i) {
      sum += grid_.index(cell, i) * sets_.number_stride[i];
    }
    return sum;
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
};

}  // namespace

EscapePath find_escape(const EscapeSets& sets, std::int64_t cell) {
  return EscapeFinder(sets).run(cell);
}

}  // namespace coordreq
