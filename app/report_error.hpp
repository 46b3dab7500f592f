#pragma once

#include <string>
#include <vector>

namespace coordreq {

/// The exit code for a bug in this program; sysexits.h calls it EX_SOFTWARE.
constexpr int kInternalError = 70;

/// Whether the arguments ask for JSON, whatever else is wrong with them.
[[nodiscard]] bool asks_for_json(int argc, const char* const* argv) noexcept;

/// Prints the current exception as one line "coordreq: error: WHAT (WHERE)".
/// @pre called from within a catch block. @param as_json also as a document on standard output, where
///   nothing has been written yet. @returns the exit code
[[nodiscard]] int report_current_exception(bool as_json = false) noexcept;

/// From now on an exception that nothing can catch is reported so as well, and ends the program: one that is
/// thrown while another is being handled, as where memory runs out and clearing up takes more of it. GMP says
/// by an exception that it is given no memory.
void report_what_terminates();

/// The request to report a bug of this program: "please report it ...", with the address for it if the build
/// has one (COORDREQ_ISSUES).
[[nodiscard]] std::string report_request();

/// The message of an exception after which the program continues.
struct Failure {
  std::string what;  ///< WHAT (WHERE), on one line
  int exit_code = 0;
  std::vector<std::string> more;  ///< lines like it, of a spec with several errors
};

/// The current exception. @pre called from within a catch block
[[nodiscard]] Failure describe_current_exception();

/// Prints it as report_current_exception() does, for one of several things to do. @param subject the thing
void report_failure(const std::string& subject, const Failure& failure);

}  // namespace coordreq
