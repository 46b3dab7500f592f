#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "answers/paths.hpp"
#include "app/answers/all.hpp"
#include "app/render.hpp"
#include "app/report_html.hpp"
#include "app/reports.hpp"
#include "app/text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Thresholds of `within` that a table shows, and where they are: 0, 1e-12, 1e-11, ..., 1e-1.
struct Threshold {
  const char* text;
  std::size_t index;
};
constexpr Threshold kThresholds[] = {{"0", 0}, {"1e-9", 4}, {"1e-6", 7}, {"1e-4", 9}, {"1e-2", 11}};

std::string number_or_dash(const Json& number) {
  return number.is_null() ? "-" : probability_text(number);
}

/// How fast it grows later; also by the unit of time, where there is a period with one.
std::string growth_text(double rate, const ProblemSpec& spec) {
  if (rate == 0) return "Beyond the horizon the risk does not grow.";
  const std::string& unit = spec.dynamics.unit;
  const std::string per_time =
      unit.empty()
          ? ""
          : fmt::format(", {} per {}", probability_text(rate / nearest_double(spec.dynamics.period)), unit);
  return fmt::format("Beyond the horizon the risk grows by at most {} per step{}.", probability_text(rate),
                     per_time);
}

/// Where the network is at the first step, and the risk there.
std::string start_text(const Json& start, const ProblemSpec& spec) {
  const std::string where = spec.risk->is_drawn
                                ? "  With the mode of the first step drawn"
                                : "  With the network first in mode " + text_of(start["name"]);
  return fmt::format("{}: worst {}, mean {}.\n", where, number_or_dash(start["worst"]),
                     number_or_dash(start["mean"]));
}

const char* coordinated_text(const ProblemSpec& spec) {
  return spec.risk->is_safest ? "connected agents choose the safest action"
                              : "connected agents choose any action that the controller allows";
}

}  // namespace

std::string risk_of_analysis(const Json& summary, const ProblemSpec& spec) {
  if (!spec.risk || !has_partitions_in_full(summary)) return "";
  const Json& entry = summary["risk"];
  const Json& modes = entry["modes"];
  std::vector<std::string> heads = {"  mode", "worst", "mean"};
  for (const Threshold& threshold : kThresholds) heads.push_back(std::string("at most ") + threshold.text);
  std::vector<Table::Align> columns(heads.size(), Table::Align::right);
  columns.front() = Table::Align::left;
  Table table(columns);
  table.add(heads);
  for (std::size_t mode = 0; mode < std::min(kMostModes, modes.size()); ++mode) {
    std::vector<std::string> row = {"  " + text_of(modes[mode]["name"]), number_or_dash(modes[mode]["worst"]),
                                    number_or_dash(modes[mode]["mean"])};
    for (const Threshold& threshold : kThresholds)
      row.push_back(grouped(modes[mode]["within"][threshold.index]));
    table.add(row);
  }
  return fmt::format("\nrisk within {}: {}\n{}{}{}  {}\n",
                     duration(entry["horizon"].get<std::int64_t>(), nearest_double(spec.dynamics.period),
                              spec.dynamics.unit),
                     coordinated_text(spec), table.text(), more_modes(modes.size()),
                     start_text(entry["start"], spec), growth_text(entry["rate"].get<double>(), spec));
}

bool has_risk(const ProblemSpec& spec) {
  return spec.risk.has_value();
}

std::string mean_risk(const Json& summary) {
  return number_or_dash(summary["risk"]["start"]["mean"]);
}

std::string worst_risk(const Json& summary) {
  return number_or_dash(summary["risk"]["start"]["worst"]);
}

std::string risk_of_file(const Json& info) {
  if (!info.contains("risk")) return "";
  return fmt::format("\nrisk within {}; beyond, it grows by at most {} per step\n",
                     count_of(number_of(info["risk"]["horizon"]), "step"),
                     probability_text(info["risk"]["rate"]));
}

std::string report_risk(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  if (!spec.risk || results.attributes().invariant_cells == 0) return "";
  return fmt::format(
      "<section aria-labelledby=\"risk-title\">\n<h2 id=\"risk-title\">How likely is it to become "
      "unsafe?</h2>\n"
      "<p>The pictures show, in powers of ten, an upper bound on the probability of leaving the states that "
      "can be kept safe, within {}. Here {}, and the network loses steps at random. {} Actions of the agents "
      "and disturbances are the worst case.</p>\n</section>\n",
      html_line(duration(spec.risk->horizon, nearest_double(spec.dynamics.period), spec.dynamics.unit)),
      coordinated_text(spec), html_line(growth_text(results.number(paths::kRisk, "rate"), spec)));
}

}  // namespace coordreq
