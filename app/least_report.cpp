#include "app/reports.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "answers/step_codes.hpp"
#include "app/query_report.hpp"
#include "app/render.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::string least_steps_text(const Json& found, const Field& field) {
  const std::string status = text_of(found["least_status"]);
  if (status == "unbounded") return "unbounded";
  if (status == "steps") return duration(found["least"], found);
  if (status == "at_least") return "at least " + duration(found["least"], found);
  return status_text(field, status);
}

}  // namespace

Json least_json(const LeastSteps& found, const Field& field, std::size_t partition,
                std::optional<std::int32_t> at_least, const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  const bool is_lower_bound = results.lower_bound(field, partition) == std::int64_t{found.least};
  Json json = {{"name", spec.name},
               {"results", results.path()},
               {"guarantee", results.attributes().guarantee},
               {"partition", results.partitions()[partition].name},
               {"period", nearest_double(spec.dynamics.period)},
               {"period_unit", spec.dynamics.unit},
               {"pairs", found.pairs}};
  json["least"] = found.least == kUnbounded ? Json() : Json(found.least);
  json["least_status"] = is_lower_bound ? "at_least" : status_of(field, found.least);
  json["pair"] = found.pair;
  if (at_least) {
    json["at_least"] = *at_least;
    json["below"] = *found.below;
  }
  return json;
}

std::string least_text(const Json& found, const Field& field) {
  const std::string pairs = count_of(number_of(found["pairs"]), "pair");
  Facts facts = {{"least silence", least_steps_text(found, field) + ", of pair " + line_of(found["pair"])}};
  if (found.contains("below")) {
    facts.emplace_back("below " + duration(found["at_least"], found),
                       fmt::format("{} of {}", grouped(found["below"]), pairs));
  }
  return fmt::format("{}, partition {}: {}\n", line_of(found["name"]), line_of(found["partition"]), pairs) +
         facts_text(facts);
}

}  // namespace coordreq
