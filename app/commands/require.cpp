#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/print.hpp"
#include "app/reports.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "base/grouped.hpp"
#include "cell/simulate.hpp"
#include "cell/state_text.hpp"
#include "model/locate.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

struct RequireOptions : CommonOptions {
  std::string results, axes, partition;
  std::vector<std::pair<const RequirementTraits*, std::string>> limits;  ///< requested
  std::optional<std::string> best;
  NamedValues given;
  bool csv = false;
};

/// @throws UsageError where not one limit is requested
void check_limit(const RequireOptions& options) {
  const auto& limits = options.limits;
  if (limits.size() > 1) {
    throw UsageError(fmt::format("expected one limit, found {} too", limits[0].first->option),
                     limits[1].first->option);
  }
  if (!limits.empty()) return;
  std::vector<std::string> others;
  for (const RequirementTraits& kind : requirement_kinds()) {
    if (kind.option != nullptr && kind.kind != RequirementKind::min_delay) others.emplace_back(kind.option);
  }
  throw UsageError("missing --delay N, the silence to be tolerated, or one of " + list_text(others));
}

double risk_of(const std::string& text, const char* option) {
  const std::optional<Rational> value = parse_decimal(trimmed(text));
  if (!value || *value < 0 || *value > 1) fail_value("a probability from 0 to 1", text, option);
  return nearest_double(*value);
}

/// @throws UsageError if the results do not have what is requested
void set_limit(const RequireOptions& options, const ResultsReader& results, ToleranceQuestion& question) {
  const std::string& text = options.limits.front().second;
  const RequirementTraits& kind = *options.limits.front().first;
  question.kind = kind.kind;
  const std::string path = dataset_of(kind.kind, results.spec()).path;
  if (!results.has(path)) {
    throw UsageError(
        fmt::format("the results have no {}, expected those of a spec with the key '{}'", path, kind.needs),
        kind.option);
  }
  if (kind.is_probability) {
    question.risk = risk_of(text, kind.option);
  } else {
    question.steps =
        steps_or_time(text, results.spec().dynamics, kind.option,
                      {.least = kind.is_upper_limit ? 0 : 1, .is_upper_limit = kind.is_upper_limit});
  }
}

std::vector<ToleranceQuestion::Axis> axes_of(const RequireOptions& options, const ResultsReader& results) {
  std::vector<ToleranceQuestion::Axis> axes;
  const std::vector<std::string> names = state_names(results.spec()).names;
  for (const std::string_view name : split_at_commas(options.axes)) {
    const std::size_t state = state_number(trimmed(name), names, "--over");
    for (const ToleranceQuestion::Axis& other : axes)
      if (other.state == state) throw UsageError(echoed(names[state]) + " is given twice", "--over");
    axes.push_back({state, true});
  }
  if (axes.size() > 2)
    throw UsageError(fmt::format("expected one state or two, found {}", axes.size()), "--over");
  const std::string all_best = options.best.value_or("large");
  const std::vector<std::string_view> best_values = split_at_commas(all_best);
  if (best_values.size() != 1 && best_values.size() != axes.size())
    throw UsageError("expected one word for each state of --over", "--best");
  const OneOf<bool> best{{{"large", true}, {"small", false}}};
  for (std::size_t i = 0; i < axes.size(); ++i)
    axes[i].is_large_best =
        best(std::string(trimmed(best_values[best_values.size() == 1 ? 0 : i])), "--best");
  return axes;
}

std::vector<TableSelection::Slice> given_of(const RequireOptions& options, const ResultsReader& results,
                                            const std::vector<ToleranceQuestion::Axis>& axes) {
  std::vector<TableSelection::Slice> given;
  const std::vector<std::string> names = state_names(results.spec()).names;
  for (const auto& [name, value] : options.given) {
    const std::size_t state = state_number(name, names, "--given");
    for (const ToleranceQuestion::Axis& other : axes)
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
  check_limit(options);
  if (options.axes.empty()) throw UsageError("missing --over STATE, the state over which to search");
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  ToleranceQuestion question{.partition = find_partition(results.spec(), options.partition)};
  set_limit(options, results, question);
  question.axes = axes_of(options, results);
  question.given = given_of(options, results, question.axes);
  static_cast<void>(options.threads_for("reading needs", {.once = results.reading_bytes()}));
  const Json found = require_json(results, question, find_tolerance(results, question));
  const bool is_one_sided = options.best.has_value();
  if (options.csv) {
    write_output(require_csv(found, is_one_sided));
    return ExitCode::success;
  }
  print_answer(options, found, [&](const Json& json) { return require_text(json, is_one_sided); });
  return ExitCode::success;
}

}  // namespace

Run declare_require(Options& options) {
  const auto args = std::make_shared<RequireOptions>();
  declare_results(options, args->results);
  for (const RequirementTraits& kind : requirement_kinds()) {
    if (kind.option == nullptr) continue;
    options.option(kind.option, kind.is_probability ? "P" : "N", kind.asks,
                   [args = args.get(), &kind](const auto& text, const auto& /*option*/) {
                     args->limits.emplace_back(&kind, text);
                   });
  }
  options.option(args->axes, "--over", "STATES", "The state that is sought, or two with a comma between",
                 as_typed);
  options.option(args->given, "--given", "VALUES",
                 "Values of other states, e.g. v1=1,v2=-1; a state left out may have any value",
                 named_values);
  options.option(
      args->best, "--best", "WORDS",
      "Which values are better, large or small: only the bound from which on, or up to which; for two "
      "states optionally two words (default: large; for one state all intervals)",
      as_typed);
  options.option(args->partition, "--partition", "NAME", "Partition (default: the only one)", as_typed);
  options.flag(args->csv, "--csv", "A line for each interval, or corner of the region, as CSV");
  declare_common(options, *args, {.threads = false});
  return [args] { return run(*args); };
}

}  // namespace coordreq
