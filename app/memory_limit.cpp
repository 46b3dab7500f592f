#include "app/memory_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "base/sanitizers.hpp"
#include "base/timer.hpp"

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

void hold_to_memory(std::uint64_t bytes, int threads) {
  if (kIsSanitized) return;
  constexpr std::uint64_t kAlwaysGranted = std::uint64_t{16} << 20U;
  const std::uint64_t data = status_bytes("VmData");
  if (data == 0) return;
  // Data counts whether or not it is in memory yet; parts of the program and its libraries do not count.
  const std::uint64_t untouched = data - std::min(data, status_bytes("RssAnon"));
  const std::uint64_t program = std::min(bytes, status_bytes("RssFile"));
  rlimit stack{};
  if (getrlimit(RLIMIT_STACK, &stack) != 0) return;
  constexpr std::uint64_t kUsualStack = std::uint64_t{8} << 20U;
  constexpr std::uint64_t kArena = std::uint64_t{256} << 10U;  // what the allocator sets aside for a thread
  const std::uint64_t of_thread = (stack.rlim_cur == RLIM_INFINITY ? kUsualStack : stack.rlim_cur) + kArena;
  const auto all = threads > 0 ? static_cast<unsigned>(threads) : std::thread::hardware_concurrency();
  const std::uint64_t stacks =
      std::uint64_t{std::max(all, 1U) - 1} * of_thread;  // the first one does not count
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const std::uint64_t counted = std::min(bytes, std::uint64_t{1} << 62U);
  const std::uint64_t accepted = counted + counted / 10;  // estimates are no closer
  const rlim_t wanted = std::max(accepted - program + untouched, data + kAlwaysGranted) + stacks;
  limit.rlim_cur = std::min(limit.rlim_max, wanted);
  static_cast<void>(setrlimit(RLIMIT_DATA, &limit));
}

bool is_held_to_memory() {
  rlimit limit{};
  return getrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

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
