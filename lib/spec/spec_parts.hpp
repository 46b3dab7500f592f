#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spec/coordination_spec.hpp"
#include "spec/scope.hpp"
#include "spec/spec_types.hpp"

// The probabilities of a network.
// The readers of the parts of a spec. All REQUIRE a document that follows the schema, take `root`, the whole
// document, and throw SpecError naming the JSON pointer, or SpecErrors; sizes beyond all bounds are
// LimitErrors.
namespace coordreq {

/// A dimension as written and the grid points that follow from it.
struct GridReading {
  Rational lower;
  Rational upper;
  GridSpec grid;
};

/// The kind of a grid: single points, or cells around its points. Cells are as wide as the step.
enum class GridOf : std::uint8_t { points, cells, periodic_cells };

/// Reads lower, upper and step or count (contract, section 1, "Grid").
/// With `step`: {origin + k*step : k integer} inside [lower, upper], both ends included. With `count`: that
/// many points, evenly from lower to upper, both included; upper left out if periodic. A single point is
/// lower = upper, and its step 1; for cells that says too little.
/// @throws SpecError if there is no grid point, step <= 0, lower > upper, a periodic dimension has no count,
///   or points lie closer than doubles can tell apart; LimitError beyond 2^31 - 2 points
[[nodiscard]] GridReading read_grid(const Scope& scope, const JsonDocument::Node& object, GridOf kind);

/// A number or a list of the least and the greatest one. @throws SpecError if it is not within [0, 1]
[[nodiscard]] ProbabilityRange read_probability(const Scope& scope, const JsonDocument::Node& node);

/// Narrows the ranges of all transitions to what they can be while those of each mode are 1 in sum, and drops
/// transitions that cannot happen. Nothing to do for a network without numbers.
/// @param pointer where the numbers stand
/// @throws SpecError if those of a mode cannot be 1 in sum
void settle_probabilities(NetworkSpec& network, const std::string& pointer);

[[nodiscard]] Time read_time(const JsonDocument::Node& root);

[[nodiscard]] std::vector<StateSpec> read_states(const Scope& scope, const JsonDocument::Node& root);
[[nodiscard]] std::vector<InputSpec> read_inputs(const Scope& scope, const JsonDocument::Node& root);
[[nodiscard]] std::vector<DisturbanceSpec> read_disturbances(const Scope& scope,
                                                             const JsonDocument::Node& root);

[[nodiscard]] std::vector<AgentSpec> read_agents(const Scope& scope, const JsonDocument::Node& root,
                                                 const std::vector<InputSpec>& inputs);
[[nodiscard]] Rational read_period(const Scope& scope, const JsonDocument::Node& root);
[[nodiscard]] DynamicsSpec read_dynamics(const Scope& scope, const JsonDocument::Node& root,
                                         const Rational& period, const std::vector<StateSpec>& states);
[[nodiscard]] AbstractionSpec read_abstraction(const JsonDocument::Node& root);
[[nodiscard]] ControllerSpec read_controller(const Scope& scope, const JsonDocument::Node& root);
[[nodiscard]] OutputSpec read_output(const JsonDocument::Node& root);

[[nodiscard]] CoordinationSpec read_coordination(const Scope& scope, const JsonDocument::Node& root,
                                                 const std::vector<AgentSpec>& agents,
                                                 const Rational& period);
[[nodiscard]] NetworkSpec read_network(const Scope& scope, const JsonDocument::Node& root,
                                       const std::vector<AgentSpec>& agents,
                                       const CoordinationSpec& coordination);
[[nodiscard]] RiskSpec read_risk(const Scope& scope, const JsonDocument::Node& root, const Rational& period,
                                 const std::optional<NetworkSpec>& network);
[[nodiscard]] SilenceSpec read_silence(const Scope& scope, const JsonDocument::Node& root,
                                       const std::vector<AgentSpec>& agents);
[[nodiscard]] std::vector<RequirementSpec> read_requirements(
    const Scope& scope, const JsonDocument::Node& root, const std::vector<AgentSpec>& agents,
    const CoordinationSpec& coordination, const std::optional<RiskSpec>& risk, const Rational& period);

/// time / period, exactly, for a time >= 0; what is not a whole number of steps is rounded.
enum class StepRounding : std::uint8_t { up, down };
[[nodiscard]] std::int64_t read_steps_of_time(const Scope& scope, const JsonDocument::Node& time,
                                              const Rational& period,
                                              StepRounding rounding = StepRounding::up);

/// The text of `unit`, empty if there is none. @throws SpecError if it contains the word "since", which
/// readers of netCDF take for a calendar
[[nodiscard]] std::string read_unit(const JsonDocument::Node& object);

/// An integer that the schema keeps within 64 bits.
[[nodiscard]] std::int64_t read_integer(const JsonDocument::Node& node);

/// The index of a name in a list. @throws SpecError "'a' is not KIND", with the nearest spelling
[[nodiscard]] std::int32_t index_of_name(const JsonDocument::Node& name,
                                         const std::vector<std::string>& known, const std::string& kind);

/// @throws SpecError "KIND 'a' is named twice" if `known` has the name
void check_new_name(const JsonDocument::Node& name, const std::vector<std::string>& known,
                    const std::string& kind);

}  // namespace coordreq
