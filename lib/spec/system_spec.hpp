#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "expression/program.hpp"
#include "numeric/rational.hpp"
#include "spec/past_operator.hpp"
#include "spec/spec_types.hpp"

// The system: its variables, the agents, the dynamics, and how posts are enclosed. All expressions
// of a spec share one numbering of variables ("slots"): states first, then inputs, then disturbances, each in
// the order of the spec.
namespace coordreq {

struct StateSpec {
  std::string name;
  std::string unit;  ///< empty if none was given
  GridSpec grid;
  Rational lower;  ///< as written; for a periodic state [lower, upper) is one period
  Rational upper;
  bool discrete = false;
  Rational measurement_error = 0;
  Outside below = Outside::unsafe;
  Outside above = Outside::unsafe;

  /// Whether the rule holds below or above.
  [[nodiscard]] bool has(Outside rule) const { return below == rule || above == rule; }
};

struct InputSpec {
  std::string name;
  std::string unit;
  std::vector<Rational> values;  ///< all different, in the order of the spec
  std::optional<GridSpec> grid;  ///< set if the values were given as a grid
};

struct DisturbanceSpec {
  std::string name;
  std::string unit;
  Rational lower;
  Rational upper;
};

struct AgentSpec {
  std::string name;
  std::vector<std::int32_t> inputs;  ///< indices into ProblemSpec::inputs, ascending; not empty
  std::optional<Program> prefer;     ///< over states and inputs
  /// States that it reads by itself at every sample, ascending; none: all. Of those that memories keep see
  /// seen_states().
  std::optional<std::vector<std::int32_t>> sees;
};

/// How a discrete state jumps at a sample.
struct UpdateSpec {
  /// The next value as a function of the present sample. Outside of the conditions of `if` it mentions
  /// discrete states and inputs only, and nowhere disturbances.
  Program value;
  /// Set for a state that a memory keeps, whose next value is a function of the cell seen; then `value` is
  /// not used.
  std::optional<PastOperator> past;
  [[nodiscard]] std::vector<std::uint32_t> variables() const {
    return past ? past->variables() : value.variables();
  }
};

struct DynamicsSpec {
  Time time = Time::continuous;
  Rational period;                 ///< tau, > 0
  std::string unit;                ///< of time, as written; empty if none was given
  std::vector<Program> equations;  ///< one a state, in order: derivative or next value; 0 if it has an update
                                   ///< in continuous time, for between samples it keeps its value
  /// One a state. In discrete time the equation of a discrete state that asks of continuous ones where they
  /// are (with `if`) is an update, too.
  std::vector<std::optional<UpdateSpec>> updates;

  /// A memory keeps the state.
  [[nodiscard]] bool is_kept(std::size_t state) const {
    return update(state) != nullptr && update(state)->past.has_value();
  }
  [[nodiscard]] const UpdateSpec* update(std::size_t state) const {
    return state < updates.size() && updates[state] ? &*updates[state] : nullptr;
  }
  /// Where what a state does next stands in the spec.
  [[nodiscard]] std::string pointer_of(const std::string& name, std::size_t state) const {
    return (time == Time::continuous && update(state) != nullptr ? "/dynamics/updates/"
                                                                 : "/dynamics/equations/") +
           name;
  }
};

struct AbstractionSpec {
  Cells cells = Cells::closed;
  Membership safe = Membership::inner;
  bool between_samples = false;
  std::int64_t effort = 200;  ///< so many parts of a cell are enclosed at most, for one post
};

/// The part of a spec that posts follow from.
struct SystemSpec {
  std::vector<StateSpec> states;  ///< at least one; those that memories keep come last
  std::vector<InputSpec> inputs;  ///< at least one
  std::vector<DisturbanceSpec> disturbances;
  std::vector<AgentSpec> agents;  ///< at least one; every input belongs to exactly one
  DynamicsSpec dynamics;
  AbstractionSpec abstraction;

  [[nodiscard]] std::uint32_t state_slot(std::size_t i) const { return static_cast<std::uint32_t>(i); }
  [[nodiscard]] std::uint32_t input_slot(std::size_t i) const {
    return static_cast<std::uint32_t>(states.size() + i);
  }
  [[nodiscard]] std::uint32_t disturbance_slot(std::size_t i) const {
    return static_cast<std::uint32_t>(states.size() + inputs.size() + i);
  }
  [[nodiscard]] std::size_t slot_count() const { return states.size() + inputs.size() + disturbances.size(); }
  [[nodiscard]] std::int64_t cells() const {
    std::int64_t product = 1;
    for (const StateSpec& state : states) product *= state.grid.count;
    return product;
  }
};

}  // namespace coordreq
