#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/kept_inputs.hpp"
#include "answers/one_cell/policy.hpp"
#include "cell/lossy_network.hpp"
#include "cell/next_margin.hpp"
#include "cell/next_states.hpp"
#include "cell/random_stream.hpp"
#include "cell/simulation.hpp"
#include "engine/cell_set.hpp"
#include "engine/packed_pairs.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// The data of a closed loop. @pre unchecked: all members belong together and outlive the users of this
/// object.
struct LoopProblem {
  const ProblemSpec* spec = nullptr;
  const Abstraction* abstraction = nullptr;
  const PartitionSpec* partition = nullptr;
  /// The policies of the agents: in each cell the last one that holds there counts. The first is that of the
  /// delays.
  std::vector<AnswerPolicy> policies;
  /// [path][cell] steps, as the results file has them, of the delays and aims of the policies.
  std::map<std::string, std::span<const std::int32_t>> values;
  const ByteTables* tables = nullptr;    ///< those that the policies ask for; null: none
  const CellSet* safe_beyond = nullptr;  ///< TubeSets::beyond
  const PackedPairs* listed = nullptr;   ///< what `controller.file` lists; null: it has none
  std::int64_t connection_delay = 0;     ///< D, steps
  /// Who is connected in a step, drawn step by step; null: agents are silent for as long as they can.
  const LossyNetwork* network = nullptr;
  /// [mode] what safest_policy() asks of cells, beside `values`; none: agents take anything in C(x).
  std::vector<std::map<std::string, std::span<const std::int32_t>>> mode_values = {};

  /// [cells]; DelayLayers names what has none.
  [[nodiscard]] std::span<const std::int32_t> delay() const { return values.at(policies.front().delay); }
  /// [cells] Runs start where they are not negative: delays, or the steps of a policy about all of S, the
  /// last.
  [[nodiscard]] std::span<const std::int32_t> start_steps() const {
    return policies.back().is_anywhere ? values.at(policies.back().delay) : delay();
  }
};

/// The disturbances of one period, and the measurement errors at its end.
struct Nature {
  std::vector<Rational> disturbance;  ///< one a disturbance, constant within the period
  std::vector<Rational> error;        ///< one a state: measured less true
};

/// Chooses joint inputs from what a policy leaves: with coordination all agents together, else each class for
/// itself.
///
/// - random: uniform in the joint inputs; uniform in the actions of each class, class after class.
/// - adversarial: of all that can be chosen the joint input with the smallest delay of the cell in which the
/// next
///   state will be measured, then the smallest margin of the next state, then the smallest number. It knows
///   what nature will do. Outside K counts as smaller than any delay, T as larger.
/// - prefer: smallest sum of the agents' `prefer` at the nominal next state, or, each class for itself, over
///   the sum of its agents; then the smallest number. Nominal: from
///   the measured state, with every disturbance in the middle of its range and, without coordination, the
///   inputs of other classes at their values nearest to 0 (of two the smaller one). An undefined `prefer`
///   counts as infinite.
class ActionChooser {
 public:
  /// @param controller C, as far as it is kept: of `problem`, whatever its partition and policies
  /// @pre unchecked: all outlive this object
  ActionChooser(const LoopProblem& problem, Policy policy, PointDynamics& dynamics, KeptInputs& controller);

  /// Whether a policy, by its position among LoopProblem::policies, holds in a cell.
  [[nodiscard]] bool holds(std::size_t policy, std::int64_t cell) {
    return cell_policies_[policy]->holds(cell);
  }

  /// The policy that agents follow, and the steps for which they are still silent; at 0 they coordinate.
  struct Turn {
    std::size_t policy = 0;
    std::int32_t countdown = 0;
    bool is_after_silence = false;  ///< they go by what comes after it (AnswerPolicy::make_then)
  };
  /// @param next begun at the true state with what nature does
  /// @param measured the state as it was measured; its cell is `cell`, in K, or in S if the policy is about
  /// all of it
  /// @returns nothing if no action is admissible
  [[nodiscard]] std::optional<std::int64_t> choose(std::int64_t cell, std::span<const Rational> measured,
                                                   Turn turn, NextStates& next, RandomStream& random);

  /// See CellPolicy::countdown_after().
  [[nodiscard]] std::optional<std::int32_t> countdown_after(std::size_t policy, std::int64_t cell,
                                                            std::int64_t u) {
    return cell_policies_[policy]->countdown_after(cell, u);
  }

  /// Whether `allow` forbids a joint input that was chosen at a cell.
  [[nodiscard]] bool forbids(std::int64_t cell, std::int64_t u) { return inputs_.forbids(cell, u); }

  ActionChooser(const ActionChooser&) = delete;
  ActionChooser& operator=(const ActionChooser&) = delete;
  ~ActionChooser() = default;

 private:
  using Numbers = std::vector<std::int64_t>;

  [[nodiscard]] AdmissibleInputs::Sets sets();
  /// C(x), none outside K.
  [[nodiscard]] const Numbers& controller(std::int64_t cell);

  [[nodiscard]] std::int64_t choose_randomly(RandomStream& random) const;
  [[nodiscard]] std::int64_t choose_worst(NextStates& next);
  [[nodiscard]] std::int64_t choose_preferred(std::int64_t cell, std::span<const Rational> measured);
  /// Each joint input that can be chosen, once.
  template <class Visit>
  void for_each_choice(const Visit& visit) const;
  [[nodiscard]] std::int64_t delay_after(NextStates& next, std::int64_t u) const;
  [[nodiscard]] std::int64_t smallest_preference(const std::vector<std::int32_t>& agents,
                                                 const Numbers& candidates);
  void find_nominal();
  void fill(NextStates& next, std::int64_t u);
  void fill_approximately(NextStates& next, std::int64_t u);

  LoopProblem problem_;
  Policy policy_;
  std::span<const std::int32_t> compared_;  ///< [cells] what is worst to an adversary: delays, or silence
  std::span<const std::int32_t> delay_;
  MembersByCell invariant_;
  MembersByCell safe_;
  MembersByCell safe_beyond_;
  CellPosts posts_;
  AdmissibleInputs inputs_;
  KeptInputs* controller_;
  std::vector<std::unique_ptr<CellPolicy>> cell_policies_, then_;  ///< [policy]
  std::vector<InputClass> classes_;
  std::vector<std::vector<std::int64_t>> class_offsets_;  ///< [class][action]: InputClass::offsets()
  NextMargin margin_;
  std::vector<std::optional<PointValue>> prefer_;  ///< by agent
  NextStates nominal_;
  std::vector<Rational> middle_;    ///< of each disturbance
  std::vector<Rational> no_error_;  ///< zeros
  Numbers nominal_offsets_;         ///< by input: what its nominal value adds to a joint input
  std::vector<std::vector<double>> input_values_;
  /// [class], or one list if coordinated: offsets of joint inputs that may be chosen in the cell at work.
  std::vector<Numbers> choices_;
  std::vector<Rational> slots_;
  std::vector<double> doubles_;
};

}  // namespace coordreq
