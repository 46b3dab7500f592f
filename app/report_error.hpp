#pragma once

namespace coordreq {

/// The exit code for a bug in this program; sysexits.h calls it EX_SOFTWARE.
constexpr int kInternalError = 70;

/// Prints the exception under way as one line "coordreq: error: WHAT (WHERE)".
/// REQUIRES: called from within a catch block. @returns the exit code
[[nodiscard]] int report_current_exception() noexcept;

}  // namespace coordreq
