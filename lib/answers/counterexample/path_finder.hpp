#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "answers/checking/class_choices.hpp"
#include "answers/counterexample/path_run.hpp"
#include "answers/counterexample/step_finder.hpp"
#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/progress_inputs.hpp"

namespace coordreq {

/// Finds the steps of a counterexample, phase by phase.
class PathFinder : public PathRun {
 public:
  /// @pre unchecked: `problem` outlives this object.
  explicit PathFinder(const CounterexampleProblem& problem);

 private:
  bool add_step() override;
  bool take_by(const CounterexamplePhase& phase);
  bool take_together();
  void lose_time();
  bool take(const std::optional<StepChoice>& choice, const StepsFrom& steps, PathPhase phase);
  void add_choice(std::int64_t u, PathPhase phase);
  void end_at_block(const CellPost& post, bool is_forbidden);

  [[nodiscard]] AdmissibleInputs::Sets members();
  [[nodiscard]] const ClassChoices* choices_at(std::int64_t cell, PathPhase phase);
  [[nodiscard]] std::int64_t soonest(std::int64_t u, std::int32_t worst);
  [[nodiscard]] std::pair<std::int32_t, std::int64_t> choose_together(std::int64_t cell);

  const UniformGrid& grid_;
  MembersByCell invariant_, safe_, beyond_;
  AdmissibleInputs inputs_;
  ProgressInputs progress_;
  std::array<std::optional<ClassChoices>, 3> choices_;  ///< by ClassChoices::Rules
  StepFinder steps_;
};

}  // namespace coordreq
