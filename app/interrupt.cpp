#include "app/interrupt.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "analysis/checkpoint_segments.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

// A signal handler can reach nothing but globals; these are seen in this file only.
std::atomic<bool> is_delayed = false;
std::atomic<bool> is_pending = false;
std::atomic<bool> is_on_terminal = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not take a lock");

/// What an interrupt says of a checkpoint; made beforehand, since a signal handler can make no text.
struct NotedCheckpoint {
  std::string file;   ///< that is there once something is saved
  std::string saved;  ///< what to do then,
  std::string not_saved;
};
std::atomic<const NotedCheckpoint*> noted_checkpoint = nullptr;

std::string_view how_to_continue() {
  const NotedCheckpoint* const checkpoint = noted_checkpoint;
  if (checkpoint == nullptr) return {};
  return ::access(checkpoint->file.c_str(), F_OK) == 0 ? checkpoint->saved : checkpoint->not_saved;
}

void handle(int) {
  if (is_delayed && !is_pending.exchange(true)) return;
  if (is_on_terminal) clear_terminal_line();
  write_diagnostics("coordreq: error: interrupted");
  write_diagnostics(how_to_continue());
  write_diagnostics("\n");
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

void note_checkpoint(const std::string& file, bool is_folder) {
  static NotedCheckpoint checkpoint;
  checkpoint.file = is_folder ? CheckpointSegments::manifest(file) : file;
  checkpoint.saved = fmt::format("; --resume continues from the checkpoint ({})", printable(file));
  checkpoint.not_saved =
      fmt::format("; no checkpoint had been saved, see --checkpoint-every ({})", printable(file));
  noted_checkpoint = &checkpoint;
}

Error interruption() {
  return {ExitCode::interrupted, "interrupted" + std::string(how_to_continue()), ""};
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
