#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/counterexample/result_path.hpp"
#include "answers/field_source.hpp"
#include "spec/spec_types.hpp"

// Requirements, their verdicts and counterexamples, as in results files and reports.
namespace coordreq {

/// Whether the system itself is followed from where a counterexample with steps begins: for requirements
/// about safety in which agents see everything.
[[nodiscard]] bool is_followed(RequirementKind kind);

struct ResultRequirement {
  std::string name;
  bool holds = false;
  std::uint64_t cells = 0;    ///< of the region
  std::uint64_t failing = 0;  ///< cells of the region that fail
  /// Over the region, coded as in `/delay` with INT32_MAX: unbounded; likewise the greatest arrival or the
  /// least approach delay.
  std::int32_t least_delay = 0;
  /// For `max_risk` `least_delay`, and the delays of the path, are risks as bits of a float32, which order
  /// like the numbers; this is the greatest risk with the part of the rate for the steps, which is compared.
  double risk = 0;
  bool is_risk = false;
  std::optional<ResultSide> reached_side;  ///< a side beyond which the region may reach
  std::optional<ResultPath> path;          ///< from the worst cell, if a cell fails

  [[nodiscard]] bool operator==(const ResultRequirement&) const = default;
};

/// [requirement of the spec] The verdicts in a file. @throws ResultsError if verdicts and counterexamples do
/// not fit together
[[nodiscard]] std::vector<ResultRequirement> read_requirement_values(const ProblemSpec& spec,
                                                                     const FieldSource& source);

/// The path of a field of all requirements, and that of a field of the counterexample of one.
[[nodiscard]] std::string counterexample_path(const std::string& name);
[[nodiscard]] std::string counterexample_path(std::size_t requirement, const std::string& name);

}  // namespace coordreq
