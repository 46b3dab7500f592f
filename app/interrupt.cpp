#include "app/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "app/standard_streams.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

// A signal handler can reach nothing but globals; these are seen in this file only.
std::atomic<bool> is_delayed = false;
std::atomic<bool> is_pending = false;
std::atomic<bool> is_on_terminal = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not take a lock");

void handle(int) {
  if (is_delayed && !is_pending.exchange(true)) return;
  if (is_on_terminal) clear_terminal_line();
  write_diagnostics("coordreq: error: interrupted\n");
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

void install_interrupt_handlers() {
  is_on_terminal = ::isatty(STDERR_FILENO) != 0;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction before {};
    const bool ignored = ::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
    if (!ignored) static_cast<void>(::sigaction(signal, &action, nullptr));
  }
}

InterruptDelay::InterruptDelay() {
  is_delayed = true;
}

InterruptDelay::~InterruptDelay() {
  is_delayed = false;
}

bool is_interrupted() {
  return is_pending;
}

}  // namespace coordreq
