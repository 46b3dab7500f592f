#include "app/option_values.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace coordreq {
namespace {

namespace fs = std::filesystem;

std::optional<std::uint64_t> physical_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page_size = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_size <= 0) return std::nullopt;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
}

/// The number in a limit file; nothing if there is no file or it says "max".
std::optional<std::uint64_t> read_limit(const fs::path& file) {
  std::ifstream stream(file);
  std::uint64_t limit = 0;
  if (stream >> limit) return limit;
  return std::nullopt;
}

void lower(std::optional<std::uint64_t>& limit, std::optional<std::uint64_t> other) {
  if (other) limit = limit ? std::min(*limit, *other) : *other;
}

/// Lowers `limit` to that of the group and of every group around it.
void lower_by_groups(std::optional<std::uint64_t>& limit, const fs::path& mount, const std::string& group,
                     const char* file) {
  for (fs::path path = fs::path(group).relative_path();; path = path.parent_path()) {
    lower(limit, read_limit(mount / path / file));
    if (path.empty()) return;
  }
}

}  // namespace

std::optional<std::uint64_t> available_memory() {
  std::optional<std::uint64_t> limit = physical_memory();
  std::ifstream groups("/proc/self/cgroup");  // lines "ID:CONTROLLERS:PATH"; version 2 names no controllers
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) lower_by_groups(limit, "/sys/fs/cgroup", group, "memory.max");
    if (controllers == "memory") {
      lower_by_groups(limit, "/sys/fs/cgroup/memory", group, "memory.limit_in_bytes");
    }
  }
  return limit;
}

}  // namespace coordreq
