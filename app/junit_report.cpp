#include "app/junit_report.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>
#include <system_error>

#include "app/reports.hpp"
#include "app/requirement_text.hpp"
#include "app/text.hpp"
#include "base/error.hpp"
#include "results/output_file.hpp"

namespace coordreq {
namespace {

/// XML knows neither U+FFFE nor U+FFFF, however they are written.
std::string xml_text(std::string result) {
  for (const char* const unknown : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    for (std::size_t at = result.find(unknown); at != std::string::npos; at = result.find(unknown, at))
      result.replace(at, 3, "\xef\xbf\xbd");
  }
  return result;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(xml_text(printable(value)).c_str());
}

pugi::xml_node add_case(pugi::xml_node suite, const std::string& class_name, const std::string& name) {
  pugi::xml_node test = suite.append_child("testcase");
  set(test, "classname", class_name);
  set(test, "name", name);
  set(test, "time", "0");
  return test;
}

void add_requirement(pugi::xml_node suite, const std::string& class_name, const Json& entry,
                     const ProblemSpec& spec) {
  pugi::xml_node test = add_case(suite, class_name, entry["name"].get<std::string>());
  if (entry["holds"]) return;
  pugi::xml_node failure = test.append_child("failure");
  set(failure, "message", failure_line(entry, spec));
  set(failure, "type", entry["kind"].get<std::string>());
  const std::string text = claim_text(entry, spec) + "\n" + failure_text(entry, spec);
  failure.append_child(pugi::node_pcdata).set_value(xml_text(text).c_str());
}

/// The counts of a suite, and of all suites.
struct Totals {
  std::size_t tests = 0;
  std::size_t failures = 0;
  std::size_t errors = 0;
  double seconds = 0;

  void add(const Totals& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    seconds += other.seconds;
  }
};

Totals totals_of(const JunitSuite& suite) {
  if (suite.summary == nullptr) return {.tests = 1, .errors = 1};
  const Json& all = (*suite.summary)["requirements"];
  Totals totals{.tests = all.size(), .seconds = seconds_of(*suite.summary)};
  for (const Json& entry : all) totals.failures += entry["holds"] ? 0U : 1U;
  return totals;
}

void set_head(pugi::xml_node node, const std::string& name, const Totals& totals) {
  set(node, "name", name);
  set(node, "tests", std::to_string(totals.tests));
  set(node, "failures", std::to_string(totals.failures));
  set(node, "errors", std::to_string(totals.errors));
  set(node, "time", fmt::format("{:.3f}", totals.seconds));
}

void add_suite(pugi::xml_node root, const JunitSuite& content) {
  pugi::xml_node suite = root.append_child("testsuite");
  set_head(suite, content.name, totals_of(content));
  if (content.summary == nullptr) {
    set(add_case(suite, content.name, "analysis").append_child("error"), "message", content.error);
    return;
  }
  for (const Json& requirement : (*content.summary)["requirements"])
    add_requirement(suite, content.name, requirement, *content.spec);
}

}  // namespace

std::string junit_text(const std::vector<JunitSuite>& suites) {
  Totals totals;
  for (const JunitSuite& suite : suites) totals.add(totals_of(suite));
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("testsuites");
  set_head(root, "coordreq", totals);
  for (const JunitSuite& suite : suites) add_suite(root, suite);
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

void write_junit(const std::string& path, const std::vector<JunitSuite>& suites) {
  const std::string text = junit_text(suites);
  write_whole_file(path, "the JUnit report", [&](const std::string& temporary) {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file << text << std::flush;
    if (!file) {
      throw IoError(
          "cannot write the JUnit report: " + std::generic_category().message(errno == 0 ? EIO : errno),
          path);
    }
  });
}

}  // namespace coordreq
