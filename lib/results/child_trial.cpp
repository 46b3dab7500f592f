#include "results/child_trial.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <optional>

#include "base/error.hpp"
#include "base/sanitizers.hpp"

namespace coordreq {
namespace {

constexpr char kDone = '+';
/// A damaged list can be endless, and a name in a file can lead to a pipe.
constexpr auto kMostTime = std::chrono::seconds(kIsSanitized ? 20 : 5);
/// What the library may take more than this process has already, damaged as a file may be.
constexpr rlim_t kMostBytes = rlim_t{1} << 30U;

void send(int pipe, const std::string& text) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t count = write(pipe, text.data() + sent, text.size() - sent);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

/// What comes until the other end closes; nothing if that takes too long.
std::optional<std::string> receive(int pipe) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + kMostTime;
  std::string text;
  std::array<char, 4096> block{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    pollfd wanted{pipe, POLLIN, 0};
    const int ready = poll(&wanted, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return std::nullopt;
    const ssize_t count = ::read(pipe, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
}

/// Address space of this process.
rlim_t present_bytes() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  file >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void limit_memory() {
  const rlim_t most = present_bytes() + kMostBytes;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  static_cast<void>(setrlimit(RLIMIT_AS, &limit));
}

/// The child leaves no traces: no message of a signal handler, no report of a sanitizer, no core.
void silence() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) {
    static_cast<void>(std::signal(number, SIG_DFL));
  }
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (null >= 0) {
    static_cast<void>(dup2(null, STDOUT_FILENO));
    static_cast<void>(dup2(null, STDERR_FILENO));
  }
  const rlimit no_core{0, 0};
  static_cast<void>(setrlimit(RLIMIT_CORE, &no_core));
  limit_memory();
}

/// What the parent has to know: kDone, or the exit code and text of an Error.
std::string outcome_of(const std::function<void()>& read) {
  try {
    read();
    return {kDone};
  } catch (const Error& error) {
    return static_cast<char>(error.exit_code()) + std::string(error.what());
  } catch (const std::bad_alloc&) {
    return {static_cast<char>(ExitCode::limit)};
  } catch (const std::exception&) {
    return {};
  }
}

[[noreturn]] void rethrow(const std::string& outcome, const std::string& path) {
  if (outcome.empty()) throw ResultsError("damaged results file: the HDF5 library cannot read it", path);
  const auto code = static_cast<ExitCode>(outcome.front());
  const std::string text = outcome.substr(1);
  if (code == ExitCode::limit && text.empty()) throw std::bad_alloc();
  if (code == ExitCode::invalid_input) throw ResultsError(text);
  if (code == ExitCode::input_output) throw IoError(text);
  throw Error(code, text, "");
}

}  // namespace

void try_in_child(const std::string& path, const std::function<void()>& read) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    silence();
    send(ends[1], outcome_of(read));
    _exit(0);
  }
  close(ends[1]);
  const std::optional<std::string> outcome = child > 0 ? receive(ends[0]) : std::string{kDone};
  close(ends[0]);
  if (!outcome) kill(child, SIGKILL);
  int status = 0;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!outcome) throw ResultsError("damaged results file (takes too long to read)", path);
  if (*outcome != std::string{kDone}) rethrow(*outcome, path);
}

}  // namespace coordreq
