#pragma once

#include <set>
#include <string>

#include "app/options.hpp"
#include "base/json.hpp"

namespace coordreq {

/// Prints warnings to standard error, a line each, unless --quiet. Of several analyses each line is printed
/// once.
class PrintedWarnings {
 public:
  explicit PrintedWarnings(const CommonOptions& asked) : is_quiet_(asked.quiet) {}

  /// @param warnings of warnings_json()
  /// @param subject one of several things that were analysed; empty: the only one
  void print(const Json& warnings, const std::string& subject = {});

 private:
  bool is_quiet_;
  std::set<std::string> lines_;
};

}  // namespace coordreq
