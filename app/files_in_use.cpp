#include "app/files_in_use.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "app/text.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as the Linux kernel follows

std::string identity_of(const struct stat& file) {
  return fmt::format("{}:{}", file.st_dev, file.st_ino);
}

/// Where a link that leads to nothing leads.
fs::path end_of_links(fs::path path) {
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code error;
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

/// Empty for what is not there and cannot be made.
std::string identity_of(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) == 0) return identity_of(file);
  const fs::path target = end_of_links(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (::stat(folder.c_str(), &file) != 0) return {};
  return identity_of(file) + "/" + target.filename().string();
}

/// Only of a file that has been put there: terminals and pipes keep what is read from them.
std::string identity_of_standard_input() {
  struct stat file {};
  if (::fstat(STDIN_FILENO, &file) != 0 || !S_ISREG(file.st_mode)) return {};
  return identity_of(file);
}

}  // namespace

void FilesInUse::reads(const std::string& path, const std::string& what) {
  const std::string identity = path == "-" ? identity_of_standard_input() : identity_of(path);
  if (!identity.empty()) uses_.emplace(identity, what);
}

void FilesInUse::writes(const std::string& path, const std::string& what, const std::string& option) {
  const std::string identity = identity_of(path);
  if (identity.empty()) return;  // it cannot be made, as whoever writes it will say
  const auto [use, is_new] = uses_.emplace(identity, what);
  if (!is_new)
    throw UsageError(fmt::format("expected another file than {}, found {}", use->second, echoed(path)),
                     option);
}

void check_output(const std::string& results, const std::string& output, const std::string& what) {
  FilesInUse files;
  files.reads(results, "the results");
  files.writes(output, what, "--output");
}

}  // namespace coordreq
