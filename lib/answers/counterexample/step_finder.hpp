#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "answers/counterexample/counterexample.hpp"
#include "answers/counterexample/nominal_run.hpp"
#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "engine/tube_sets.hpp"

namespace coordreq {

/// A joint input, its post, and the steps from the worst cell in the post.
struct StepChoice {
  std::int64_t joint_input = 0;
  std::int64_t steps = INT64_MAX;
  CellPost post;
  bool is_forbidden = false;
  bool has_more = false;  ///< there are later equal joint inputs that the system itself can follow, too
};

/// Finds the steps of a counterexample, one cell after the other.
class StepFinder {
 public:
  using IsWanted = std::function<bool(std::int64_t)>;  ///< of a joint input, of a cell
  /// Instead of a number of steps to look for: the least that occurs.
  static constexpr std::int64_t kLeast = -1;

  /// @pre unchecked: all outlive this object.
  StepFinder(const CounterexampleProblem& problem, CellPosts& posts, AdmissibleInputs& inputs,
             NominalRun& real)
      : problem_(problem), posts_(posts), inputs_(inputs), real_(real), tubes_(problem.context->tubes()) {}

  /// A candidate from whose worst successor the wanted number of steps is left: of those with which the
  /// system itself comes to such a cell, too, number `number`; if there are none, the lowest-numbered
  /// candidate.
  [[nodiscard]] std::optional<StepChoice> find(std::int64_t cell, const StepsFrom& steps, std::int64_t target,
                                               const IsWanted& is_candidate, std::int64_t number);
  /// A wanted cell of a post: the cell of the system itself after the step, else the lowest-numbered;
  /// negative: there is none.
  [[nodiscard]] std::int64_t next_cell(std::int64_t cell, const CellPost& post, std::int64_t u,
                                       const IsWanted& is_wanted);
  /// Whether a cell is in a post. (Where the system itself is followed in floating point it may miss its post
  /// by a rounding.)
  [[nodiscard]] static bool holds(const UniformGrid& grid, const CellPost& post, std::int64_t cell);
  /// The number of a cell in the grid of the spec.
  [[nodiscard]] std::int64_t number_of(std::int64_t cell) const;

 private:
  using Known = std::map<std::vector<IndexRange>, std::int64_t>;

  [[nodiscard]] std::int64_t least_steps(const CellPost& post, const StepsFrom& steps, Known& known) const;
  [[nodiscard]] bool follows(std::int64_t cell, const StepChoice& choice, const StepsFrom& steps);
  [[nodiscard]] std::int64_t real_cell(std::int64_t cell, const CellPost& post, std::int64_t u);

  const CounterexampleProblem& problem_;
  CellPosts& posts_;
  AdmissibleInputs& inputs_;
  NominalRun& real_;
  TubeSets tubes_;
};

}  // namespace coordreq
