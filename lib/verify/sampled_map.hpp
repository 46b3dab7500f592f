#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"
#include "verify/time_polynomial.hpp"

namespace coordreq {

/// The influences on the next value of a state: the variables of its equation in discrete time, or of its
/// update; in continuous time also those of the equations of all states it depends on. Indices into the
/// spec's lists, ascending.
struct Influences {
  std::vector<std::size_t> moving;      ///< states that vary over a cell, or between samples
  std::vector<std::size_t> parameters;  ///< discrete states, put in value by value
  std::vector<std::size_t> inputs;
  std::vector<std::size_t> disturbances;
  [[nodiscard]] bool operator==(const Influences&) const = default;
};
[[nodiscard]] Influences influences_on(const SystemSpec& spec, std::size_t state);
/// Where a state is among the moving ones; nothing for a parameter.
[[nodiscard]] std::optional<std::size_t> row_of(const Influences& influences, std::size_t state);

/// A moving state v that a `stop` limit may hold on the way, v' in [slowest, fastest] but there: what comes
/// of it, monotone in its present value and in v'.
struct StoppedTerm {
  std::size_t moving = 0;   ///< its place in Influences::moving
  bool rises = true;        ///< with them; else it falls
  TimePolynomial response;  ///< to a unit that v moves, so much time ago
  Rational slowest;
  Rational fastest;
};

/// One state a period later, as a function of the moving states x now:
/// { sum_j coefficient[j] x_j + r : lower <= r <= upper }, and what comes of states that are stopped.
struct SampledMap {
  /// The derivative of the state: { sum_j slope[j] x_j + r : slowest <= r <= fastest }.
  struct Rate {
    std::vector<Rational> slope;  ///< one for each of Influences::moving
    Rational slowest;
    Rational fastest;
  };

  std::vector<Rational> coefficient;  ///< one for each of Influences::moving; 0 for those that are stopped
  std::vector<StoppedTerm> stopped;
  std::optional<Rate> rate;  ///< where limits may stop states
  Rational lower;
  Rational upper;
  bool exact = true;  ///< every r is taken by some disturbance; else the range is an enclosure
};

/// Solves one state for fixed inputs and parameters in rational arithmetic (FLINT's). In continuous time by
/// the matrix exponential as the finite sum of A^k tau^k / k!, A nilpotent; a disturbance of range m +- r
/// adds m integral(g) +- r integral(|g|), g(s) its entry of exp(A s) B.
/// @param slots values of parameters and inputs at their slots
/// Limits may stop states in whose equations no state is.
/// @returns nothing if the equations are not of this kind for these values
[[nodiscard]] std::optional<SampledMap> sampled_map(const SystemSpec& spec, const Influences& influences,
                                                    std::size_t state, const std::vector<Rational>& slots);

/// A state during the period, as a function of the moving states x at its beginning: at time t in
/// [0, tau] within { sum_j coefficient[j](t) x_j + r : lower(t) <= r <= upper(t) }.
struct TimedMap {
  std::vector<TimePolynomial> coefficient;  ///< one for each of Influences::moving
  TimePolynomial lower;
  TimePolynomial upper;
  /// Values r(t) that constant disturbances bring about; none where r is not known exactly.
  std::vector<TimePolynomial> attained;
  bool exact = true;  ///< `lower` and `upper` are attained
};

/// Solves one state at all times of the period, by the truncated exponential series. A disturbance of range
/// m +- r adds m integral(g) +- r integral(|g|) as above, where |g| is bounded term by term if g changes its
/// sign.
/// @returns nothing where sampled_map() does not, in discrete time, or if a limit stops a state
[[nodiscard]] std::optional<TimedMap> timed_map(const SystemSpec& spec, const Influences& influences,
                                                std::size_t state, const std::vector<Rational>& slots);

}  // namespace coordreq
