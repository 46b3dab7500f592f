#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "answers/one_cell/policy.hpp"
#include "app/options.hpp"
#include "base/json.hpp"
#include "cell/explain_delay.hpp"
#include "cell/least_steps.hpp"
#include "cell/simulate.hpp"
#include "cell/state_query.hpp"
#include "export/tolerance_frontier.hpp"
#include "results/compare_results.hpp"
#include "results/results_reader.hpp"
#include "spec/spec_types.hpp"
#include "verify/verify.hpp"

// An analysis as text, from the summary of analyze().
// The answer of `require`.
namespace coordreq {

/// The text of `analyze`.
[[nodiscard]] std::string summary_text(const Json& summary, const ProblemSpec& spec);

/// Up to so many partitions are printed in full; more get one line each of a table.
inline constexpr std::size_t kMostPartitionsInFull = 3;
/// They are not in a table, and there is something to print about them.
[[nodiscard]] bool has_partitions_in_full(const Json& summary);

/// Figures of a partition in tables: F, |Z_F|, and the largest delay of the cells that have a finite one,
/// which is empty if none has.
[[nodiscard]] std::string fixed_point_text(const Json& partition);
[[nodiscard]] std::string unbounded_text(const Json& partition);
[[nodiscard]] std::string longest_delay_text(const Json& partition, const Json& summary);

/// The wall time of all stages.
[[nodiscard]] double seconds_of(const Json& summary);

/// Sentences that say for how long silence is safe in a partition, one for each policy, in their order.
/// @param partition of the summary of analyze(), or of read_info()
/// @param document the whole of it
/// @param policies of headline_policies()
[[nodiscard]] std::vector<std::string> headlines(const Json& partition, const Json& document,
                                                 const std::vector<AnswerPolicy>& policies);

/// The same as indented lines, each with its end of line.
[[nodiscard]] std::string headline_lines(const Json& partition, const Json& document,
                                         const std::vector<AnswerPolicy>& policies);

/// The guarantee as text; where safety is required at samples of a continuous system, how often that is, and
/// how far the state that moves by the most cells gets in between: "samples: checked every 1 s only, for
/// every point of a cell; between, p1 moves up to 10 m". In continuous time
/// also which states jump at samples.
/// @param motion of motion_json()
[[nodiscard]] std::string guarantee_line(const std::string& guarantee, const Json& motion,
                                         const SystemSpec& spec);

/// The guarantee as text, without motions; in continuous time also which states jump at samples.
[[nodiscard]] std::string guarantee_of_file(const std::string& guarantee, const SystemSpec& spec);

/// The summary of an analysis with `nearest` in each requirement of a delay that fails in a cell: the state
/// of which the fewest steps of its grid, the others as in the worst cell, lead to values from which on, or
/// up to which, all cells have the required delay: `state`, `best` ("large" or "small") and `value`; null if
/// there is none.
/// @param results the file of this analysis
[[nodiscard]] Json with_nearest_regions(const Json& summary, const std::string& results);

/// Prints what `compare` has found. What fields are compared by stands under their names, but for the delay,
/// which is under `partitions`.
void print_comparison(const CommonOptions& args, const ResultsComparison& comparison,
                      const ResultsReader& before, const ResultsReader& after, const CompareOptions& options);

/// The findings of `explain` about a state in a cell, as a document. @param partition its number
[[nodiscard]] Json explanation_json(const DelayExplanation& found, const std::vector<Rational>& state,
                                    std::int64_t cell, std::size_t partition, const ResultsReader& results);
/// The document as text; no other source.
[[nodiscard]] std::string explanation_text(const Json& explanation, const ProblemSpec& spec);

/// The least steps of many pairs, as a document and as text.
[[nodiscard]] Json least_json(const LeastSteps& found, const Field& field, std::size_t partition,
                              std::optional<std::int32_t> at_least, const ResultsReader& results);
[[nodiscard]] std::string least_text(const Json& found, const Field& field);

/// Its document: `corners` has for each a list of values, one for each state of `over`: the face of its cell
/// that is the worst still tolerated, of a discrete state its value. Of one state `intervals` has all that is
/// tolerated: lists of two values.
[[nodiscard]] Json require_json(const ResultsReader& results, const ToleranceQuestion& question,
                                const Tolerance& tolerance);
/// @param is_one_sided the question is from which value on, or up to which, rather than for intervals
[[nodiscard]] std::string require_text(const Json& found, bool is_one_sided);
/// A line for each corner, or for each interval, after one that names the columns.
[[nodiscard]] std::string require_csv(const Json& found, bool is_one_sided);

/// Prints what `simulate` has found.
void print_simulation(const CommonOptions& args, const Simulation& simulation, const ResultsReader& results,
                      const SimulationOptions& options);

/// Prints what `verify` has found, and a line of warning where nothing is wrong but something is not
/// confirmed. @param seconds wall time; @param path of the results file
void print_verification(const CommonOptions& args, const Verification& result, const std::string& path,
                        double seconds, int threads);

}  // namespace coordreq
