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

/// The system itself, followed step by step beside what the abstraction has of it: with every disturbance in
/// the middle of its range, and nothing measured wrongly.
///
/// Of several processes each follows it; what memories keep only the one that owns the cell knows.
class RealRun {
 public:
  /// @pre unchecked: both outlive this object. @param abstraction its dimensions in any order
  RealRun(const SystemSpec& spec, const Abstraction& abstraction);

  /// From now on it is here. @param state by state of the spec
  void start(std::vector<Rational> state);
  /// The same at the centre of a cell.
  void start(std::int64_t cell);
  /// It is followed no longer.
  void stop() { state_.reset(); }
  [[nodiscard]] bool is_followed() const { return state_.has_value(); }
  /// Where it is. @pre it is followed
  [[nodiscard]] const std::vector<Rational>& state() const {
    REQUIRES(is_followed());
    return *state_;
  }

  /// Where it is after a step.
  struct Place {
    bool is_known = false;
    Location::Kind kind = Location::Kind::beyond;
    std::int64_t cell = -1;  ///< unless `kind` is another
  };
  /// After a step under `u` from where it is, in a cell that this process holds. @pre it is followed
  [[nodiscard]] Place after(std::int64_t cell, std::int64_t u);
  /// Takes the step. @param place after() of it, from whoever knows that
  void advance(std::int64_t u, const Place& place);

 private:
  [[nodiscard]] std::optional<Rational> next(std::size_t state, std::int64_t u);
  [[nodiscard]] const GridDimension& dimension(std::size_t state) const;

  const SystemSpec& spec_;
  const Abstraction& abstraction_;
  PointDynamics dynamics_;
  std::optional<std::vector<Rational>> state_;
  std::vector<Rational> slots_;
  /// [state], by the number of the inputs that it depends on, from where it is.
  std::vector<std::unordered_map<std::int64_t, std::optional<Rational>>> known_;
};

}  // namespace coordreq
