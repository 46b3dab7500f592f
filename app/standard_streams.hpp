#pragma once

#include <string_view>

// The only way out for text. Nothing here buffers, so that a failed write is noticed where it happens.
namespace coordreq {

/// Opens /dev/null instead of standard streams that the caller closed, so that no file of ours gets their
/// numbers (and no message ends up inside it), makes writing to a closed pipe and beyond a limit of file
/// sizes errors instead of signals, and reading of standard input that fails an error instead of its end.
void hold_standard_streams();

/// Standard output is closed at the other end. Thrown so that temporary files are removed on the way out.
struct ClosedPipe {};

/// Ends the program as the signal would have done that a closed pipe sends.
[[noreturn]] void end_by_closed_pipe() noexcept;

/// Whether write_output() has been called. A signal handler may ask.
[[nodiscard]] bool has_output() noexcept;

/// Writes all of `text` to standard output. @throws IoError if that fails (disk full, closed); ClosedPipe,
/// or an IoError too where the caller has set that signal to be ignored
void write_output(std::string_view text);

/// Writes `text` to standard error as far as possible; a failure cannot be reported.
void write_diagnostics(std::string_view text) noexcept;

/// Shows `text` instead of what this has written before, in one line of the terminal that standard error is;
/// empty: nothing.
void rewrite_terminal_line(std::string_view text) noexcept;

/// Removes that line and the ^C that a terminal may have put behind it. A signal handler may call it.
void clear_terminal_line() noexcept;

/// Columns of the terminal that standard error is; 0 if it is none, or one that cannot rewrite a line.
[[nodiscard]] int diagnostics_terminal_width();

}  // namespace coordreq
