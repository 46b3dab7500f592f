#include <fmt/format.h>

#include <algorithm>
#include <array>
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
#include "cell/simulate.hpp"
#include "cell/state_text.hpp"
#include "model/locate.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

struct RequireOptions : CommonOptions {
  std::string results, axes, partition;
  std::vector<std::optional<std::string>> limits =
      std::vector<std::optional<std::string>>(6);  ///< by kLimits
  std::optional<std::string> best;
  NamedValues given;
  bool csv = false;
};

/// The limits that can be requested, by their options.
struct LimitOption {
  RequirementKind kind;
  const char* name;
  const char* takes;
  const char* description;
};
constexpr std::array kLimits = {
    LimitOption{RequirementKind::min_delay, "--delay", "N",
                "The silence to be tolerated: steps, or a time, e.g. 2s or 10min"},
    LimitOption{RequirementKind::min_silence, "--silence", "N",
                "The same by the communication-loss rule of the spec ('silence')"},
    LimitOption{RequirementKind::min_blind_delay, "--blind", "N",
                "The same for agents with their own observations only ('sees')"},
    LimitOption{RequirementKind::min_approach_delay, "--approach", "N",
                "The silence that costs no time on the way to the goal ('goal')"},
    LimitOption{RequirementKind::max_arrival, "--arrival", "N",
                "The steps, or the time, within which the goal can be forced ('goal')"},
    LimitOption{RequirementKind::max_risk, "--risk", "P",
                "The maximum probability of leaving the invariance set within the horizon ('risk')"}};

/// The requested limit, of which there is one.
std::pair<LimitOption, std::string> limit_of(const RequireOptions& options) {
  std::optional<std::pair<LimitOption, std::string>> found;
  for (std::size_t i = 0; i < kLimits.size(); ++i) {
    if (!options.limits[i]) continue;
    if (found)
      throw UsageError(fmt::format("expected one limit, found {} too", found->first.name), kLimits[i].name);
    found.emplace(kLimits[i], *options.limits[i]);
  }
  if (!found)
    throw UsageError(
        "missing --delay N, the silence to be tolerated, or one of --silence, --blind, --approach, --arrival "
        "and "
        "--risk");
  return *found;
}

double risk_of(const std::string& text, const char* option) {
  const std::optional<Rational> value = parse_decimal(trimmed(text));
  if (!value || *value < 0 || *value > 1) fail_value("a probability from 0 to 1", text, option);
  return nearest_double(*value);
}

/// @throws UsageError if the results do not have what is requested
void set_limit(const RequireOptions& options, const ResultsReader& results, ToleranceQuestion& question) {
  const auto [limit, text] = limit_of(options);
  const RequirementTraits& kind = traits(limit.kind);
  question.kind = limit.kind;
  const std::string path = dataset_of(limit.kind, results.spec()).path;
  if (!results.has(path)) {
    throw UsageError(
        fmt::format("the results have no {}, expected those of a spec with the key '{}'", path, kind.needs),
        limit.name);
  }
  if (kind.is_probability) {
    question.risk = risk_of(text, limit.name);
  } else {
    question.steps =
        steps_or_time(text, results.spec().dynamics, limit.name,
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
  static_cast<void>(limit_of(options));
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
  for (std::size_t i = 0; i < kLimits.size(); ++i)
    options.option(args->limits[i], kLimits[i].name, kLimits[i].takes, kLimits[i].description, as_typed);
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
