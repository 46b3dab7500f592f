#include "answers/blind/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "answers/field_parts.hpp"
#include "answers/one_cell/action_text.hpp"
#include "answers/one_cell/cell_members.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/grouped.hpp"
#include "base/index.hpp"
#include "model/odometer.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"

namespace coordreq {
namespace {

/// The most cells of a fibre that are compared.
constexpr std::int64_t kMostCells = 4096;

using Sets = std::vector<std::vector<bool>>;  ///< [class][action]

/// Two cells that a class cannot distinguish.
struct Confusion {
  std::size_t class_number = 0;
  std::int64_t cell = 0, other = 0;
  std::vector<bool> actions, others_actions;
  std::int64_t common = 0;  ///< actions that both cells have
};

std::int64_t count_common(const std::vector<bool>& one, const std::vector<bool>& other) {
  std::int64_t common = 0;
  for (std::size_t a = 0; a < one.size(); ++a) common += one[a] && other[a] ? 1 : 0;
  return common;
}

class SightFinder {
 public:
  explicit SightFinder(const ExplainContext& context)
      : context_(context),
        grid_(context.posts->grid()),
        delay_(context.values(paths::kDelay)),
        countdown_(context.values(paths::kBlindCountdown)),
        classes_(input_classes(*context.spec, context.posts->inputs(), *context.partition)) {}

  /// A cell of Z_1 that is not in B_1, at the end of so many silent steps. There always is one, if the delay
  /// is longer.
  [[nodiscard]] std::optional<std::int64_t> end_of_silence(std::int32_t steps) {
    std::int64_t cell = context_.cell;
    for (std::int32_t left = steps; left > 0; --left) {
      const std::optional<std::int64_t> next = next_with(cell, left - 1);
      if (!next) return std::nullopt;
      cell = *next;
    }
    return cell;
  }

  /// The two cells whose actions have least in common, the first of equals.
  [[nodiscard]] std::optional<Confusion> find(std::int64_t cell) const {
    const Sets sets = context_.projections(cell);
    std::optional<Confusion> least;
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (!has_silent_table(*context_.spec, *context_.partition, c)) continue;
      for (const std::int64_t other : fibre(c, cell)) {
        if (other == cell || delay_(other) < 1 || is_terminal(other)) continue;
        const std::vector<bool> actions = context_.projections(other)[c];
        const std::int64_t common = count_common(sets[c], actions);
        if (common == std::count(actions.begin(), actions.end(), true)) continue;  // any action serves there
        if (least && common >= least->common) continue;
        least = {c, cell, other, sets[c], actions, common};
        if (common == 0) return least;
      }
    }
    return least;
  }

 private:
  /// Whether a goal that ends the task is reached at the cell: then no agent chooses anything.
  [[nodiscard]] bool is_terminal(std::int64_t cell) const {
    return context_.spec->ends_at_goal() && context_.values(paths::kArrival)(cell) == 0;
  }

  /// The first cell found that can follow under IND_C and has this countdown.
  std::optional<std::int64_t> next_with(std::int64_t cell, std::int32_t countdown) {
    const Sets sets = context_.projections(cell);
    std::optional<std::int64_t> successor;
    context_.posts->move_to(cell);
    for (std::int64_t u = 0; u < context_.posts->inputs().count() && !successor; ++u) {
      bool is_chosen = true;
      for (std::size_t c = 0; c < classes_.size() && is_chosen; ++c)
        is_chosen = sets[c][at(classes_[c].action(u))];
      if (!is_chosen) continue;
      std::vector<IndexRange> box;
      bool has_gone = false;
      for (std::size_t i = 0; i < grid_.size(); ++i) {
        const ResolvedRange range = context_.posts->resolved(i, u);
        has_gone = has_gone || range.blocked || range.all_left();
        box.push_back(range.inside);
      }
      if (has_gone) continue;
      for_each_cell(grid_, box, [&](std::int64_t next) {
        if (countdown_(next) == countdown) successor = next;
        return !successor;
      });
    }
    return successor;
  }

