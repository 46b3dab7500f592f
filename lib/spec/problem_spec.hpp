#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expression/program.hpp"
#include "numeric/rational.hpp"
#include "spec/past_operator.hpp"

// The problem as plain data, contract section 2. Only read_spec() makes one, so every invariant named here
// holds wherever a ProblemSpec is seen. All expressions share one numbering of variables ("slots"):
// states first, then inputs, then disturbances, each in the order of the spec.
namespace coordreq {

enum class Outside : std::uint8_t { unsafe, safe, saturate, stop, periodic, goal };

/// The grid points first, first + step, ..., first + (count - 1) * step. REQUIRES count >= 1, step > 0.
struct GridSpec {
  Rational first;
  Rational step;
  std::int64_t count = 0;
};

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
};

enum class Time : std::uint8_t { continuous, discrete };

/// How a discrete state jumps at a sample.
struct UpdateSpec {
  /// The next value as a function of the present sample. Outside of the conditions of `if` it mentions
  /// discrete states and inputs only, and nowhere disturbances.
  Program value;
  /// But the next value of a state that a memory keeps is a function of the cell seen.
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

enum class Cells : std::uint8_t { closed, half_open };
enum class Membership : std::uint8_t { inner, center };

struct AbstractionSpec {
  Cells cells = Cells::closed;
  Membership safe = Membership::inner;
  bool between_samples = false;
};

enum class Synthesis : std::uint8_t { maximal, given };

struct ControllerSpec {
  Synthesis synthesis = Synthesis::maximal;
  /// Over states and inputs; none: everything is allowed. Grid points are asked; but conditions of memories
  /// that `safe` asks of whole cells have slots of their own for states, after those of states and inputs.
  std::optional<Program> allow;
  std::optional<std::string> file;  ///< as written; lists the pairs that are admissible
};

/// Classes of agents that coordinate within a step. Canonical: agents ascending within a class, classes by
/// their first agents; every agent is in exactly one class.
struct PartitionSpec {
  std::string name;       ///< the given name, else the canonical one
  std::string canonical;  ///< "a+b|c"
  std::vector<std::vector<std::int32_t>> classes;
};

struct LinkCostSpec {
  std::int32_t first = 0;  ///< agent indices, first < second
  std::int32_t second = 0;
  Rational cost;
};

struct CoordinationSpec {
  std::vector<PartitionSpec> partitions;  ///< at least one, all different
  bool all_partitions = false;  ///< the spec says "all"; `partitions` are as make_all_partitions() has them
  std::optional<std::int64_t> max_delay;  ///< steps
  std::int64_t connection_delay = 0;      ///< D, steps
  /// Steps; from "horizon_time" by ceil(time / period). At most `max_delay`, if there is one.
  std::optional<std::int64_t> horizon;
  std::optional<Rational> horizon_time;  ///< as written; `horizon` has its steps
  std::vector<LinkCostSpec> link_cost;   ///< none without `horizon`
  bool convention = false;
};

struct NetworkModeSpec {
  std::string name;         ///< as given, or the history of losses (see loss_automaton.hpp)
  PartitionSpec partition;  ///< who is connected; not necessarily one of CoordinationSpec::partitions
};
enum class NetworkKind : std::uint8_t { automaton, delay, burst, weakly_hard };
/// Whatever its kind is, the network as an automaton, and the numbers that it was unfolded from.
struct NetworkSpec {
  NetworkKind kind = NetworkKind::automaton;
  std::vector<NetworkModeSpec> modes;                              ///< the first one is the initial mode
  std::vector<std::pair<std::int32_t, std::int32_t>> transitions;  ///< indices into modes; each has one
  std::int64_t delay = 0;
  std::int64_t burst_length = 0, burst_gap = 0;
  std::int64_t misses = 0, window = 0;
  bool resynthesise = false;
};
/// The key of the spec that stands for it, "automaton" for `modes`.
[[nodiscard]] std::string network_kind_name(NetworkKind kind);

struct MemorySpec {
  std::string name;
  Program truth;  ///< its condition at a sample, over states
  std::vector<std::string>
      states;  ///< that keep it, among the last ones of ProblemSpec::states; perhaps none
};

enum class RequirementKind : std::uint8_t { min_delay, invariant, max_arrival, min_approach_delay };
/// The key of the spec that stands for it.
[[nodiscard]] std::string requirement_kind_name(RequirementKind kind);
struct RequirementSpec {
  std::string name;
  Program where;  ///< over states
  RequirementKind kind = RequirementKind::min_delay;
  std::optional<std::int32_t> partition;  ///< index into partitions; none where it is about all of them
  /// What is asked for, 0 for `invariant`. From a time by ceil(time / period), an upper limit by floor.
  std::int64_t steps = 0;

  [[nodiscard]] bool is_of_partition() const {
    return kind == RequirementKind::min_delay || kind == RequirementKind::min_approach_delay;
  }
};

struct OutputSpec {
  bool controller = false;
  bool actions = false;
  bool layers = false;
  bool abstraction = false;
};

struct ProblemSpec {
  std::string text;    ///< the spec as read, UTF-8
  std::string folder;  ///< where relative paths start; empty: the current one
  std::string name;
  std::string description;
  std::vector<StateSpec> states;  ///< at least one; those that memories keep come last
  std::vector<InputSpec> inputs;  ///< at least one
  std::vector<DisturbanceSpec> disturbances;
  std::vector<AgentSpec> agents;  ///< at least one; every input belongs to exactly one
  DynamicsSpec dynamics;
  std::vector<MemorySpec> memory;  ///< in the order of the spec
  Program safe;                    ///< a condition over states
  std::optional<Program> goal;     ///< likewise
  AbstractionSpec abstraction;
  ControllerSpec controller;
  CoordinationSpec coordination;
  std::optional<NetworkSpec> network;
  std::vector<RequirementSpec> requirements;
  OutputSpec output;

  [[nodiscard]] std::uint32_t state_slot(std::size_t i) const { return static_cast<std::uint32_t>(i); }
  [[nodiscard]] std::uint32_t input_slot(std::size_t i) const {
    return static_cast<std::uint32_t>(states.size() + i);
  }
  [[nodiscard]] std::uint32_t disturbance_slot(std::size_t i) const {
    return static_cast<std::uint32_t>(states.size() + inputs.size() + i);
  }
  [[nodiscard]] std::size_t slot_count() const { return states.size() + inputs.size() + disturbances.size(); }
};

}  // namespace coordreq
