#include "answers/network/network_meaning.hpp"

#include <fmt/format.h>

#include "base/grouped.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::string probability_text(const ProbabilityRange& range) {
  if (range.low == range.high) return to_text(range.low);
  return fmt::format("{} to {}", to_text(range.low), to_text(range.high));
}

}  // namespace

std::string network_meaning(const NetworkSpec& network) {
  switch (network.kind) {
    case NetworkKind::delay:
      return fmt::format("connected after {}", count_of(network.delay, "step"));
    case NetworkKind::burst:
      return fmt::format("at most {} lost in a row, at least {} connected between",
                         count_of(network.burst_length, "step"), grouped(network.burst_gap));
    case NetworkKind::weakly_hard:
      return fmt::format("at most {} of any {} lost", grouped(network.misses),
                         count_of(network.window, "step"));
    case NetworkKind::loss:
      return fmt::format("a step is lost with probability {}, {} after a lost one",
                         probability_text(network.loss), probability_text(network.after_loss));
    case NetworkKind::automaton:
      break;
  }
  return count_of(static_cast<std::int64_t>(network.modes.size()), "mode") + " with given transitions";
}

}  // namespace coordreq
