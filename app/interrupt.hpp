#pragma once

#include <string>

#include "base/error.hpp"

namespace coordreq {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGXCPU end the program at once with exit code 130 and one line on
/// standard error, except while an InterruptDelay lives. A signal that the caller had set to be ignored stays
/// ignored.
void install_interrupt_handlers();

/// From now on what is said of an interrupt says how to go on. @param file of --checkpoint
/// @param is_folder several processes have a folder, whose manifest comes last
void note_checkpoint(const std::string& file, bool is_folder);

/// The error of a signal that was kept waiting.
[[nodiscard]] Error interruption();

/// Keeps a first signal waiting while there are temporary files that the program would leave behind; a second
/// one ends it all the same. At most one at a time.
class InterruptDelay {
 public:
  InterruptDelay();
  ~InterruptDelay();
  InterruptDelay(const InterruptDelay&) = delete;
  InterruptDelay& operator=(const InterruptDelay&) = delete;
};

/// True if a signal is or was kept waiting. May be called from any thread.
[[nodiscard]] bool is_interrupted();

}  // namespace coordreq
