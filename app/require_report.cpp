#include "app/reports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/render.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The face of a cell on the worse side, of a boundary cell at a limit the limit.
double worst_value(const GridDimension& dimension, std::int64_t index, bool is_large_best) {
  const Rational half = is_large_best ? Rational(-dimension.radius()) : dimension.radius();
  return nearest_double(dimension.point(index) + half);
}

Json axis_json(const ResultsReader& results, const ToleranceQuestion::Axis& axis) {
  const GridDimension& dimension = results.grid()[axis.state];
  const std::int64_t best = axis.is_large_best ? dimension.count - 1 : 0;
  return {{"state", dimension.name},
          {"unit", results.spec().states[axis.state].unit},
          {"best", axis.is_large_best ? "large" : "small"},
          {"worst_value", worst_value(dimension, dimension.count - 1 - best, axis.is_large_best)},
          {"best_value", worst_value(dimension, best, !axis.is_large_best)}};
}

/// "p1 from 2.5 m on", "p1 up to 2.5 m".
std::string bound_text(const Json& entry, const Json& value) {
  const std::string unit = text_of(entry["unit"]);
  const std::string bound =
      fmt::format("{:.6g}{}{}", value.get<double>(), unit.empty() ? "" : " ", printable(unit));
  return entry["best"] == "large" ? fmt::format("{} from {} on", text_of(entry["state"]), bound)
                                  : fmt::format("{} up to {}", text_of(entry["state"]), bound);
}

std::string corner_text(const Json& found, const Json& corner) {
  std::vector<std::string> bounds;
  for (std::size_t i = 0; i < corner.size(); ++i) bounds.push_back(bound_text(found["over"][i], corner[i]));
  return fmt::format("{}", fmt::join(bounds, ", "));
}

/// "p1 = 10.5 m, v1 = 3.25 m/s": the ends of the domain that are best in the states in question.
std::string best_ends_text(const Json& found) {
  std::vector<std::string> ends;
  for (const Json& entry : found["over"]) {
    const std::string unit = text_of(entry["unit"]);
    ends.push_back(fmt::format("{} = {:.6g}{}{}", text_of(entry["state"]), entry["best_value"].get<double>(),
                               unit.empty() ? "" : " ", printable(unit)));
  }
  return fmt::format("{}", fmt::join(ends, ", "));
}

/// "T1 from 18.5 to 22.25 degC"; an end of the domain means any value: "p1 from 2.5 m on".
std::string interval_text(const Json& entry, const Json& interval) {
  const bool is_large_best = entry["best"] == "large";
  const Json& lower_end = entry[is_large_best ? "worst_value" : "best_value"];
  const Json& upper_end = entry[is_large_best ? "best_value" : "worst_value"];
  const bool has_lower = interval[0] != lower_end, has_upper = interval[1] != upper_end;
  const std::string unit = text_of(entry["unit"]);
  const std::string behind = unit.empty() ? "" : " " + printable(unit);
  const std::string name = text_of(entry["state"]);
  const auto from = interval[0].get<double>(), to = interval[1].get<double>();
  if (!has_lower && !has_upper)
    return fmt::format("{} from {:.6g}{} on, all of the domain", name, from, behind);
  if (!has_upper) return fmt::format("{} from {:.6g}{} on", name, from, behind);
  if (!has_lower) return fmt::format("{} up to {:.6g}{}", name, to, behind);
  return fmt::format("{} from {:.6g} to {:.6g}{}", name, from, to, behind);
}

/// "a delay of at least 2 steps (2 s)".
std::string limit_text(const Json& found) {
  const RequirementTraits& kind = requirement_traits(text_of(found["kind"]));
  const std::string value = label_of(kind.value);
  const std::string article = value.front() == 'a' ? "an" : "a";
  const Json& limit = found[kind.value];
  return fmt::format("{} {} of at {} {}", article, value, kind.is_upper_limit ? "most" : "least",
                     kind.is_probability ? probability_text(limit) : duration(limit, found));
}

/// "x1 from -0.995 m", of all of the domain.
bool is_everywhere(const Json& found) {
  const Json& axes = found["over"];
  const Json& corners = found["corners"];
  if (corners.size() != 1) return false;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (corners[0][i] != axes[i]["worst_value"]) return false;
  return true;
}

}  // namespace

