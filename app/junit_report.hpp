#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// One analysis.
struct JunitSuite {
  std::string name;
  const ProblemSpec* spec = nullptr;  ///< none if the analysis failed
  const Json* summary = nullptr;      ///< of the analysis; likewise
  std::string error;                  ///< why it failed
};

/// The requirements as a JUnit report, which CI systems show: a test suite for each analysis, a test case for
/// each requirement, a failure with the counterexample for one that fails. An analysis that
/// failed is a test case with an error.
[[nodiscard]] std::string junit_text(const std::vector<JunitSuite>& suites);

/// Writes it to a file that appears whole or not at all. @throws IoError
void write_junit(const std::string& path, const std::vector<JunitSuite>& suites);

}  // namespace coordreq
