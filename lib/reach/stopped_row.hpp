#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "model/table_shape.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/rational.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

/// The sampled map of one state of x' = A x + B w + c, A nilpotent, where `stop` limits hold integrators
/// only: v' = c_v + b w, without a state in it. Such a v is at clamp(v(0) + r t), r its greatest rate for its
/// greatest values, and
///
///   x_i(tau) = sum_j m_j x_j(0) + sum_v integral_0^tau g_v(s) v(tau - s) ds + [lower, upper],
///
/// where g_v keeps its sign, so that both ends are taken: the exact hull, as sums over the cells of the
/// states.
struct StoppedRow {
  /// The range that a cell of one state adds.
  struct Summand {
    Rational lower;
    Rational upper;
    bool attained = true;               ///< `upper`, from a cell without its upper end
    Rational slowest = 0, fastest = 0;  ///< to x_i', at any time of the period
  };
  std::vector<std::vector<Summand>> summands;  ///< [moving state][index]
  Rational lower;
  Rational upper;
  /// Whether x_i is stopped itself: it then is between its ends all the time.
  bool is_stopped = false;
  /// What `slowest` and `fastest` of the summands lack; nothing if x_i' depends on states that are not
  /// stopped.
  std::optional<std::pair<Rational, Rational>> rate;
};

/// @param slots exact values of parameters and inputs at their slots
/// @returns nothing if the system is not of that kind, or w acts on a stopped state and on another one
/// @throws SpecError as affine_form() does. @pre continuous time
[[nodiscard]] std::optional<StoppedRow> stopped_row(const SystemSpec& spec, const UniformGrid& grid,
                                                    const Dependencies& dependencies, std::size_t state,
                                                    const std::vector<Rational>& slots);

}  // namespace coordreq
