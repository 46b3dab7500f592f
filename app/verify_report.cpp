#include "app/verify_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/json_text.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

const char* status_of(const Finding& finding) {
  if (finding.wrong > 0) return "wrong";
  return finding.unproven > 0 ? "not confirmed" : "holds";
}

std::string result_text(const Finding& finding) {
  if (finding.wrong > 0) return grouped(finding.wrong) + " wrong";
  if (finding.unproven > 0) return grouped(finding.unproven) + " not confirmed";
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

/// The first few of many, by the name of their check.
std::string examples_of(const Finding& finding, const std::vector<std::string>& texts, std::int64_t all,
                        const char* what) {
  if (texts.empty()) return "";
  std::string text = fmt::format("\n{}{}\n", printable(finding.check), what);
  for (const std::string& example : texts) text += "  " + printable(example) + "\n";
  const auto more = all - static_cast<std::int64_t>(texts.size());
  if (more > 0) text += "  and " + grouped(more) + " more\n";
  return text;
}

std::string examples(const Verification& result) {
  std::string text;
  for (const Finding& finding : result.findings) {
    text += examples_of(finding, finding.examples, finding.wrong, "");
    text += examples_of(finding, finding.doubts, finding.unproven, ", not confirmed");
  }
  return text;
}

/// How many reachable sets enclosures were asked about, and confirm.
std::string confirmed_text(const Verification& result) {
  if (result.enclosed == 0) return "";
  return fmt::format("confirmed: {} of {} reachable sets that are not exact\n", grouped(result.confirmed),
                     grouped(result.enclosed));
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

std::string verdict(const Verification& result, const std::string& path) {
  const std::string name = printable(path);
  if (!result.holds()) return name + " does not hold";
  const bool sampled = result.cells_checked < result.cells;
  const std::string what = sampled ? fmt::format("{} of {} cells of {}", grouped(result.cells_checked),
                                                 grouped(result.cells), name)
                                   : name;
  return what + (result.verdict() == Verdict::holds ? " holds" : " holds, apart from what is not confirmed");
}

const char* verdict_word(Verdict verdict) {
  if (verdict == Verdict::holds) return "holds";
  return verdict == Verdict::wrong ? "wrong" : "not confirmed";
}

Json finding_json(const Finding& finding) {
  Json json;
  json["check"] = finding.check;
  json["status"] = status_of(finding);
  json["checked"] = finding.checked;
  json["wrong"] = finding.wrong;
  json["not_confirmed"] = finding.unproven;
  json["examples"] = finding.examples;
  json["doubts"] = finding.doubts;
  return json;
}

}  // namespace

std::string verification_text(const Verification& result, const std::string& path, double seconds,
                              int threads) {
  return fmt::format("{}\n{}{}\n{} ({:.2f} s on {} thread{})\n", findings_table(result),
                     basis_text(result) + "\n" + tubes_text(result) + confirmed_text(result),
                     examples(result), verdict(result, path), seconds, threads, threads == 1 ? "" : "s");
}

std::string not_confirmed_line(const Verification& result, const std::string& path) {
  std::string checks;
  for (const Finding& finding : result.findings) {
    if (finding.unproven == 0) continue;
    checks += fmt::format("{}{} of {} in '{}'", checks.empty() ? "" : ", ", grouped(finding.unproven),
                          grouped(finding.checked), printable(finding.check));
  }
  return fmt::format("coordreq: warning: not confirmed: {} ({})\n", checks, printable(path));
}

std::string verification_json(const Verification& result, const std::string& path, double seconds,
                              int threads) {
  Json json;
  json["file"] = path;
  json["name"] = result.name;
  json["holds"] = result.holds();
  json["verdict"] = verdict_word(result.verdict());
  json["cells"] = result.cells;
  json["cells_checked"] = result.cells_checked;
  json["reachable_sets"] = basis_word(result.basis);
  json["between_samples"] = result.tubes ? Json(basis_word(*result.tubes)) : Json(nullptr);
  json["not_independent"] = result.borrowed;
  json["confirmed"] = {{"reachable_sets", result.confirmed}, {"of", result.enclosed}};
  json["checks"] = Json::array();
  for (const Finding& finding : result.findings) json["checks"].push_back(finding_json(finding));
  json["threads"] = threads;
  json["seconds"] = seconds;
  return json_text(json);
}

}  // namespace coordreq
