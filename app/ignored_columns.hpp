#pragma once

#include <string>
#include <vector>

namespace coordreq {

/// Warns once of names on standard input that mean nothing to a command: that a log holds more is no defect,
/// but a slip in a name would be.
class IgnoredColumns {
 public:
  /// @param what is not called so: "no state"
  IgnoredColumns(bool is_quiet, std::string what) : is_told_(is_quiet), what_(std::move(what)) {}

  /// @param hint what follows "ignored"
  void tell(const std::vector<std::string>& names, const std::string& hint);

 private:
  bool is_told_;
  std::string what_;
};

}  // namespace coordreq
