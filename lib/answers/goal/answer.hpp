#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "answers/answer.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/goal/lasting_goal.hpp"
#include "answers/goal/progress_engine.hpp"
#include "choices/controller.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// How soon the goal can be reached, and for how long silence costs no time on the way to it (contract,
/// section 5); of a lasting goal the same by section 11.
struct Goal {
  std::unique_ptr<ProgressEngine> engine;
  CellSet cells;         ///< G
  CellSet winning;       ///< W
  CellSet outside_goal;  ///< W \ G; of a lasting goal W: where P holds
  struct Sizes {
    std::int64_t cells = 0;    ///< |G|
    std::int64_t winning = 0;  ///< |W|
    std::int64_t safe = 0;     ///< cells of S in the goal, also those that cannot be kept safe
  };
  Sizes sizes;
  LevelMap nearness;                    ///< of all cells, see find_nearness()
  std::optional<std::int32_t> longest;  ///< the greatest finite arrival
  LongestReturns returns;               ///< of a goal to return to
  LevelMap bounds;                      ///< of a lasting goal: Controller::bounds of P
  Controller progress;                  ///< P, where it holds
  std::vector<DelayLayers> approach;    ///< [partition]
  WaveCounts counts;
};

/// C in cells without progress, and P on W \ G (of a lasting goal on W): controllers of different cells,
/// which together are the controller of a run towards the goal; without a goal C alone.
struct PartialController {
  Controller controller;
  const RowHull* hull = nullptr;
};
/// The controllers and sets to which a PartialController refers, beside the answers.
struct PiecewiseController {
  CellSet rest;  ///< the cells of K where C holds
  std::vector<PartialController> pieces;
};
/// @param is_in_goal_only whether C holds in G alone, and not in all of K outside W \ G
[[nodiscard]] std::unique_ptr<const PiecewiseController> piecewise_controller(const Answers& answers,
                                                                              bool is_in_goal_only);

extern const Answer goal_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields goal_fields(const ProblemSpec& spec);
void fill_goal_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);
[[nodiscard]] std::vector<AnswerPolicy> goal_policies(const ProblemSpec& spec);
/// @pre unchecked: there is a goal
[[nodiscard]] std::unique_ptr<CellPolicy> make_goal_policy(const PolicyContext& context);

}  // namespace coordreq
