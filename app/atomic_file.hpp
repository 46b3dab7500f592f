#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "app/interrupt.hpp"
#include "results/output_file.hpp"

namespace coordreq {

/// A file that appears whole or not at all. It begins with its first text: the work before that may take
/// long, and an interrupt then ends the program at once. Later a signal waits for the next text, so that
/// nothing is left behind.
class AtomicFile {
 public:
  /// @param what is written, for messages: "the export"
  /// @throws IoError as check_writable()
  AtomicFile(std::string path, std::string what);

  /// @throws IoError if that fails; Error if the program was interrupted
  void write(std::string_view text);
  /// @pre write() was called. @throws IoError
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  std::string what_;
  std::optional<InterruptDelay> delay_;
  std::optional<OutputFile> file_;
  std::ofstream stream_;
};

}  // namespace coordreq