Json require_json(const ResultsReader& results, const ToleranceQuestion& question,
                  const Tolerance& tolerance) {
  const ProblemSpec& spec = results.spec();
  Json json = {{"name", spec.name},
               {"results", results.path()},
               {"guarantee", results.attributes().guarantee},
               {"partition", results.partitions()[question.partition].name},
               {"period", nearest_double(spec.dynamics.period)},
               {"period_unit", spec.dynamics.unit}};
  const RequirementTraits& kind = traits(question.kind);
  json[kind.value] = kind.is_probability ? Json(question.risk) : Json(question.steps);
  json["kind"] = kind.key;
  json["over"] = Json::array();
  for (const ToleranceQuestion::Axis& axis : question.axes) json["over"].push_back(axis_json(results, axis));
  json["given"] = Json::object();
  std::vector<bool> is_named(results.grid().size(), false);
  for (const ToleranceQuestion::Axis& axis : question.axes) is_named[axis.state] = true;
  for (const TableSelection::Slice& slice : question.given) {
    const GridDimension& dimension = results.grid()[slice.dimension];
    json["given"][dimension.name] = nearest_double(dimension.point(slice.index));
    is_named[slice.dimension] = true;
  }
  json["whatever"] = Json::array();
  for (std::size_t i = 0; i < is_named.size(); ++i)
    if (!is_named[i]) json["whatever"].push_back(results.grid()[i].name);
  json["corners"] = Json::array();
  for (const FrontierCorner& corner : tolerance.corners) {
    Json& values = json["corners"].emplace_back(Json::array());
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const ToleranceQuestion::Axis& axis = question.axes[i];
      values.push_back(worst_value(results.grid()[axis.state], corner[i], axis.is_large_best));
    }
  }
  if (question.axes.size() > 1) return json;
  json["intervals"] = Json::array();
  const GridDimension& dimension = results.grid()[question.axes.front().state];
  for (const auto& [first, last] : tolerance.intervals)
    json["intervals"].push_back({worst_value(dimension, first, true), worst_value(dimension, last, false)});
  return json;
}

std::string require_text(const Json& found, bool is_one_sided) {
  Facts facts;
  if (!found["given"].empty()) facts.emplace_back("given the cell of", values_text(found["given"]));
  if (!found["whatever"].empty())
    facts.emplace_back("whatever",
                       fmt::format("{}", fmt::join(found["whatever"].get<std::vector<std::string>>(), ", ")));
  facts.emplace_back("guarantee", guarantee_text(text_of(found["guarantee"])));
  const bool has_intervals = found.contains("intervals");
  if (has_intervals && !is_one_sided) {
    if (found["intervals"].empty()) facts.emplace_back("tolerated", "nowhere");
    for (const Json& interval : found["intervals"])
      facts.emplace_back("tolerated", interval_text(found["over"][0], interval));
  } else if (found["corners"].empty()) {
    std::string text = fmt::format("not even at the best end, {}", best_ends_text(found));
    if (has_intervals && !found["intervals"].empty())
      text += "; but " + interval_text(found["over"][0], found["intervals"][0]);
    facts.emplace_back("tolerated", text);
  }
  for (std::size_t c = 0; (is_one_sided || !has_intervals) && c < found["corners"].size(); ++c) {
    const Json& corner = found["corners"][c];
    facts.emplace_back("tolerated", fmt::format("{}{}", corner_text(found, corner),
                                                is_everywhere(found) ? ", all of the domain" : ""));
  }
  return fmt::format("{}, partition {}: {}\n{}", text_of(found["name"]), text_of(found["partition"]),
                     limit_text(found), facts_text(facts));
}

std::string require_csv(const Json& found, bool is_one_sided) {
  if (!is_one_sided && found.contains("intervals")) {
    const std::string name = text_of(found["over"][0]["state"]);
    std::string text = fmt::format("{0}_from,{0}_to\n", name);
    for (const Json& interval : found["intervals"])
      text += fmt::format("{},{}\n", interval[0].get<double>(), interval[1].get<double>());
    return text;
  }
  std::vector<std::string> names;
  for (const Json& entry : found["over"]) names.push_back(text_of(entry["state"]));
  std::string text = fmt::format("{}\n", fmt::join(names, ","));
  for (const Json& corner : found["corners"])
    text += fmt::format("{}\n", fmt::join(corner.get<std::vector<double>>(), ","));
  return text;
}

}  // namespace coordreq
