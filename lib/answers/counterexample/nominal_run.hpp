#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/requires.hpp"
#include "model/locate.hpp"
#include "reach/abstraction.hpp"
#include "reach/point_dynamics.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The system itself, followed step by step beside the abstraction: with every disturbance in the middle of
/// its range, and without measurement errors.
///
/// Each of several processes follows it; only the owner of a cell can evaluate memories there.
class NominalRun {
 public:
  /// @pre unchecked: the arguments outlive this object. @param abstraction its dimensions in any order
  NominalRun(const SystemSpec& spec, const Abstraction& abstraction);

  /// Starts at a state. @param state [state of the spec]
  void start(std::vector<Rational> state);
  /// Starts at the centre of a cell.
  void start(std::int64_t cell);
  /// Ends following it.
  void stop() { state_.reset(); }
  [[nodiscard]] bool is_followed() const { return state_.has_value(); }
  /// Its present state. @pre it is followed
  [[nodiscard]] const std::vector<Rational>& state() const {
    REQUIRES(is_followed());
    return *state_;
  }

  /// Where it is after a step.
  struct Successor {
    bool is_known = false;
    Location::Kind kind = Location::Kind::beyond;
    std::int64_t cell = -1;  ///< if `kind` is a cell
  };
  /// Where it is after a step under `u` from the present state, in a cell that this process holds. @pre it is
  /// followed
  [[nodiscard]] Successor after(std::int64_t cell, std::int64_t u);
  /// Takes a step. @param successor after() of the process that holds the cell
  void advance(std::int64_t u, const Successor& successor);

 private:
  [[nodiscard]] std::optional<Rational> next(std::size_t state, std::int64_t u);
  [[nodiscard]] const GridDimension& dimension(std::size_t state) const;

  const SystemSpec& spec_;
  const Abstraction& abstraction_;
  PointDynamics dynamics_;
  std::optional<std::vector<Rational>> state_;
  std::vector<Rational> slots_;
  /// [state] Its next values from the present state, by the number of the inputs on which they depend.
  std::vector<std::unordered_map<std::int64_t, std::optional<Rational>>> known_;
};

}  // namespace coordreq
