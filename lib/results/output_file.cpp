#include "results/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace coordreq {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as the Linux kernel follows
constexpr int kMostAttempts = 10000;

std::string because(const std::string& what, int error) {
  return what + ": " + std::strerror(error);
}

/// Where a chain of symbolic links ends, whether or not something is there.
fs::path resolve_links(const std::string& path, const std::string& what) {
  fs::path result = path;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(result, error))) return result;
    const fs::path next = fs::read_symlink(result, error);
    if (error) return result;
    result = result.parent_path() / next;
  }
  throw IoError("cannot write " + what + ": too many symbolic links", path);
}

void check_folder(const fs::path& folder) {
  struct stat info {};
  if (stat(folder.c_str(), &info) != 0) {
    if (errno == ENOENT) throw IoError("the folder does not exist", folder.string());
    throw IoError(because("cannot use the folder", errno), folder.string());
  }
  if (!S_ISDIR(info.st_mode)) throw IoError("not a folder", folder.string());
}

/// Permission bits of the file that would be replaced, if there is one.
/// @param target where the links of `path` end
std::optional<mode_t> check_target(const std::string& target, const std::string& path,
                                   const std::string& what) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) {
    if (errno == ENOENT) return std::nullopt;
    throw IoError(because("cannot write " + what, errno), path);
  }
  if (S_ISDIR(info.st_mode)) throw IoError("cannot write " + what + ": this is a folder", path);
  if (!S_ISREG(info.st_mode)) {
    throw IoError("cannot write " + what + ": this is a device, a pipe or a socket, not a regular file",
                  path);
  }
  // Links of /proc, as /dev/stdout, lead to open files whatever they say: one that has been deleted has no
  // name.
  struct stat named {};
  if (stat(target.c_str(), &named) != 0 || named.st_dev != info.st_dev || named.st_ino != info.st_ino)
    throw IoError("cannot write " + what + ": this file has no name any more", path);
  if (access(target.c_str(), W_OK) != 0) {
    throw IoError(because("cannot replace " + what, errno), path);
  }
  return info.st_mode & 07777U;
}

constexpr std::string_view kTemporary = ".tmp";

/// The machine and the namespace to which numbers of processes belong; nothing if it is not known.
std::optional<std::string> process_space() {
  std::array<char, HOST_NAME_MAX + 1> host{};
  struct stat space {};
  if (gethostname(host.data(), host.size() - 1) != 0 || stat("/proc/self/ns/pid", &space) != 0) return {};
  return std::string(host.data()) + "-" + std::to_string(space.st_ino);
}

/// Whether `name` is `beginning`, the number of a process that is no more, another number, and `end`.
bool is_leftover(std::string_view name, std::string_view beginning, std::string_view end) {
  if (name.size() <= beginning.size() + end.size() || !name.starts_with(beginning) || !name.ends_with(end))
    return false;
  name.remove_prefix(beginning.size());
  name.remove_suffix(end.size());
  const std::string numbers(name);
  int process = 0, attempt = 0, length = 0;
  if (std::sscanf(numbers.c_str(), "%d-%d%n", &process, &attempt, &length) != 2) return false;
  return static_cast<std::size_t>(length) == numbers.size() && process > 0 && kill(process, 0) != 0 &&
         errno == ESRCH;
}

/// Removes files of a folder that processes that were killed have left.
void remove_leftover(const fs::path& folder, const std::string& beginning, std::string_view end) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), last; !error && it != last; it.increment(error)) {
    std::error_code ignored;
    if (is_leftover(it->path().filename().string(), beginning, end) && it->is_regular_file(ignored))
      static_cast<void>(fs::remove(it->path(), ignored));
  }
}

/// A new file in `folder` under a name that no other process has. Its name does not depend on the target's,
/// which may already be as long as names can be.
std::string create_temporary(const fs::path& folder, std::optional<mode_t> mode) {
  const std::optional<std::string> space = process_space();
  const std::string beginning = ".coordreq-" + space.value_or("unknown") + "-";
  if (space) remove_leftover(folder, beginning, kTemporary);
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::string name =
        beginning + std::to_string(getpid()) + "-" + std::to_string(attempt) + std::string(kTemporary);
    const std::string path = (folder / name).string();
    const int file = open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file < 0 && errno == EEXIST) continue;
    if (file < 0) throw IoError(because("cannot create a file in the folder", errno), folder.string());
    if (mode) static_cast<void>(fchmod(file, *mode));  // some file systems have no such bits
    close(file);
    return path;
  }
  throw IoError("cannot create a file in the folder: too many temporary files", folder.string());
}

/// Creates a file beside the target, under a name that says whose it is: see remove_unfinished().
std::string create_beside(const std::string& target, const std::string& suffix, std::optional<mode_t> mode,
                          const std::string& what) {
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::string path = target + "." + std::to_string(getpid()) + "-" + std::to_string(attempt) + suffix;
    const int file = open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file < 0 && errno == EEXIST) continue;
    if (file < 0) throw IoError(because("cannot write " + what, errno), target);
    if (mode) static_cast<void>(fchmod(file, *mode));
    close(file);
    return path;
  }
  throw IoError("cannot create a file in the folder: too many temporary files", target);
}

/// @param flags of open()
void sync(const std::string& path, int flags, const std::string& where, const std::string& what) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  const bool failed = file < 0 || fsync(file) != 0;
  const int error = errno;
  if (file >= 0) close(file);
  if (failed) throw IoError(because("cannot bring " + what + " to the disk", error), where);
}

}  // namespace

OutputFile::OutputFile(const std::string& path, std::string what, const std::string& suffix)
    : what_(std::move(what)) {
  if (path.empty()) throw IoError("cannot write " + what_ + ": the path is empty");
  const fs::path target = resolve_links(path, what_);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  check_folder(folder);
  if (!target.has_filename()) throw IoError("cannot write " + what_ + ": this is a folder", path);
  target_ = target.string();
  folder_ = folder.string();
  const std::optional<mode_t> mode = check_target(target_, path, what_);
  temporary_ = suffix.empty() ? create_temporary(folder, mode) : create_beside(target_, suffix, mode, what_);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::commit() {
  sync(temporary_, O_RDONLY, target_, what_);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) {
    throw IoError(because("cannot write " + what_, errno), target_);
  }
  temporary_.clear();
  sync(folder_, O_RDONLY | O_DIRECTORY, target_, what_);
}

bool OutputFile::commit_new() {
  sync(temporary_, O_RDONLY, target_, what_);
  if (::link(temporary_.c_str(), target_.c_str()) == 0) {
    sync(folder_, O_RDONLY | O_DIRECTORY, target_, what_);
    return true;  // the temporary name goes with this object
  }
  if (errno == EEXIST) return false;
  commit();  // where a file cannot have two names
  return true;
}

void remove_unfinished(const std::string& path, const std::string& suffix) {
  const fs::path target = resolve_links(path, "the file");
  remove_leftover(target.has_parent_path() ? target.parent_path() : fs::path("."),
                  target.filename().string() + ".", suffix);
}

}  // namespace coordreq
