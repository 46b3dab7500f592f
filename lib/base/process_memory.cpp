#include "base/process_memory.hpp"

#include <sys/resource.h>
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "base/error.hpp"
#include "base/sanitizers.hpp"
#include "base/timer.hpp"

namespace coordreq {
namespace {

/// Parts of the program and its libraries come into memory only when they are used: of their code any work
/// needs about so much of the whole, and they keep something for themselves. Measured.
constexpr double kUsedCode = 0.72, kProgramBytes = 1.5 * 1024 * 1024;
/// Memory of a thread: the used fraction of its stack, and the reserve of the allocator.
constexpr double kThreadBytes = 108.0 * 1024;

std::optional<rlimit> limit_of_data() {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return std::nullopt;
  return limit;
}

void set_limit_of_data(rlim_t wanted) {
  std::optional<rlimit> limit = limit_of_data();
  if (!limit) return;
  limit->rlim_cur = std::min(limit->rlim_max, wanted);
  static_cast<void>(setrlimit(RLIMIT_DATA, &*limit));
}

/// The pages of files that are in memory, or will be.
double bytes_of_files() {
  const auto code = static_cast<double>(status_bytes("VmExe") + status_bytes("VmLib"));
  return std::max(static_cast<double>(status_bytes("RssFile")), kUsedCode * code);
}

/// Data that is not in memory: it counts for the limit whether or not it is.
std::int64_t untouched_bytes() {
  return static_cast<std::int64_t>(status_bytes("VmData")) -
         static_cast<std::int64_t>(status_bytes("RssAnon"));
}

}  // namespace

void share_heaps() {
#if defined(__GLIBC__)
  constexpr int kHeaps = 4;
  mallopt(M_ARENA_MAX, kHeaps);
#endif
}

void give_back_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

double memory_of_program() {
  return static_cast<double>(status_bytes("RssAnon")) + bytes_of_files() + kProgramBytes;
}

int all_threads(int threads) {
  return threads > 0 ? threads : usable_processors();
}

double memory_of_threads(int threads) {
  return (all_threads(threads) - 1) * kThreadBytes;
}

std::string byte_text(double bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  while (bytes >= 1024 && unit + 1 < std::size(units)) {
    bytes /= 1024;
    ++unit;
  }
  char text[64];
  static_cast<void>(std::snprintf(text, sizeof(text), "%.1f %s", bytes, units[unit]));
  return text;
}

void check_memory_need(const std::string& subject, double needed, double limit, const std::string& by_whom) {
  if (needed <= limit) return;
  throw LimitError(
      subject + " about " + byte_text(needed) + " of memory, " + by_whom + "the limit is " + byte_text(limit),
      "--max-memory");
}

void expect_memory(const std::string& subject, double more, std::optional<std::uint64_t> limit) {
  if (limit) check_memory_need(subject, memory_of_program() + more, static_cast<double>(*limit));
}

int threads_within(const std::string& subject, const MemoryDemand& demand, int threads,
                   std::optional<std::uint64_t> limit) {
  const int all = all_threads(threads);
  if (!limit) return all;
  const double one = demand.once + demand.of_thread;
  expect_memory(subject, one, limit);
  const double left = static_cast<double>(*limit) - memory_of_program() - one;
  return 1 + static_cast<int>(std::min<double>(all - 1, left / (kThreadBytes + demand.of_thread)));
}

void hold_to_memory(std::uint64_t bytes) {
  if (kIsSanitized) return;
  constexpr std::int64_t kAlwaysGranted = std::int64_t{3} << 20U;
  const auto data = static_cast<std::int64_t>(status_bytes("VmData"));
  if (data == 0) return;
  const auto accepted = static_cast<std::int64_t>(std::min(bytes, std::uint64_t{1} << 62U));
  // Files in memory are no data.
  const std::int64_t wanted =
      accepted + accepted / 10 - static_cast<std::int64_t>(bytes_of_files()) + untouched_bytes();
  set_limit_of_data(static_cast<rlim_t>(std::max(wanted, data + kAlwaysGranted)));
}

bool is_held_to_memory() {
  const std::optional<rlimit> limit = limit_of_data();
  return limit && limit->rlim_cur != RLIM_INFINITY;
}

LimitMove::LimitMove() {
  const std::optional<rlimit> limit = limit_of_data();
  if (kIsSanitized || !limit || limit->rlim_cur == limit->rlim_max) return;
  limit_ = limit->rlim_cur;
  set_limit_of_data(limit->rlim_max);  // first: what follows takes memory, too
  untouched_ = untouched_bytes();
}

LimitMove::~LimitMove() {
  if (!limit_) return;
  const std::int64_t moved = static_cast<std::int64_t>(*limit_) + untouched_bytes() - untouched_;
  set_limit_of_data(static_cast<rlim_t>(std::max<std::int64_t>(moved, 0)));
}

}  // namespace coordreq
