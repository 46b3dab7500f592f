#include "app/junit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <pugixml.hpp>
#include <sstream>

#include "app/requirement_report.hpp"
#include "app/text.hpp"
#include "base/error.hpp"
#include "results/whole_file.hpp"

namespace coordreq {
namespace {

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(value.c_str());
}

/// XML knows no control characters, whatever way they are written, and neither U+FFFE nor U+FFFF.
std::string xml_text(const std::string& text) {
  std::string result = printable(text);
  for (const char* const unknown : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    for (std::size_t at = result.find(unknown); at != std::string::npos; at = result.find(unknown, at))
      result.replace(at, 3, "\xef\xbf\xbd");
  }
  return result;
}

void add_case(pugi::xml_node suite, const ResultRequirement& result, const RequirementSpec& requirement,
              const ProblemSpec& spec) {
  pugi::xml_node test = suite.append_child("testcase");
  set(test, "classname", spec.name);
  set(test, "name", xml_text(result.name));
  set(test, "time", "0");
  if (result.holds) return;
  pugi::xml_node failure = test.append_child("failure");
  set(failure, "message", failure_line(result, spec));
  set(failure, "type", requirement.invariant ? "invariant" : "min_delay");
  const std::string text =
      requirement_claim(requirement, spec) + "\n" + failure_text(result, requirement, spec);
  failure.append_child(pugi::node_pcdata).set_value(text.c_str());
}

}  // namespace

std::string junit_text(const AnalysisSummary& summary, const ProblemSpec& spec) {
  const auto failures =
      std::count_if(summary.requirements.begin(), summary.requirements.end(),
                    [](const ResultRequirement& requirement) { return !requirement.holds; });
  double seconds = 0;
  for (const auto& stage : summary.seconds) seconds += stage.second;
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("testsuites");
  pugi::xml_node suite = root.append_child("testsuite");
  for (pugi::xml_node node : {root, suite}) {
    set(node, "name", node == root ? "coordreq" : spec.name);
    set(node, "tests", std::to_string(summary.requirements.size()));
    set(node, "failures", std::to_string(failures));
    set(node, "errors", "0");
    set(node, "time", fmt::format("{:.3f}", seconds));
  }
  for (std::size_t r = 0; r < summary.requirements.size(); ++r)
    add_case(suite, summary.requirements[r], spec.requirements[r], spec);
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

void write_junit(const std::string& path, const AnalysisSummary& summary, const ProblemSpec& spec) {
  const std::string text = junit_text(summary, spec);
  write_whole_file(path, "the JUnit report", [&](const std::string& temporary) {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file << text << std::flush;
    if (!file) throw IoError("cannot write the JUnit report", path);
  });
}

}  // namespace coordreq
