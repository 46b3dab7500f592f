#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spec/scope.hpp"
#include "spec/spec_types.hpp"

// The readers of the parts of a spec. All REQUIRE a document that follows the schema, take `root`, the whole
// document, and throw SpecError naming the JSON pointer, or SpecErrors; sizes beyond all bounds are
// LimitErrors.
namespace coordreq {

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
