#include "base/timer.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace coordreq {

void StageTimer::begin(std::string name) {
  end();
  const auto found =
      std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& s) { return s.first == name; });
  current_ = static_cast<std::size_t>(found - seconds_.begin());
  if (found == seconds_.end()) seconds_.emplace_back(std::move(name), 0.0);
  started_ = Clock::now();
  running_ = true;
}

void StageTimer::end() {
  if (running_) seconds_[current_].second += std::chrono::duration<double>(Clock::now() - started_).count();
  running_ = false;
}

void reset_peak_memory() {
  malloc_trim(0);
  // proc(5): 5 resets the peak resident set size.
  std::ofstream("/proc/self/clear_refs") << 5;
}

std::uint64_t resident_bytes() {
  std::uint64_t pages = 0;  // the second number
  std::ifstream("/proc/self/statm") >> pages >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string field; status >> field;) {
    std::uint64_t kib = 0;
    if (field == key + ":" && status >> kib) return kib * 1024;
  }
  return 0;
}

std::uint64_t peak_memory_bytes() {
  // Not getrusage(): that counts what stood in this process before the program was started in it.
  return status_bytes("VmHWM");
}

}  // namespace coordreq
