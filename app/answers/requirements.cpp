#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/answers/all.hpp"
#include "app/requirement_text.hpp"
#include "spec/requirement_kind.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

/// Whether the file has an answer by which requirements may judge states otherwise than by delays.
bool has_other_values(const Json& info) {
  return std::ranges::any_of(requirement_kinds(), [&info](const RequirementTraits& kind) {
    return !kind.needs.empty() && info.contains(kind.needs);
  });
}

}  // namespace

std::string requirements_of_file(const Json& info) {
  const auto least = [&info](const Json& entry) {
    const std::string key = worst_key(entry);
    const Json& status = entry[key + "_status"];
    return status == "steps" ? duration(entry[key], info) : text_of(status);
  };
  const auto counterexample = [&info](const Json& entry) {
    const Json& steps = entry["counterexample_steps"];
    return !steps.is_null() ? duration(steps, info) : entry["holds"] ? "-" : "outside the domain";
  };
  if (info["requirements"].empty()) return "";
  return "\n" +
         table_text(
             info["requirements"],
             {{"requirement", Align::left, [](const Json& entry) { return line_of(entry["name"]); }},
              {"verdict", Align::left, [](const Json& entry) { return entry["holds"] ? "holds" : "FAILS"; }},
              {"cells", Align::right, [](const Json& entry) { return grouped(entry["cells"]); }},
              {"failing", Align::right, [](const Json& entry) { return grouped(entry["failing"]); }},
              {has_other_values(info) ? "worst" : "least delay", Align::left, least},
              {"counterexample", Align::right, counterexample}});
}

}  // namespace coordreq
