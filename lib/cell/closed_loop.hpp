#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/thread_team.hpp"
#include "cell/action_choice.hpp"
#include "cell/schedule.hpp"

namespace coordreq {

/// The self-triggered closed loop on the system itself (paper, Definition 3), measured into cells [a, b).
///
/// At a start in x, and after each coordinated step into x: if delay(x) >= D the connection is dropped and a
/// countdown of delay(x) begins. While it is above 0 the agents act from IND_C, and start to connect when it
/// is D; at 0 they coordinate: they act from C. If delay(x) < D the connection stays and the next step is
/// coordinated too. Cells of unbounded delay never coordinate again.
///
/// That is the policy of the delays. Where a countdown begins in a cell in which another policy holds, it is
/// that one's, and so is what the agents act from. If it has an aim, it is followed until that is reached;
/// a run that begins with it is there within the steps that its start has. (On the way to a goal, contract,
/// section 5: approach delay, P and IND_P, within arrival(start) steps.) An aim that lasts, of a goal to stay
/// at or to return to, is followed indefinitely; what its policy promises of each step is looked at (section
/// 11).
///
/// On a network that loses steps (LoopProblem::network) agents act by the mode of each step: from C if all
/// are connected, else from IND_C of those that are. A run that leaves K is no contradiction then.
/// A policy whose countdown follows from what was agreed, not from the cell that is next, begins with a
/// coordinated step. (Of agents who see only themselves, contract, section 8.)
///
/// A run that reaches a goal which ends the task ends there, whatever agents go by.
///
/// Agents who do what they are told while they are silent (the last policy is about all of S; contract,
/// section 9) have the promise that S holds at the first silence(start) samples; and at all of them, if no
/// more steps than that are silent. What happens later is no contradiction.
///
/// Holds the scratch memory of a run: one object a thread.
class ClosedLoop {
 public:
  ClosedLoop(const LoopProblem& problem, const LoopOptions& options);

  /// @param measured the state as first measured; the true one is off by a measurement error
  /// @param run number of the run: the random streams depend on it, the seed and nothing else
  /// @pre the cell of `measured` is in K; of agents who do what they are told, in theirs
  [[nodiscard]] RunTrace run(std::vector<Rational> measured, std::uint64_t run);

 private:
  struct State {
    std::vector<Rational> exact;
    std::vector<Rational> measured;
    NextStates::CellLocation location;
  };

  [[nodiscard]] bool is_in_k(const std::vector<Rational>& measured) const;
  [[nodiscard]] Nature draw_nature(RandomStream& random) const;
  [[nodiscard]] State first_state(std::vector<Rational> measured, const Nature& nature) const;
  void advance(State& state, std::int64_t u, const Nature& nature);
  void add_sample(const State& state, RunTrace& trace);
  /// It has come to a goal in which runs end.
  [[nodiscard]] bool is_at_end(const RunTrace& trace) const { return ends_in_goal_ && trace.arrived; }
  [[nodiscard]] bool is_beyond_goal_side(const State& state) const;

  LoopProblem problem_;
  LoopOptions options_;
  PointDynamics dynamics_;
  KeptInputs controller_;
  std::unique_ptr<Schedule> schedule_;
  NextStates next_;
  Margin margin_;
  std::optional<Margin> goal_;  ///< one that lasts
  std::vector<Rational> slots_;
  std::span<const std::int32_t> delay_;
  std::span<const std::int32_t> to_aim_;  ///< [cells] steps; empty: there is no aim
  bool ends_in_goal_;                     ///< runs do
};

/// Many runs in parallel; the same whatever the number of threads.
///
/// Uniform over K: a cell of K and a point of the cell [a, b), each with equal chances (the point on a
/// lattice of 2^-32 of the cell); drawn again if the point is beyond a `stop` limit, where no state is.
///
/// @pre `options.start` lies in a cell of K; K is not empty
/// @throws LimitError if an exact state grows too long
[[nodiscard]] std::vector<RunTrace> simulate_runs(const LoopProblem& problem, const LoopOptions& options,
                                                  ThreadTeam& team);

/// There is a cell of K to start from, in which all that memories keep is as at first.
/// @param steps [cells] negative outside K
[[nodiscard]] bool has_start(const SystemSpec& spec, std::span<const std::int32_t> steps);

}  // namespace coordreq
