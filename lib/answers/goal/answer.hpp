#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field_source.hpp"
#include "answers/goal/lasting_goal.hpp"
#include "answers/goal/progress_engine.hpp"
#include "answers/invariance/controller.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/memory_need.hpp"
#include "answers/stage.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// How soon the goal can be reached, and for how long silence costs no time on the way to it (contract,
/// section 5); of a lasting goal the same by section 11.
struct Goal {
  std::unique_ptr<ProgressEngine> engine;
  CellSet cells;    ///< G
  CellSet winning;  ///< W
  CellSet away;     ///< W \ G; of a lasting goal W: where P holds
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

/// Adds Goal, if the spec has one: "arrival", then "approach PARTITION" for each partition.
[[nodiscard]] std::vector<Stage> goal_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed goal_memory(const EngineSizes& sizes, int threads);
void summarise_goal(const Answers& answers, Json& summary, Json& work);
/// Warns of a goal at which no cell arrives, or none but its own.
[[nodiscard]] Warnings advise_on_goal(const Answers& answers);
void tell_goal(const ProblemSpec& spec, const FieldSource& source, Json& info);

/// C in cells without progress, and P on W \ G (of a lasting goal on W): controllers of different cells,
/// which together are the controller of a run towards the goal; without a goal C alone.
struct PartialController {
  Controller controller;
  const RowHull* hull = nullptr;
};
/// The controllers and sets to which a PartialController refers, beside the answers.
struct ControllerParts {
  CellSet rest;  ///< the cells of K where C holds
  std::vector<PartialController> parts;
};
/// @param is_in_goal_only whether C holds in G alone, and not in all of K outside W \ G
[[nodiscard]] std::unique_ptr<const ControllerParts> controller_parts(const Answers& answers,
                                                                      bool is_in_goal_only);

}  // namespace coordreq
