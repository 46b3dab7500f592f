#include "results/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace coordreq {
namespace {

/// Over a network only what can be written can be locked.
int open_any(const std::string& path) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  return file >= 0 || errno == ENOENT ? file : open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

/// Meanwhile the file can have been replaced by another of the same name.
bool has_name(int file, const std::string& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::take(const std::string& path, const std::string& what) {
  for (;;) {
    const int file = open_any(path);
    if (file < 0 && errno == ENOENT) return std::nullopt;
    if (file < 0) throw IoError(fmt::format("cannot open {}: {}", what, std::strerror(errno)), path);
    FileLock lock(file);
    if (flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw IoError(fmt::format("{} is in use, expected one run at a time to use it", what), path);
    if (has_name(file, path)) return lock;
  }
}

FileLock::~FileLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace coordreq
