#include "app/reports.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/print.hpp"
#include "app/render.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

const char* status_of(const Finding& finding) {
  if (finding.wrong > 0) return "wrong";
  return finding.unproven > 0 ? "not confirmed" : "holds";
}

const char* basis_name(PostBasis basis) {
  if (basis == PostBasis::exact) return "exact";
  return basis == PostBasis::stored ? "stored" : "computed";
}

const char* verdict_name(Verdict verdict) {
  if (verdict == Verdict::holds) return "holds";
  return verdict == Verdict::wrong ? "wrong" : "not confirmed";
}

Json finding_json(const Finding& finding) {
  return {{"check", finding.check},  {"status", status_of(finding)},      {"checked", finding.checked},
          {"wrong", finding.wrong},  {"not_confirmed", finding.unproven}, {"examples", finding.examples},
          {"doubts", finding.doubts}};
}

std::string result_text(const Json& finding) {
  if (finding["wrong"] > 0) return grouped(finding["wrong"]) + " wrong";
  if (finding["not_confirmed"] > 0) return grouped(finding["not_confirmed"]) + " not confirmed";
  return "holds";
}

std::string findings_table(const Json& findings) {
  return table_text(findings,
                    {{"check", Align::left, [](const Json& entry) { return line_of(entry["check"]); }},
                     {"checked", Align::right, [](const Json& entry) { return grouped(entry["checked"]); }},
                     {"result", Align::left, result_text}});
}

/// The first few of many, by the name of their check.
std::string examples_of(const Json& finding, const Json& texts, const Json& all, const char* what) {
  if (texts.empty()) return "";
  std::string text = fmt::format("\n{}{}\n", line_of(finding["check"]), what);
  for (const Json& example : texts) text += "  " + line_of(example) + "\n";
  const std::int64_t more = number_of(all) - static_cast<std::int64_t>(texts.size());
  if (more > 0) text += "  and " + grouped(more) + " more\n";
  return text;
}

std::string examples(const Json& findings) {
  std::string text;
  for (const Json& finding : findings) {
    text += examples_of(finding, finding["examples"], finding["wrong"], "");
    text += examples_of(finding, finding["doubts"], finding["not_confirmed"], ", not confirmed");
  }
  return text;
}

/// What was not doubted; empty if that is nothing.
std::string given_text(const Json& given) {
  if (given.empty()) return "";
  return fmt::format("taken as given: {}\n", fmt::join(given.get<std::vector<std::string>>(), ", "));
}

/// How many reachable sets were checked with enclosures, how many of them they confirm, and for how many no
/// work was left.
std::string confirmed_text(const Json& confirmed, const Json& work) {
  if (confirmed["of"] == 0) return "";
  std::string text = fmt::format("confirmed: {} of {} reachable sets that are not exact\n",
                                 grouped(confirmed["reachable_sets"]), grouped(confirmed["of"]));
  if (work["left_open"] > 0)
    text += fmt::format("the budget ended: {} were not checked completely, see --budget\n",
                        grouped(work["left_open"]));
  return text;
}

/// On what the verdict on the ways between the samples rests; empty if they do not matter.
std::string tubes_text(const Json& basis) {
  if (basis.is_null()) return "";
  return basis == "exact"
             ? "between the samples: exact, extremes in time from the corners of the cells\n"
             : "between the samples: tubes of the analysis, computed anew, which hold independent "
               "enclosures\n";
}

/// On what the verdict rests.
std::string basis_text(const Json& result) {
  const Json& basis = result["reachable_sets"];
  if (basis == "exact") return "reachable sets: exact, from the corners of the cells\n";
  std::string text =
      basis == "stored"
          ? "reachable sets: those stored in the file, which contain independent enclosures"
          : "reachable sets: those of the analysis, computed anew, which contain independent enclosures";
  const auto borrowed = result["not_independent"].get<std::vector<std::string>>();
  if (!borrowed.empty())
    text += fmt::format(" (except {})", printable(fmt::format("{}", fmt::join(borrowed, ", "))));
  return text + "\n";
}

std::string verdict_cell(const Json& result) {
  const std::string name = line_of(result["file"]);
  if (!result["holds"].get<bool>()) return name + " does not hold";
  const bool sampled = result["cells_checked"] < result["cells"];
  const std::string what = sampled ? fmt::format("{} of {} cells of {}", grouped(result["cells_checked"]),
                                                 grouped(result["cells"]), name)
                                   : name;
  const bool is_one = !sampled || result["cells_checked"] == 1;
  return what + (is_one ? " holds" : " hold") +
         (result["verdict"] == "holds" ? "" : ", except for what is not confirmed");
}

Json verification_json(const Verification& result, const std::string& path, double seconds, int threads) {
  Json json;
  json["file"] = path;
  json["name"] = result.name;
  json["holds"] = result.holds();
  json["verdict"] = verdict_name(result.verdict());
  json["cells"] = result.cells;
  json["cells_checked"] = result.cells_checked;
  json["reachable_sets"] = basis_name(result.basis);
  json["between_samples"] = result.tubes ? Json(basis_name(*result.tubes)) : Json(nullptr);
  json["not_independent"] = result.borrowed;
  json["taken_as_given"] = result.given;
  json["confirmed"] = {{"reachable_sets", result.confirmed}, {"of", result.enclosed}};
  json["posts_computed"] = result.posts_computed;
  json["work"] = {
      {"spent", result.work.spent}, {"budget", result.work.budget}, {"left_open", result.work.left_open}};
  json["checks"] = Json::array();
  for (const Finding& finding : result.findings) json["checks"].push_back(finding_json(finding));
  json["threads"] = threads;
  json["seconds"] = seconds;
  return json;
}

std::string verification_text(const Json& result) {
  const Json& findings = result["checks"];
  const std::int64_t threads = number_of(result["threads"]);
  return fmt::format("{}\n{}{}{}{}{}\n{} ({:.2f} s on {} thread{})\n", findings_table(findings),
                     basis_text(result), tubes_text(result["between_samples"]),
                     given_text(result["taken_as_given"]),
                     confirmed_text(result["confirmed"], result["work"]), examples(findings),
                     verdict_cell(result), result["seconds"].get<double>(), threads, threads == 1 ? "" : "s");
}

std::string not_confirmed_line(const Json& result) {
  std::string checks;
  for (const Json& finding : result["checks"]) {
    if (finding["not_confirmed"] == 0) continue;
    checks += fmt::format("{}{} of {} in '{}'", checks.empty() ? "" : ", ", grouped(finding["not_confirmed"]),
                          grouped(finding["checked"]), line_of(finding["check"]));
  }
  return fmt::format("coordreq: warning: not confirmed: {} ({})\n", checks, line_of(result["file"]));
}

}  // namespace

void print_verification(const CommonOptions& args, const Verification& result, const std::string& path,
                        double seconds, int threads) {
  const Json found = verification_json(result, path, seconds, threads);
  print_answer(args, found, verification_text);
  if (result.verdict() == Verdict::not_confirmed) write_diagnostics(not_confirmed_line(found));
}

}  // namespace coordreq
