#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "model/input_class.hpp"
#include "model/locate.hpp"
#include "reach/abstraction.hpp"
#include "reach/point_dynamics.hpp"

namespace coordreq {

/// The next states from one point under one disturbance and any joint input. What depends only on few inputs
/// is computed once for each of their values, when it is needed. Where a state is measured follows from
/// doubles with a bound on their error, unless that leaves two cells: most exact values are never needed.
class NextStates {
 public:
  /// Of up to so many joint inputs it is kept what each means to a state.
  static constexpr std::int64_t kMostTabulated = 16'384;

  struct Value {
    bool known = false;  ///< false: undefined, not finite, or not to be followed; the rest then means nothing
    double followed = 1.0;  ///< but for this: the share of the period up to which it could be
    Rational value;         ///< at the sample, after its resets
    double approximate = 0;
    Location::Kind kind = Location::Kind::beyond;  ///< where it is measured in its dimension
    std::int64_t index = -1;
  };
  /// Where a next state is measured.
  struct CellLocation {
    Location::Kind kind = Location::Kind::cell;
    std::int64_t cell = -1;  ///< -1 unless `kind` is `cell`
  };

  /// @pre unchecked: all outlive this object.
  NextStates(const SystemSpec& spec, const Abstraction& abstraction, PointDynamics& dynamics);

  /// @param error what measuring the next state adds, one a state
  /// @param cell where the state is measured: what memories keep is a function of it
  void begin(std::span<const Rational> state, std::span<const Rational> disturbance,
             std::span<const Rational> error, std::int64_t cell);

  [[nodiscard]] const Value& state(std::size_t i, std::int64_t u);
  /// Where the next state is measured, as locate() has it; `beyond` if it is not known.
  [[nodiscard]] CellLocation location(std::int64_t u);
  /// All states are known under `u`.
  [[nodiscard]] bool is_known(std::int64_t u);
  /// One that is known is beyond an unsafe side under `u`, whatever becomes of the others.
  [[nodiscard]] bool has_left(std::int64_t u);
  /// The share of the period up to which all of them could be followed.
  [[nodiscard]] double followed(std::int64_t u);

 private:
  /// A dimension in doubles.
  struct Axis {
    bool is_quick = false;                    ///< cells of it may be found by doubles
    double first = 0, step = 1, highest = 0;  ///< `highest`: the last index
    double error = 0;                         ///< of the measurement
  };
  struct Entry {
    Value value;  ///< without `value` and `approximate` unless exact
    bool is_exact = false;
  };

  /// At least where the state is measured.
  [[nodiscard]] Entry& entry(std::size_t i, std::int64_t u);
  [[nodiscard]] std::optional<std::int64_t> index_by_estimate(std::size_t i);
  void find_exactly(std::size_t i, std::int64_t u, Value& result);
  [[nodiscard]] std::optional<Rational> next(std::size_t i, std::int64_t u);

  const SystemSpec* spec_;
  const Abstraction* abstraction_;
  PointDynamics* dynamics_;
  std::int64_t cell_ = 0;
  std::vector<Rational> slots_;
  std::vector<double> doubles_;  ///< nearest to `slots_`
  std::vector<Rational> error_;
  std::vector<InputClass> inputs_;                                ///< [state] those that it depends on
  std::vector<std::unordered_map<std::int64_t, Entry>> entries_;  ///< [state], by actions of its inputs
  std::vector<std::vector<double>> input_values_;
  std::vector<UniformGrid> axes_;  ///< each dimension as a separate grid
  std::vector<Axis> quick_;
};

}  // namespace coordreq
