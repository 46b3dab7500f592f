#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "expression/evaluate.hpp"
#include "spec/problem_spec.hpp"
#include "verify/sampled_map.hpp"
#include "verify/sloped.hpp"
#include "verify/time_series.hpp"

namespace coordreq {

/// Bounds of one state of a differential equation after a period, from a box of states, for constant inputs
/// and any measurable disturbances.
///
/// 1. Sub-steps with boxes that no solution leaves (Picard) bound the Jacobians along all solutions, and
/// products
///    of exp(J h) the sensitivity M of the end to the initial state.
/// 2. Where all entries of M's row keep their sign, both extremes come from corners of the box: the solutions
/// from
///    there are enclosed by Taylor series in time.
/// 3. Else the box is halved in a variable without sign; what is left after some halvings starts in the
/// middle and
///    the mean value theorem adds the rest.
///
/// Over-approximates. Not thread-safe: one object a thread.
class FlowBounds {
 public:
  /// The least and the greatest end of the solutions from a box: each lies within an interval that holds the
  /// end of some solution.
  struct Ends {
    Interval least;
    Interval greatest;
  };

  /// @param duration from the beginning to the end, instead of the period
  /// REQUIRES: `spec` outlives this object; no `stop` at the limits of the states concerned.
  FlowBounds(const ProblemSpec& spec, const Influences& influences, std::size_t state,
             const Rational& duration);
  FlowBounds(const ProblemSpec& spec, const Influences& influences, std::size_t state)
      : FlowBounds(spec, influences, state, spec.dynamics.period) {}

  /// @param slots boxes of all variables by slot
  /// @param halvings of the box in variables without sign, at most
  /// @returns nothing where a solution may escape, or the equations jump or are not defined
  [[nodiscard]] std::optional<Interval> after_period(const std::vector<Interval>& slots, int halvings);
  /// The same, its two ends apart. A disturbance of constant size brings each of them about, or nearly.
  [[nodiscard]] std::optional<Ends> ends(const std::vector<Interval>& slots, int halvings);

  /// How the state moves along all solutions.
  struct Motion {
    std::vector<Interval> slope;    ///< bounds of its derivative over each of some equal parts of the period
    bool stays_above_start = true;  ///< never gets below its initial box: the derivative does not point out
    bool stays_below_start = true;  ///< likewise above it
  };
  /// @returns nothing as above
  [[nodiscard]] std::optional<Motion> motion(const std::vector<Interval>& slots, int parts);

 private:
  using Box = std::vector<Interval>;     ///< by slot
  using Matrix = std::vector<Interval>;  ///< n x n, row-major
  using Place = std::vector<double>;

  [[nodiscard]] std::optional<Ends> bounds(Box& box, int halvings_left);
  [[nodiscard]] bool find_sensitivity(const Box& box, int step_count);
  [[nodiscard]] bool is_wall(Box tube, const Interval& outside, bool upper);
  [[nodiscard]] bool find_jacobian(const Box& tube);
  [[nodiscard]] bool enclose_solutions(const Box& start, const Interval& duration, Box& tube);
  [[nodiscard]] std::optional<Interval> end_from(const Box& box, bool upper);
  [[nodiscard]] std::optional<Interval> solution_from(const Box& point);
  [[nodiscard]] bool advance(Box& now, const Interval& duration, bool last_try);

  const ProblemSpec* spec_;
  std::size_t n_;
  std::size_t m_;
  std::size_t position_ = 0;  ///< of the state among the moving ones
  Interval period_;
  std::vector<std::uint32_t> state_slots_;
  std::vector<std::uint32_t> disturbance_slots_;
  std::vector<Evaluator<Sloped<Interval>>> sloped_;
  TimeSeries series_;
  Matrix jacobian_;                    ///< n x n
  std::vector<Interval> input_slope_;  ///< n x m: by disturbances
  std::vector<Interval> sensitivity_;  ///< row of M
  std::vector<Interval> kernel_;       ///< by disturbance: hull over all times
  std::map<Place, std::optional<Interval>> known_;
};

}  // namespace coordreq
