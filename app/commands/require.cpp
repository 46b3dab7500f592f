#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/print_answer.hpp"
#include "app/require_report.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "cell/simulate.hpp"
#include "cell/state_text.hpp"
#include "model/locate.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

struct RequireOptions : CommonOptions {
  std::string results, delay, over, best = "large", partition;
  NamedValues given;
  bool csv = false;
};

/// "4" steps, or "2 s", "2s": a time in the unit of the spec, rounded up to periods.
std::int64_t steps_of(const std::string& text, const DynamicsSpec& dynamics) {
  constexpr const char* kOption = "--delay";
  constexpr std::int64_t kMost = INT32_MAX - 1;
  const std::string unit = dynamics.unit;
  const std::string expected = unit.empty()
                                   ? "a number of steps"
                                   : fmt::format("a number of steps, or a time as 2{}", printable(unit));
  std::string number(trimmed(text));
  const bool is_time = !unit.empty() && number.ends_with(unit) && number.size() > unit.size();
  if (is_time) number = trimmed(number.substr(0, number.size() - unit.size()));
  const std::optional<Rational> value = parse_decimal(number);
  if (!value || *value <= 0 || (!is_time && !is_integer(*value))) fail_value(expected, text, kOption);
  const Rational steps = is_time ? Rational(*value / dynamics.period) : *value;
  if (steps > Rational(static_cast<long>(kMost))) fail_value(expected, text, kOption);
  return ceil_to_int(steps);
}

std::vector<ToleranceQuestion::Over> over_of(const RequireOptions& options, const ResultsReader& results) {
  std::vector<ToleranceQuestion::Over> over;
  const std::vector<std::string> names = state_names(results.spec()).names;
  for (const std::string_view part : split_at_commas(options.over)) {
    const std::size_t state = state_number(trimmed(part), names, "--over");
    for (const ToleranceQuestion::Over& other : over)
      if (other.state == state) throw UsageError(echoed(names[state]) + " is given twice", "--over");
    over.push_back({state, true});
  }
  if (over.size() > 2)
    throw UsageError(fmt::format("expected one state or two, found {}", over.size()), "--over");
  const std::vector<std::string_view> words = split_at_commas(options.best);
  if (words.size() != 1 && words.size() != over.size())
    throw UsageError("expected one word for each state of --over", "--best");
  const OneOf<bool> best{{{"large", true}, {"small", false}}};
  for (std::size_t i = 0; i < over.size(); ++i)
    over[i].is_large_best = best(std::string(trimmed(words[words.size() == 1 ? 0 : i])), "--best");
  return over;
}

std::vector<TableSelection::Slice> given_of(const RequireOptions& options, const ResultsReader& results,
                                            const std::vector<ToleranceQuestion::Over>& over) {
  std::vector<TableSelection::Slice> given;
  const std::vector<std::string> names = state_names(results.spec()).names;
  for (const auto& [name, value] : options.given) {
    const std::size_t state = state_number(name, names, "--given");
    for (const ToleranceQuestion::Over& other : over)
      if (other.state == state) throw UsageError(echoed(name) + " is sought, expected no value", "--given");
    const std::vector<Rational> values = {value};
    const Location location = locate(UniformGrid({results.grid()[state]}), values);
    if (location.kind != Location::Kind::cell)
      throw UsageError(fmt::format("{} = {} is outside of the domain", name, to_text(value)), "--given");
    given.push_back({state, location.cell});
  }
  return given;
}

ExitCode run(const RequireOptions& options) {
  if (options.csv && options.json) throw UsageError("expected --csv or --json, found both", "--csv");
  if (options.delay.empty()) throw UsageError("expected how much silence is to be tolerated", "--delay");
  if (options.over.empty()) throw UsageError("expected the state that is sought", "--over");
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  ToleranceQuestion question{.partition = find_partition(results.spec(), options.partition),
                             .steps = steps_of(options.delay, results.spec().dynamics)};
  question.over = over_of(options, results);
  question.given = given_of(options, results, question.over);
  static_cast<void>(options.threads_for("reading needs", {.once = results.reading_bytes()}));
  const Json found = require_json(results, question, tolerance_frontier(results, question));
  if (options.csv) {
    write_output(require_csv(found));
    return ExitCode::success;
  }
  print_answer(options, found, require_text);
  return ExitCode::success;
}

}  // namespace

Run declare_require(Options& options) {
  const auto own = std::make_shared<RequireOptions>();
  declare_results(options, own->results);
  options.option(own->delay, "--delay", "N", "The silence to be tolerated: steps, or a time as 2s", as_typed);
  options.option(own->over, "--over", "STATES", "The state that is sought, or two with a comma between",
                 as_typed);
  options.option(own->given, "--given", "VALUES",
                 "Values of other states, as v1=1,v2=-1; of those left out every value counts", named_values);
  options.option(own->best, "--best", "WORDS",
                 "Which values are better, large or small; for two states perhaps two words (default: large)",
                 as_typed);
  options.option(own->partition, "--partition", "NAME", "Partition (default: the only one)", as_typed);
  options.flag(own->csv, "--csv", "A line for each corner of the region, as CSV");
  declare_common(options, *own, {.threads = false});
  return [own] { return run(*own); };
}

}  // namespace coordreq
