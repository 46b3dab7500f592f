#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/progress_inputs.hpp"
#include "cell/margin.hpp"
#include "cell/next_states.hpp"
#include "cell/random_stream.hpp"
#include "engine/cell_set.hpp"
#include "engine/packed_pairs.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// How agents choose among the actions that are open to them.
enum class Policy : std::uint8_t {
  random,       ///< uniformly
  adversarial,  ///< together, for the worst next cell
  prefer,       ///< what their `prefer` likes best
};

/// What a closed loop runs on. REQUIRES: all parts belong together and outlive whoever is handed this.
struct LoopProblem {
  const ProblemSpec* spec = nullptr;
  const Abstraction* abstraction = nullptr;
  const PartitionSpec* partition = nullptr;
  std::span<const std::int32_t> delay;   ///< [cells], steps; as DelayLayers names what has none
  const CellSet* safe_beyond = nullptr;  ///< TubeSets::beyond
  const PackedPairs* listed = nullptr;   ///< what `controller.file` lists; null: it has none
  std::int64_t connection_delay = 0;     ///< D, steps
  /// [cells], steps, as the results file has them; both empty without a goal.
  std::span<const std::int32_t> arrival = {};
  std::span<const std::int32_t> approach_delay = {};

  [[nodiscard]] bool has_goal() const { return !arrival.empty(); }
  /// The goal can be forced from the cell, and it is not in the goal.
  [[nodiscard]] bool is_on_the_way(std::int64_t cell) const {
    const std::int32_t steps = arrival[static_cast<std::size_t>(cell)];
    return steps > 0 && steps != INT32_MAX;
  }
};

/// What nature does in one period, and the measuring at its end.
struct Nature {
  std::vector<Rational> disturbance;  ///< one a disturbance, constant within the period
  std::vector<Rational> error;        ///< one a state: measured less true
};

/// Chooses joint inputs. With coordination all agents choose from C(x) together; without it each class
/// chooses from the projection of C(x) onto its inputs, so that together they choose from IND_C(x). On the
/// way to a goal from P(x) and IND_P(x).
///
/// - random: uniform in C(x); uniform in each projection, class after class.
/// - adversarial: of C(x) or IND_C(x) the joint input with the smallest delay of the cell in which the next
///   state will be measured, then the smallest margin of the next state, then the smallest number. It knows
///   what nature will do. Outside K counts as smaller than any delay, T as larger.
/// - prefer: smallest sum of the agents' `prefer` at the nominal next state: over C(x), or, each class for
///   itself and over the sum of its own agents, over its projection; then the smallest number. Nominal: from
///   the measured state, with every disturbance in the middle of its range and, without coordination, the
///   inputs of other classes at their values nearest to 0 (of two the smaller one). An undefined `prefer`
///   counts as infinite.
class ActionChooser {
 public:
  ActionChooser(const LoopProblem& problem, Policy policy, PointDynamics& dynamics);

  /// @param next begun at the true state with what nature does
  /// @param measured the state as it was measured; its cell is `cell`, in K
  /// @param approaching whether to choose from P
  /// @returns nothing if no action is admissible
  [[nodiscard]] std::optional<std::int64_t> choose(std::int64_t cell, std::span<const Rational> measured,
                                                   bool coordinated, bool approaching, NextStates& next,
                                                   RandomStream& random);

  /// Whether `allow` forbids a joint input that was chosen at a cell.
  [[nodiscard]] bool forbids(std::int64_t cell, std::int64_t u) { return inputs_.forbids(cell, u); }

  ActionChooser(const ActionChooser&) = delete;
  ActionChooser& operator=(const ActionChooser&) = delete;
  ~ActionChooser() = default;

 private:
  using Numbers = std::vector<std::int64_t>;

  [[nodiscard]] AdmissibleInputs::Sets sets();

  [[nodiscard]] std::int64_t choose_randomly(RandomStream& random) const;
  [[nodiscard]] std::int64_t choose_worst(NextStates& next);
  [[nodiscard]] std::int64_t choose_preferred(std::int64_t cell, std::span<const Rational> measured);
  /// Each joint input that can be chosen, once.
  template <class Visit>
  void for_each_choice(const Visit& visit) const;
  [[nodiscard]] std::int64_t delay_after(NextStates& next, std::int64_t u) const;
  [[nodiscard]] std::int64_t smallest_margin(NextStates& next, const Numbers& candidates);
  [[nodiscard]] std::int64_t smallest_preference(const std::vector<std::int32_t>& agents,
                                                 const Numbers& candidates);
  void find_nominal();
  void fill(NextStates& next, std::int64_t u);
  void fill_approximately(NextStates& next, std::int64_t u);

  LoopProblem problem_;
  Policy policy_;
  MembersByCell invariant_;
  MembersByCell safe_;
  MembersByCell safe_beyond_;
  CellPosts posts_;
  AdmissibleInputs inputs_;
  ProgressInputs progress_;
  Numbers progressing_;  ///< P(x) of the cell at work
  std::vector<InputClass> classes_;
  std::vector<std::vector<std::int64_t>> class_parts_;  ///< [class][action]: InputClass::parts()
  Margin margin_;
  std::vector<std::optional<PointValue>> prefer_;  ///< by agent
  NextStates nominal_;
  std::vector<Rational> middle_;    ///< of each disturbance
  std::vector<Rational> no_error_;  ///< zeros
  Numbers nominal_parts_;           ///< by input: what its nominal value adds to a joint input
  std::vector<std::vector<double>> input_values_;
  const Numbers* admissible_ = nullptr;  ///< C(x) of the cell at work
  std::vector<Numbers> projections_;     ///< IND_C(x), or one class of all if coordinated: joint input parts
  std::vector<Rational> slots_;
  std::vector<double> doubles_;
};

}  // namespace coordreq
