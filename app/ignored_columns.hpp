#pragma once

#include <string>
#include <utility>
#include <vector>

namespace coordreq {

/// Warns once of names in a log or a table that mean nothing to a command: that a log holds more is no
/// defect, but a slip in a name would be.
class IgnoredColumns {
 public:
  /// @param what is not called so: "no state" @param source where they stand
  IgnoredColumns(bool is_quiet, std::string what, std::string source = "standard input")
      : is_told_(is_quiet), what_(std::move(what)), source_(std::move(source)) {}

  /// @param hint what follows "ignored"
  void tell(const std::vector<std::string>& names, const std::string& hint);

 private:
  bool is_told_;
  std::string what_;
  std::string source_;
};

}  // namespace coordreq
