#include "answers/requirements/escape_path.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "answers/invariance/action_bits.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kNeverLost = INT64_MAX;
/// Instead of a level to look for: the least there is.
constexpr std::int64_t kLeast = -1;

std::int64_t level_of(const LevelMap& levels, std::int64_t cell) {
  const std::int64_t level = levels.at(cell);
  return level == LevelMap::kTop ? kNeverLost : level;
}

/// IND_C(x) at one cell after another.
class IndependentChoices {
 public:
  IndependentChoices(const Controller& controller, const ActionGrouping& grouping)
      : controller_(controller), grouping_(grouping) {}

  void go_to(std::int64_t cell) {
    const std::int64_t length = controller_.engine->row_length();
    const std::int64_t row = cell / length;
    bits_.clear();
    for (std::size_t c = 0; c < grouping_.size(); ++c) {
      const std::vector<std::uint8_t> of_row = action_bits(controller_, grouping_, c, row, row + 1);
      const auto bytes = static_cast<std::ptrdiff_t>(of_row.size()) / length;
      const auto first = of_row.begin() + cell % length * bytes;
      bits_.emplace_back(first, first + bytes);
    }
  }

  [[nodiscard]] bool contains(std::int64_t u) const {
    for (std::size_t c = 0; c < bits_.size(); ++c) {
      const std::int64_t action = grouping_[c].action(u);
      if ((bits_[c][static_cast<std::size_t>(action / 8)] >> (action % 8) & 1U) == 0) return false;
    }
    return true;
  }

 private:
  const Controller& controller_;
  const ActionGrouping& grouping_;
  std::vector<std::vector<std::uint8_t>> bits_;  // [class]
};

class EscapeFinder {
 public:
  explicit EscapeFinder(const EscapeSets& sets)
      : sets_(sets),
        engine_(*sets.controller->engine),
        collision_time_(*sets.controller->collision_time),
        posts_(engine_.abstraction(), sets.tubes) {}

  EscapePath run(std::int64_t cell) {
    path_.cells.push_back(cell);
    bool goes_on = true;
    while (goes_on && sets_.controller->invariant->test(path_.cells.back())) goes_on = take_independent();
    while (goes_on && level_of(collision_time_, path_.cells.back()) > 0) goes_on = take_evasive();
    return std::move(path_);
  }

 private:
  /// A joint input, where it leads to, and the level of the worst cell there.
  struct Choice {
    std::int64_t joint_input = 0;
    std::int64_t level = kNeverLost;
    PairPosts::Post post;
  };

  bool take_independent() {
    const std::int64_t cell = path_.cells.back();
    const std::int64_t layers = level_of(*sets_.layers_of, cell);
    IndependentChoices choices(*sets_.controller, *sets_.grouping);
    choices.go_to(cell);
    const auto is_choice = [&choices](std::int64_t u) { return choices.contains(u); };
    // From the last layer that holds the cell the way out of K is a single step.
    const bool is_last = layers == 1;
    const LevelMap& levels = is_last ? collision_time_ : *sets_.layers_of;
    return take(find(levels, is_last ? kLeast : layers - 1, is_choice), levels, EscapePhase::independent);
  }

  bool take_evasive() {
    const std::int64_t cell = path_.cells.back();
    const auto is_allowed = [this, cell](std::int64_t u) {
      const std::int64_t column = cell % engine_.row_length();
      const PairTable* allow = engine_.allow();
      if (allow == nullptr) return true;
      const auto row = allow->row(cell / engine_.row_length(), u);
      return (row[static_cast<std::size_t>(column / CellSet::kWordBits)] >> (column % CellSet::kWordBits) &
              1U) != 0;
    };
    const std::int64_t target = level_of(collision_time_, cell) - 1;
    return take(find(collision_time_, target, is_allowed), collision_time_, EscapePhase::evasive);
  }

  /// The lowest joint input of the candidates whose worst successor has the level that is looked for.
  template <class IsCandidate>
  std::optional<Choice> find(const LevelMap& levels, std::int64_t target, const IsCandidate& is_candidate) {
    std::map<std::vector<IndexRange>, std::int64_t> known;
    std::optional<Choice> best;
    for (std::int64_t u = 0; u < engine_.abstraction().inputs.count(); ++u) {
      if (!is_candidate(u)) continue;
      Choice choice{.joint_input = u, .post = posts_.of(path_.cells.back(), u)};
      choice.level = worst_level(choice.post, levels, known);
      if (target == kLeast ? !best || choice.level < best->level : choice.level == target) {
        best = std::move(choice);
      }
      if (best && (target != kLeast || best->level == 0)) break;
    }
    return best;
  }

  /// 0 for a post that is blocked. @param known of boxes that were asked for before
  std::int64_t worst_level(const PairPosts::Post& post, const LevelMap& levels,
                           std::map<std::vector<IndexRange>, std::int64_t>& known) const {
    if (post.blocked != PairPosts::Blocked::no) return 0;
    if (post.all_left) return kNeverLost;
    const auto [place, is_new] = known.try_emplace(post.box, kNeverLost);
    if (is_new) {
      for_each_cell(engine_.grid(), post.box, [&worst = place->second, &levels](std::int64_t next) {
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
    if (choice->post.blocked != PairPosts::Blocked::no) {
      const bool left = choice->post.blocked == PairPosts::Blocked::left_domain;
      path_.end = left ? EscapeEnd::left_domain : EscapeEnd::unsafe_between_samples;
      path_.sides = choice->post.sides;
      return false;
    }
    path_.cells.push_back(lowest_cell(choice->post, choice->level, levels));
    return true;
  }

  /// The lowest-numbered cell of a post that has the level.
  [[nodiscard]] std::int64_t lowest_cell(const PairPosts::Post& post, std::int64_t level,
                                         const LevelMap& levels) const {
    std::int64_t lowest = -1;
    for_each_cell(engine_.grid(), post.box, [&](std::int64_t next) {
      if (level_of(levels, next) == level && (lowest < 0 || number(next) < number(lowest))) lowest = next;
      return true;
    });
    return lowest;
  }

  [[nodiscard]] std::int64_t number(std::int64_t cell) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < sets_.number_stride.size(); ++i) {
      sum += engine_.grid().index(cell, i) * sets_.number_stride[i];
    }
    return sum;
  }

  const EscapeSets& sets_;
  const RowEngine& engine_;
  const LevelMap& collision_time_;
  PairPosts posts_;
  EscapePath path_;
};

}  // namespace

EscapePath find_escape(const EscapeSets& sets, std::int64_t cell) {
  return EscapeFinder(sets).run(cell);
}

}  // namespace coordreq
