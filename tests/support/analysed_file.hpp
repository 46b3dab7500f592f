#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "analysis/analyze.hpp"
#include "results/scratch_folder.hpp"
#include "spec/read_spec.hpp"
#include "verify/verify_file.hpp"

namespace coordreq {

/// A spec text with everything that can be stored on request.
inline std::string storing_everything(std::string text) {
  text.erase(text.rfind('}'));
  return text + R"(, "output": {"controller": true, "actions": true, "layers": true, "abstraction": true}})";
}

/// The results of a spec, written to a file and read again.
inline ClaimedFile analysed_file(const std::string& spec_text, ThreadTeam& team) {
  const sample::ScratchFolder folder;
  const std::string path = folder / "results.h5";
  AnalysisOptions options;
  options.output = path;
  static_cast<void>(analyze(read_spec(spec_text, "test"), options, team));
  return read_claims(path, {});
}

/// All checks that find something wrong, as "name: first example".
inline std::string complaints(const Verification& result) {
  std::string text;
  for (const Finding& finding : result.findings) {
    if (finding.wrong > 0) text += finding.check + ": " + finding.examples.front() + "\n";
  }
  return text;
}

}  // namespace coordreq
