#pragma once

#include <optional>
#include <string>
#include <utility>

namespace coordreq {

/// Keeps a file for one process, as long as this object lives: by flock(), so that it ends with the process
/// however that ends. Processes that do not ask for it are not kept away. Where the file system has no locks
/// it is granted to everybody.
class FileLock {
 public:
  /// @param what the file is, for messages
  /// @returns nothing if there is no such file
  /// @throws IoError if another process has it, or the file cannot be opened
  [[nodiscard]] static std::optional<FileLock> take(const std::string& path, const std::string& what);
  ~FileLock();
  FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }

 private:
  explicit FileLock(int file) : file_(file) {}

  int file_;
};

}  // namespace coordreq
