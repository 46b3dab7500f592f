#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "answers/checking/class_choices.hpp"
#include "answers/counterexample/counterexample.hpp"
#include "answers/counterexample/nominal_run.hpp"
#include "answers/counterexample/path_search.hpp"
#include "answers/counterexample/step_finder.hpp"
#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "answers/one_cell/progress_inputs.hpp"

namespace coordreq {

/// The cells of a counterexample and what leads from one to the next.
struct CellPath {
  std::vector<std::int64_t> cells;         ///< one more than steps, unless the last action leads to no cell
  std::vector<std::int64_t> joint_inputs;  ///< one a step
  std::vector<PathPhase> phases;           ///< one a step
  PathEnd end = PathEnd::outside_safe_set;
  std::vector<DomainSide> sides;  ///< through which the last action leads, if `left_domain`
  std::int64_t followed = 0;      ///< steps from the start that the system itself can follow
};

/// Where the system itself is after a step; beyond a `safe` side it is in all sets.
struct Reached {
  NominalRun::Successor successor;
  bool is_inside = false;  ///< in CounterexampleProblem::inside
  bool is_safe = false;
};

/// A counterexample that grows step by step, phase by phase (path_steps.cpp), and the system itself beside
/// it: a walk for PathSearch. With several processes together: each step is found by the one that owns the
/// cell.
class PathRun {
 public:
  /// @pre unchecked: `problem` outlives this object.
  explicit PathRun(const CounterexampleProblem& problem);
  PathRun(const PathRun&) = delete;
  PathRun& operator=(const PathRun&) = delete;
  ~PathRun() = default;

  /// Starts the system itself at a state, or at the centre of the cell.
  void start_at(std::int64_t cell, const std::optional<std::vector<Rational>>& start);
  /// Begins a path in a cell, that of the system itself.
  void begin_path(std::int64_t cell);

  /// Where the system itself is; nothing if it is no longer followed.
  [[nodiscard]] std::optional<FollowedState> position() const;
  void go_to(const FollowedState& position);
  /// Takes a step, and the system itself with it. @returns the number of looks at joint inputs
  std::int64_t step(std::int64_t number);
  /// Whether there are equal steps of greater numbers than the last one.
  [[nodiscard]] bool has_more() const { return last_.has_more; }
  /// Whether the system itself has followed to the end, but for a last action that leads to no cell.
  [[nodiscard]] bool is_whole() const;

  /// Takes a step of the path; the system itself stays.
  void step_alone(std::int64_t number);
  /// Moves the system itself to reached(), after step_alone().
  void advance() { real_.advance(path_.joint_inputs.back(), last_.reached.successor); }
  [[nodiscard]] const Reached& reached() const { return last_.reached; }
  [[nodiscard]] bool goes_on() const { return last_.goes_on; }
  [[nodiscard]] CellPath& path() { return path_; }

 private:
  /// What the process that owns a cell says of a step to the others, beside the step.
  struct Progress {
    bool goes_on = true;
    bool has_more = false;  ///< there are equal steps that the system itself can follow
    Reached reached;
  };

  /// Adds a step to the path, from the last cell, which this process owns. @returns whether to go on
  bool add_step();
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

  void step_here();
  [[nodiscard]] Bytes last_step(std::size_t inputs, std::size_t cells) const;
  void read(const Bytes& message);

  const CounterexampleProblem& problem_;
  const AnalysisContext& context_;
  const UniformGrid& grid_;
  TubeSets tubes_;
  CellPosts posts_;
  CellPath path_;
  std::size_t phase_ = 0;    ///< of the next step
  std::int64_t number_ = 0;  ///< which to take of equal joint inputs that the system itself can follow
  Progress last_;
  NominalRun real_;
  MembersByCell invariant_, safe_, beyond_;
  AdmissibleInputs inputs_;
  ProgressInputs progress_;
  std::array<std::optional<ClassChoices>, 3> choices_;  ///< by ClassChoices::Rules
  StepFinder steps_;
};

}  // namespace coordreq
