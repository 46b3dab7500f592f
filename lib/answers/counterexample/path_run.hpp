#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/counterexample/counterexample.hpp"
#include "answers/counterexample/nominal_run.hpp"
#include "answers/counterexample/path_search.hpp"
#include "answers/one_cell/cell_posts.hpp"

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

/// A counterexample that grows step by step, and the system itself beside it: a walk for PathSearch. With
/// several processes together: each step is found by the one that owns the cell.
class PathRun {
 public:
  /// @pre unchecked: `problem` outlives this object.
  explicit PathRun(const CounterexampleProblem& problem);
  PathRun(const PathRun&) = delete;
  PathRun& operator=(const PathRun&) = delete;
  virtual ~PathRun() = default;

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

 protected:
  /// Adds a step to the path, from the last cell, which this process owns. @returns whether to go on
  virtual bool add_step() = 0;
  /// Which to take of equal joint inputs that the system itself can follow.
  [[nodiscard]] std::int64_t number() const { return number_; }
  void set_more(bool has_more) { last_.has_more = has_more; }

  const CounterexampleProblem& problem_;
  const AnalysisContext& context_;
  TubeSets tubes_;
  CellPosts posts_;
  CellPath path_;
  std::size_t phase_ = 0;  ///< of the next step
  NominalRun real_;

 private:
  /// What the process that owns a cell says of a step to the others, beside the step.
  struct Progress {
    bool goes_on = true;
    bool has_more = false;  ///< there are equal steps that the system itself can follow
    Reached reached;
  };

  void step_here();
  [[nodiscard]] Bytes last_step(std::size_t inputs, std::size_t cells) const;
  void read(const Bytes& message);

  std::int64_t number_ = 0;
  Progress last_;
};

}  // namespace coordreq
