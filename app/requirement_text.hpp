#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "spec/spec_types.hpp"

// A requirement as text, from requirement_json(): `entry` in all that follows. `analyze`,
// JUnit reports and pages use the same texts.
namespace coordreq {

/// "3 steps (1.5 s)".
[[nodiscard]] std::string steps_text(std::int64_t steps, const ProblemSpec& spec);

/// "delay of alone at least 20 steps (0.2 s)", "in the invariance set": what each cell has to satisfy.
[[nodiscard]] std::string claim_text(const Json& entry, const ProblemSpec& spec);

/// The key of the worst value of its states: "least_delay", "longest_arrival" or "least_approach_delay".
[[nodiscard]] std::string worst_key(const Json& entry);
/// The fault of the worst cell: "has a delay of 2 steps (1 s)", "is not safe".
/// @param kind of the requirement @param value number of steps
/// @param status as delay_label() says it, not unbounded
[[nodiscard]] std::string worst_text(const Json& kind, const Json& value, const Json& status,
                                     const ProblemSpec& spec);

/// Where the region may reach, and what ends that. @pre entry["reaches_outside"] is there
[[nodiscard]] std::string outside_text(const Json& entry, const ProblemSpec& spec);

/// Why it fails, in one line; empty if it holds.
[[nodiscard]] std::string failure_line(const Json& entry, const ProblemSpec& spec);
/// failure_line() with its counterexample: lines that end in newlines.
[[nodiscard]] std::string failure_text(const Json& entry, const ProblemSpec& spec);

/// The counterexample has steps to describe, not just the worst cell. @pre it fails
[[nodiscard]] bool has_steps(const Json& entry);

/// A counterexample with a first state, as JSON has it.
struct Counterexample {
  const Json& path;
  RequirementKind kind;
  const Json& partition;  ///< its name; null: of all agents together
};
[[nodiscard]] Counterexample counterexample_of(const Json& entry);

/// One row a sample: where, what is left, and what each agent does next.
struct CounterexampleTable {
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;  ///< [sample][head]; the first cell is the number of the sample
  std::size_t numbers = 0;                     ///< so many of the first columns hold numbers
};
[[nodiscard]] CounterexampleTable counterexample_table(const Counterexample& found, const ProblemSpec& spec);
/// The table as text. @param indent before the head of its first column
[[nodiscard]] std::string counterexample_text(const Counterexample& found, const ProblemSpec& spec,
                                              const std::string& indent);
[[nodiscard]] std::vector<std::string> counterexample_sentences(const Counterexample& found,
                                                                const ProblemSpec& spec);

/// All of an analysis; empty if there are none.
[[nodiscard]] std::string requirements_text(const Json& requirements, const ProblemSpec& spec);

}  // namespace coordreq
