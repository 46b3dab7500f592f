#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/analyze.hpp"
#include "base/thread_team.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {

/// Analyses a spec into a results file; `output` is the content of the spec's "output" object.
/// REQUIRES: the text ends in "}" and has no "output".
inline void analyze_into(const std::string& path, std::string spec_text, const std::string& output,
                         ThreadTeam& team) {
  spec_text.insert(spec_text.rfind('}'), ", \"output\": {" + output + "}");
  AnalysisOptions options;
  options.output = path;
  static_cast<void>(analyze(read_spec(spec_text, "test"), options, team));
}

}  // namespace coordreq
