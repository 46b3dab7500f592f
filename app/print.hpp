#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/options.hpp"
#include "base/json.hpp"

namespace coordreq {

/// Prints what a command has found: as it is with --json, else as text, which is made of nothing but it,
/// unless --quiet.
void print_answer(const CommonOptions& args, const Json& answer,
                  const std::function<std::string(const Json&)>& to_text);

/// Prints warnings to standard error, a line each, unless --quiet. Of several analyses each line is printed
/// once.
class PrintedWarnings {
 public:
  explicit PrintedWarnings(const CommonOptions& args) : is_quiet_(args.quiet) {}

  /// @param warnings of warnings_json()
  /// @param subject one of several things that were analysed; empty: the only one
  void print(const Json& warnings, const std::string& subject = {});

 private:
  bool is_quiet_;
  std::set<std::string> lines_;
};

/// Warns once of names in a log or a table that mean nothing to a command: that a log holds more is no
/// defect, but a slip in a name would be.
class IgnoredColumns {
 public:
  /// @param what is not called so: "no state" @param source where they stand
  IgnoredColumns(bool is_quiet, std::string what, std::string source = "standard input")
      : is_reported_(is_quiet), what_(std::move(what)), source_(std::move(source)) {}

  /// @param hint what follows "ignored"
  void warn(const std::vector<std::string>& names, const std::string& hint);

 private:
  bool is_reported_;
  std::string what_;
  std::string source_;
};

}  // namespace coordreq
