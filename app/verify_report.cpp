#include "app/verify_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/json_text.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

const char* status_of(const Finding& finding) {
  if (finding.wrong > 0) return "wrong";
  return finding.unproven > 0 ? "not checked" : "holds";
}

std::string result_text(const Finding& finding) {
  if (finding.wrong > 0) return grouped(finding.wrong) + " wrong";
  if (finding.unproven > 0) return grouped(finding.unproven) + " not checked";
  return "holds";
}

std::string findings_table(const Verification& result) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::left});
  table.add({"check", "checked", "result"});
  for (const Finding& finding : result.findings)
    table.add({printable(finding.check), grouped(finding.checked), result_text(finding)});
  return table.text();
}

std::string examples(const Verification& result) {
  std::string text;
  for (const Finding& finding : result.findings) {
    if (finding.examples.empty()) continue;
    text += fmt::format("\n{}\n", printable(finding.check));
    for (const std::string& example : finding.examples) text += "  " + printable(example) + "\n";
    const auto more = finding.wrong - static_cast<std::int64_t>(finding.examples.size());
    if (more > 0) text += "  and " + grouped(more) + " more\n";
  }
  return text;
}

/// On what the verdict on the ways between the samples rests; empty if they do not matter.
std::string tubes_text(const Verification& result) {
  if (!result.tubes) return "";
  return *result.tubes == PostBasis::exact
             ? "between the samples: exact, extremes in time from the corners of the cells\n"
             : "between the samples: tubes of the analysis, computed anew, which hold independent "
               "enclosures\n";
}

/// On what the verdict rests.
std::string basis_text(const Verification& result) {
  if (result.basis == PostBasis::exact) return "reachable sets: exact, from the corners of the cells";
  std::string text =
      result.basis == PostBasis::stored
          ? "reachable sets: those stored in the file, which hold independent enclosures"
          : "reachable sets: those of the analysis, computed anew, which hold independent enclosures";
  if (!result.borrowed.empty())
    text += fmt::format(" (but for {})", printable(fmt::format("{}", fmt::join(result.borrowed, ", "))));
  return text;
}

const char* basis_word(PostBasis basis) {
  if (basis == PostBasis::exact) return "exact";
  return basis == PostBasis::stored ? "stored" : "computed";
}

bool is_open(const Verification& result) {
  for (const Finding& finding : result.findings) {
    if (finding.unproven > 0) return true;
  }
  return false;
}

std::string verdict(const Verification& result, const std::string& path) {
  const std::string name = printable(path);
  if (!result.holds()) return name + " does not hold";
  const bool sampled = result.cells_checked < result.cells;
  const std::string what = sampled ? fmt::format("{} of {} cells of {}", grouped(result.cells_checked),
                                                 grouped(result.cells), name)
                                   : name;
  return what + (is_open(result) ? " holds, apart from what was not checked" : " holds");
}

Json finding_json(const Finding& finding) {
  Json json;
  json["check"] = finding.check;
  json["status"] = status_of(finding);
  json["checked"] = finding.checked;
  json["wrong"] = finding.wrong;
  json["not_checked"] = finding.unproven;
  json["examples"] = finding.examples;
  return json;
}

}  // namespace

std::string verification_text(const Verification& result, const std::string& path, double seconds,
                              int threads) {
  return fmt::format("{}\n{}{}\n{} ({:.2f} s on {} thread{})\n", findings_table(result),
                     basis_text(result) + "\n" + tubes_text(result), examples(result), verdict(result, path),
                     seconds, threads, threads == 1 ? "" : "s");
}

std::string verification_json(const Verification& result, const std::string& path, double seconds,
                              int threads) {
  Json json;
  json["file"] = path;
  json["name"] = result.name;
  json["holds"] = result.holds();
  json["cells"] = result.cells;
  json["cells_checked"] = result.cells_checked;
  json["reachable_sets"] = basis_word(result.basis);
  json["between_samples"] = result.tubes ? Json(basis_word(*result.tubes)) : Json(nullptr);
  json["not_independent"] = result.borrowed;
  json["checks"] = Json::array();
  for (const Finding& finding : result.findings) json["checks"].push_back(finding_json(finding));
  json["threads"] = threads;
  json["seconds"] = seconds;
  return json_text(json);
}

}  // namespace coordreq
