#pragma once

#include <string>

namespace coordreq {

/// The exit code for a bug in this program; sysexits.h calls it EX_SOFTWARE.
constexpr int kInternalError = 70;

/// Prints the exception under way as one line "coordreq: error: WHAT (WHERE)".
/// REQUIRES: called from within a catch block. @returns the exit code
[[nodiscard]] int report_current_exception() noexcept;

/// From now on an exception that nothing can catch is reported so as well, and ends the program: one that is
/// thrown while another is under way, as where memory runs out and clearing up takes more of it.
void report_what_terminates();

/// What an exception says, where the program goes on.
struct Failure {
  std::string what;  ///< WHAT (WHERE), on one line
  int exit_code = 0;
};

/// The exception under way. REQUIRES: called from within a catch block.
[[nodiscard]] Failure describe_current_exception();

/// Prints it as report_current_exception() does, for one of several things to do. @param subject the thing
void report_failure(const std::string& subject, const Failure& failure);

}  // namespace coordreq
