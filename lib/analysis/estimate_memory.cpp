#include "analysis/estimate_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "answers/plan.hpp"
#include "base/grouped.hpp"
#include "base/timer.hpp"
#include "results/write_results.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

double estimate_memory(const Model& model, int threads) {
  return std::max(static_cast<double>(peak_memory_bytes()),
                  estimate_memory_of_rank(model, threads, memory_of_program(), {}));
}

double estimate_memory_of_rank(const Model& model, int threads, double before,
                               const RowFractions& fractions) {
  const int team = all_threads(threads);
  const EngineSizes sizes(model, fractions);
  double held = before + memory_of_threads(team);
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
  check_memory_need(fmt::format("{} cells need", grouped(spec.cells())), needed, limit, by_whom);
}

int threads_within(const Model& model, std::optional<std::uint64_t> limit, int threads, bool saves) {
  int most = all_threads(threads);
  if (!limit) return most;
  const auto most_bytes = static_cast<double>(*limit);
  const auto need = [&](int team) { return estimate_memory(model, team) + (saves ? kCheckpointBytes : 0); };
  if (need(most) <= most_bytes) return most;
  check_memory_limit(model.spec(), need(1), most_bytes, "");
  int least = 1;
  while (least < most) {
    const int middle = (least + most + 1) / 2;
    if (need(middle) <= most_bytes) {
      least = middle;
    } else {
      most = middle - 1;
    }
  }
  return least;
}

}  // namespace coordreq
