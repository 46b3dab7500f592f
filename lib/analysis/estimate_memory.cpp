#include "analysis/estimate_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <thread>

#include "answers/plan.hpp"
#include "base/error.hpp"
#include "base/grouped.hpp"
#include "base/timer.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Parts of the program and its libraries that come into memory only when they are used.
constexpr double kProgramBytes = 8.5 * 1024 * 1024;
/// What a thread takes before it does anything: the part of its stack that is touched, and what the allocator
/// keeps for it.
constexpr double kThreadBytes = 108.0 * 1024;

std::string in_words(double bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  while (bytes >= 1024 && unit + 1 < std::size(units)) {
    bytes /= 1024;
    ++unit;
  }
  return fmt::format("{:.1f} {}", bytes, units[unit]);
}

}  // namespace

double memory_of_program() {
  return static_cast<double>(resident_bytes()) + kProgramBytes;
}

double estimate_memory(const Model& model, int threads) {
  return std::max(static_cast<double>(peak_memory_bytes()),
                  estimate_memory_of_rank(model, threads, memory_of_program(), {}));
}

double estimate_memory_of_rank(const Model& model, int threads, double before, const RowPart& part) {
  const int team = threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const EngineSizes sizes(model, part);
  double held = before + (team - 1) * kThreadBytes;
  double most = 0, written = 0, longest = 0;
  const auto add = [&](const MemoryNeed& need) {
    most = std::max(most, held + need.kept + need.work);
    held += need.kept;
    written += need.written;
    longest = std::max(longest, need.array);
  };
  for (const Answer& answer : all_answers()) add(answer.memory(sizes, team));
  return std::max(most, held + written + write_results_bytes(model.spec(), longest, team));
}

void check_memory_limit(const ProblemSpec& spec, double needed, double limit, const std::string& by_whom) {
  if (needed <= limit) return;
  std::int64_t cells = 1;
  for (const StateSpec& state : spec.states) cells *= state.grid.count;
  throw LimitError(fmt::format("{} cells need about {} of memory, {}the limit is {}", grouped(cells),
                               in_words(needed), by_whom, in_words(limit)),
                   "--max-memory");
}

void check_memory(const Model& model, std::optional<std::uint64_t> limit, int threads, bool saves) {
  if (!limit) return;
  check_memory_limit(model.spec(), estimate_memory(model, threads) + (saves ? kCheckpointBytes : 0),
                     static_cast<double>(*limit), "");
}

}  // namespace coordreq