  /// Cells of the fibre of a class, ascending, at most kMostCells.
  [[nodiscard]] std::vector<std::int64_t> fibre(std::size_t c, std::int64_t cell) const {
    const std::vector<std::size_t> seen = seen_states(*context_.spec, context_.partition->classes[c]);
    std::vector<std::size_t> unseen;
    std::vector<std::int64_t> counts;
    std::int64_t first = cell;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (contains(seen, i)) continue;
      unseen.push_back(i);
      counts.push_back(grid_[i].count);
      first -= grid_.index(cell, i) * grid_.stride(i);
    }
    std::vector<std::int64_t> cells;
    Odometer index(counts);
    do {
      std::int64_t other = first;
      for (std::size_t k = 0; k < unseen.size(); ++k) other += index[k] * grid_.stride(unseen[k]);
      cells.push_back(other);
    } while (index.advance() && std::ssize(cells) < kMostCells);
    return cells;
  }

  const ExplainContext& context_;
  const UniformGrid& grid_;
  CellValue delay_, countdown_;
  std::vector<InputClass> classes_;
};

Json steps_json(std::int32_t steps) {
  return steps == kUnbounded || steps < 0 ? Json() : Json(steps);
}

Json centre_json(const UniformGrid& grid, std::int64_t cell) {
  Json json = Json::object();
  for (std::size_t i = 0; i < grid.size(); ++i)
    json[grid[i].name] = nearest_double(grid[i].point(grid.index(cell, i)));
  return json;
}

std::string centre_text(const UniformGrid& grid, std::int64_t cell) {
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", grid[i].name,
                        nearest_double(grid[i].point(grid.index(cell, i))));
  return text;
}

Json actions_json(const std::vector<bool>& actions) {
  Json numbers = Json::array();
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (actions[a]) numbers.push_back(a);
  }
  return numbers;
}

std::string steps_text(std::int32_t steps) {
  return steps == kUnbounded ? "indefinitely" : count_of(steps, "step");
}

void add_confusion(const ExplainContext& context, const Confusion& confusion, Explained& result) {
  const std::vector<std::int32_t>& agents = context.partition->classes[confusion.class_number];
  const std::string name = class_name(context.spec->agents, agents);
  const UniformGrid& grid = context.posts->grid();
  (*result.json)["class"] = name;
  (*result.json)["cells"] = {
      {{"state", centre_json(grid, confusion.cell)}, {"actions", actions_json(confusion.actions)}},
      {{"state", centre_json(grid, confusion.other)}, {"actions", actions_json(confusion.others_actions)}}};
  result.sentences.push_back(fmt::format(
      "It may end at {}, where {} may take {}; but the class cannot distinguish this from {}, "
      "where it may take {}.",
      centre_text(grid, confusion.cell), name, action_text(*context.spec, agents, confusion.actions),
      centre_text(grid, confusion.other), action_text(*context.spec, agents, confusion.others_actions)));
}

}  // namespace

/// Explains the worth of sight at a cell, and where sight is missing: two cells that a class cannot tell
/// apart, in which it has to take different actions, at the end of a shortest way there. Nothing if all
/// agents see everything.
Explained explain_blind(const ExplainContext& context) {
  if (!has_limited_sight(*context.spec)) return {};
  const std::int32_t blind = context.values(paths::kBlindDelay)(context.cell);
  const bool is_less = blind >= 0 && blind < context.delay;
  const bool is_counted = is_less && context.delay != kUnbounded;
  Explained result{.key = "sight", .json = std::make_shared<Json>(Json::object())};
  *result.json = {{"blind_delay", steps_json(blind)},
                  {"steps_less", is_counted                             ? Json(context.delay - blind)
                                 : blind == context.delay && blind >= 0 ? Json(0)
                                                                        : Json()},
                  {"class", Json()},
                  {"cells", Json::array()}};
  if (blind < 0) return result;
  if (!is_less) {
    result.sentences = {"With own observations only, the agents tolerate the same silence."};
    return result;
  }
  result.sentences = {
      is_counted ? fmt::format("With own observations only it is {} less: {}.",
                               count_of(context.delay - blind, "step"), steps_text(blind))
                 : fmt::format("With own observations only, silence ends after {}.", steps_text(blind))};
  SightFinder finder(context);
  const std::optional<std::int64_t> end = finder.end_of_silence(blind);
  const std::optional<Confusion> confusion = end ? finder.find(*end) : std::nullopt;
  if (confusion) add_confusion(context, *confusion, result);
  return result;
}

}  // namespace coordreq
