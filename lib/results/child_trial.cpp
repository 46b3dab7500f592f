#include "results/child_trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include "base/error.hpp"
#include "base/process_memory.hpp"

namespace coordreq {
namespace {

constexpr char kDone = '+';
/// Processor time: a damaged list can be endless. Reading what is not damaged takes some hundredths of it.
constexpr rlim_t kLeastSeconds = 5;
constexpr rlim_t kBytesASecond = rlim_t{1} << 20U;
/// Memory that the library may take beyond that of this process, however damaged a file is.
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

/// The text that comes until the other end closes.
std::string receive(int pipe) {
  std::string text;
  std::array<char, 4096> block{};
  for (;;) {
    const ssize_t count = ::read(pipe, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
}

/// In proportion to the file.
rlim_t seconds_for(const std::string& path) {
  struct stat info {};
  const rlim_t bytes = stat(path.c_str(), &info) == 0 ? static_cast<rlim_t>(info.st_size) : 0;
  return kLeastSeconds + bytes / kBytesASecond;
}

/// A limit that was there before and is lower stays.
void limit(decltype(RLIMIT_CPU) what, rlim_t most) {
  rlimit bound{};
  if (getrlimit(what, &bound) != 0 || bound.rlim_cur <= most) return;
  bound.rlim_cur = most;
  static_cast<void>(setrlimit(what, &bound));
}

/// Address space of this process.
rlim_t present_bytes() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  file >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// From now on the child can have one more file open at a time, the one that it reads. A name in that file
/// that leads to another one leads nowhere: opening a pipe would wait indefinitely.
void limit_files(int pipe) {
  const int lowest = dup(pipe);  // of the descriptors that are free
  if (lowest < 0) return;        // none is
  close(lowest);
  limit(RLIMIT_NOFILE, static_cast<rlim_t>(lowest) + 1);
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
  limit(RLIMIT_AS, present_bytes() + kMostBytes);
}

/// Less than a child would be given without another limit.
bool is_short_of_memory() {
  rlimit bound{};
  return is_held_to_memory() ||
         (getrlimit(RLIMIT_AS, &bound) == 0 && bound.rlim_cur < present_bytes() + kMostBytes);
}

/// The message for the parent: kDone, or the exit code and text of an Error.
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

/// @param signal that ended the child before it could say anything, 0 if none did
[[noreturn]] void fail_without_outcome(int signal, const std::string& path) {
  if (signal == SIGKILL) throw std::bad_alloc();  // so the system ends who takes too much
  if (signal != SIGXCPU) {
    if (is_short_of_memory())
      throw std::bad_alloc();  // the library fails in many ways where it is given none
    throw ResultsError("damaged results file: the HDF5 library cannot read it", path);
  }
  rlimit bound{};
  if (getrlimit(RLIMIT_CPU, &bound) == 0 && bound.rlim_cur < seconds_for(path))
    throw LimitError("reading takes more time of the processor than a process may have here", path);
  throw ResultsError("damaged results file (takes too long to read)", path);
}

[[noreturn]] void rethrow(const std::string& outcome, int status, const std::string& path) {
  if (outcome.empty()) fail_without_outcome(WIFSIGNALED(status) ? WTERMSIG(status) : 0, path);
  const auto code = static_cast<ExitCode>(outcome.front());
  const std::string text = outcome.substr(1);
  if (code == ExitCode::limit && text.empty()) throw std::bad_alloc();
  if (code == ExitCode::invalid_input) throw ResultsError(text);
  if (code == ExitCode::input_output) throw IoError(text);
  throw Error(code, text, "");
}

[[noreturn]] void fail_to_try(const std::string& path) {
  if (errno == ENOMEM) throw std::bad_alloc();
  throw IoError(fmt::format("cannot be tried in a process of its own, as a damaged file must be: {}",
                            std::strerror(errno)),
                path);
}

}  // namespace

void try_in_child(const std::string& path, const std::function<void()>& read) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_try(path);
  const pid_t child = fork();
  if (child == 0) {
    silence();
    limit(RLIMIT_CPU, seconds_for(path));
    limit_files(ends[1]);
    send(ends[1], outcome_of(read));
    _exit(0);
  }
  const int error = errno;
  close(ends[1]);
  const std::string outcome = child > 0 ? receive(ends[0]) : "";
  close(ends[0]);
  errno = error;
  if (child < 0) fail_to_try(path);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (outcome != std::string{kDone}) rethrow(outcome, status, path);
}

}  // namespace coordreq
