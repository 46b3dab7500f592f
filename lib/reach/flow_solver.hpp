#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reach/affine_kernel.hpp"
#include "reach/face_flow.hpp"
#include "reach/flow_sensitivity.hpp"
#include "reach/nominal_flow.hpp"
#include "reach/validated_flow.hpp"

namespace coordreq {

/// A sub-step of the flow, as needed to follow solutions through it.
struct FlowStep {
  Interval duration;
  std::vector<Interval> start;  ///< where all solutions are at its beginning; only of long steps
  bool smooth = false;          ///< the remainder holds for every solution from the initial box
  TaylorRemainder remainder;
  Choices choices;
  UpwardMatrix transition;  ///< of the difference of two solutions
};

/// A solution that is followed from a corner of the boxes of initial states and of disturbances, or from the
/// middle in some variables.
struct FollowedSolution {
  enum class End : std::uint8_t { any, lower, upper, middle };
  std::vector<End> ends;     ///< states, then disturbances
  NominalFlow::State state;  ///< after `steps_done` steps
  std::size_t steps_done = 0;
};

/// An enclosure of a followed solution: {middle} + by.
struct Deviation {
  Deviation() = default;
  explicit Deviation(std::size_t states) : middle(states), by(states) {}

  std::vector<Interval> middle;  ///< points
  std::vector<UpwardInterval> by;
  bool wide = false;  ///< not all of `by` is 0

  void split(std::span<const Interval> state);
  /// Adds to `state`, where the middle has got to, what the transition matrix makes of `by`.
  void carry_on(const UpwardMatrix& transition, std::vector<Interval>& state) const;
};

/// The work behind ValidatedFlow; see there.
class ValidatedFlow::Solver {
 public:
  Solver(FlowSystem system, const Interval& period);

  const FlowEnclosure& flow(std::span<const Interval> slots);
  const FlowEnclosure& flow_of_subbox(std::span<const Interval> slots, bool long_steps);
  [[nodiscard]] bool keeps_apart(std::span<const Interval> box);

  [[nodiscard]] std::int64_t extra_steps() const;
  [[nodiscard]] std::int64_t steps() const { return all_tries_ + extra_steps(); }
  [[nodiscard]] const FlowSystem& system() const { return system_; }
  [[nodiscard]] const Interval& period() const { return period_; }

 private:
  using End = FollowedSolution::End;

  // Steps (flow_solver.cpp).
  void begin(std::span<const Interval> slots);
  bool run_steps(std::size_t most_steps, bool patient);
  std::optional<FlowFailure> try_step(const Interval& duration, bool divisible);
  std::optional<FlowFailure> try_step_on_seam(const Interval& duration);
  [[nodiscard]] bool twice_is_too_long();
  void set_tolerance();
  void find_damping(const Interval& duration);
  bool append_sensitivity(const Interval& duration, bool divisible);
  void finish_step(bool last);
  void restart();
  [[nodiscard]] std::size_t fastest() const;
  void note_rates();
  void fail(const FlowFailure& failure);
  FlowStep& next_step();

  // More work for a tighter result (refine_flow.cpp).
  void enclose(std::span<const Interval> slots, int halvings);
  [[nodiscard]] bool is_too_wide() const;
  [[nodiscard]] bool is_anywhere() const;
  [[nodiscard]] double allowed_excess(std::size_t i) const;
  [[nodiscard]] bool is_tight() const;
  [[nodiscard]] bool is_smooth() const;
  void enclose_halves(std::span<const Interval> slots, int halvings);
  [[nodiscard]] std::size_t most_uncertain() const;
  bool bound_by_faces(std::span<const Interval> slots, bool found);
  void note_reached();

  // Solutions that are followed (follow_extremes.cpp).
  void set_start(FollowedSolution& solution) const;
  void set_disturbances(const std::vector<End>& ends);
  void restore_disturbances();
  bool advance(const FlowStep& step, NominalFlow::State& state);
  void keep_within(const FlowStep& step, std::vector<Interval>& state) const;
  void advance_smoothly(const FlowStep& step, std::vector<Interval>& state);
  void take_solutions_along();
  void advance_along(std::size_t along, FollowedSolution& solution);
  bool follow(std::size_t s);
  void choose_ends(std::size_t i, bool upper, std::vector<End>& ends) const;
  std::size_t solution_for(const std::vector<End>& ends);
  void follow_extremes(bool last);
  void integrate_affine_kernels();
  [[nodiscard]] double deviation(std::size_t i, bool upper, const std::vector<End>& ends) const;
  void note_attained(const FollowedSolution& solution);
  void use_extreme(std::size_t i, bool upper, const FollowedSolution& solution, const std::vector<End>& ends);

  FlowSystem system_;
  Interval period_;
  std::size_t n_;
  std::size_t m_;
  FlowTape tape_;
  VectorField field_;
  Jacobian jacobian_;
  TransitionMatrix transition_;
  FlowSensitivity sensitivity_;
  TaylorStep taylor_;
  std::optional<TangentStep> tangent_;  ///< nothing if there are disturbances, kinks, limits or seams
  NominalFlow nominal_;
  AffineKernel affine_kernel_;
  FaceFlow faces_;
  FlowEnclosure by_faces_;

  std::vector<FlowStep> steps_;
  std::size_t step_count_ = 0;  ///< since the start, or since the last restart
  std::size_t tries_ = 0;
  std::uint32_t first_ticks_ = 0;  ///< of the last box's first step
  std::int64_t all_tries_ = 0;     ///< of all boxes
  std::vector<FollowedSolution> solutions_;
  std::size_t solution_count_ = 0;
  std::vector<std::vector<End>> wanted_;  ///< lower and upper extreme of every state: where it comes from
  std::vector<std::size_t> solution_of_;  ///< the same: index into solutions_

  std::vector<Interval> initial_;      ///< box of initial states
  std::vector<Interval> disturbance_;  ///< their boxes
  std::vector<Interval> now_;          ///< box of the states after the steps so far
  std::vector<Interval> box_;          ///< during the step
  std::vector<Interval> derivative_;
  std::vector<Interval> next_;
  /// Solutions whose step is computed along with the remainder: those that are likely to be asked for.
  struct Along {
    std::size_t solution = 0;
    Deviation start;
  };
  std::array<Along, TaylorStep::kMostAlong> along_;
  std::size_t along_count_ = 0;
  Deviation alone_;
  std::vector<Interval> slots_;
  std::vector<bool> damped_;
  std::vector<bool> none_held_;
  std::vector<double> tolerance_;
  std::vector<Interval> attained_;  ///< hull of solutions that were followed to the end; empty: none
  std::vector<double> allowed_excess_;
  bool restarted_ = false;  ///< they were not followed from the start
  double fastest_decay_ = 0.0;
  double fastest_growth_ = 0.0;
  std::size_t stiffest_ = 0;
  bool gave_up_ = false;
  bool always_smooth_;                ///< no step meets a kink, a limit or a seam
  bool takes_long_steps_ = false;     ///< tangents tell how far solutions diverge in them
  bool may_take_long_steps_ = false;  ///< if the box is part of a line
  bool is_subbox_ = false;            ///< the box is divided further where that pays
  bool all_free_ = true;              ///< no state may run into a limit in this step
  bool ever_stopped_ = false;         ///< in an earlier one it might
  FlowEnclosure result_;
};

}  // namespace coordreq
