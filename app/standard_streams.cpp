#include "app/standard_streams.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ios>
#include <string>
#include <system_error>

#include "base/error.hpp"

namespace coordreq {
namespace {

/// @returns 0, or the error number of the write that failed
int write_all(int descriptor, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

bool pipe_signal_was_ignored = false;

std::atomic<bool> is_output_begun = false;

// A signal handler clears the line.
std::atomic<std::size_t> line_length = 0;
static_assert(std::atomic<std::size_t>::is_always_lock_free, "a signal handler must not take a lock");

void write_blanks(std::size_t count) noexcept {
  constexpr std::string_view kBlanks = "                                                                ";
  for (; count > 0; count -= std::min(count, kBlanks.size()))
    static_cast<void>(write_all(STDERR_FILENO, kBlanks.substr(0, std::min(count, kBlanks.size()))));
}

}  // namespace

void hold_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // Standard output is held for reading only: writing to it stays the error that it was.
    const int flags = descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY;
    if (::open("/dev/null", flags) != descriptor) throw IoError("cannot be opened", "/dev/null");
  }
  pipe_signal_was_ignored = std::signal(SIGPIPE, SIG_IGN) == SIG_IGN;
  static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
  std::ios::sync_with_stdio(false);
}

void end_by_closed_pipe() noexcept {
  static_cast<void>(std::signal(SIGPIPE, SIG_DFL));
  static_cast<void>(std::raise(SIGPIPE));
  ::_exit(static_cast<int>(ExitCode::input_output));  // where the signal is blocked
}

bool has_output() noexcept {
  return is_output_begun;
}

void write_output(std::string_view text) {
  is_output_begun = true;
  const int error = write_all(STDOUT_FILENO, text);
  if (error == 0) return;
  if (error == EPIPE && !pipe_signal_was_ignored) throw ClosedPipe();
  throw IoError("cannot write the result: " + std::generic_category().message(error), "standard output");
}

void write_diagnostics(std::string_view text) noexcept {
  static_cast<void>(write_all(STDERR_FILENO, text));
}

void rewrite_terminal_line(std::string_view text) noexcept {
  const std::size_t before = line_length;
  if (text.empty() && before == 0) return;
  line_length = std::max(before, text.size());
  write_diagnostics("\r");
  write_diagnostics(text);
  write_blanks(before > text.size() ? before - text.size() : 0);
  if (text.empty()) write_diagnostics("\r");
  line_length = text.size();
}

void clear_terminal_line() noexcept {
  write_diagnostics("\r");
  write_blanks(line_length + 2);
  write_diagnostics("\r");
  line_length = 0;
}

int diagnostics_terminal_width() {
  if (::isatty(STDERR_FILENO) == 0) return 0;
  const char* terminal = std::getenv("TERM");
  if (terminal == nullptr || std::string_view(terminal) == "dumb") return 0;
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

}  // namespace coordreq
