#include "spec/loss_automaton.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Losses that matter, as their distances from the next step, ascending: 1 is the present step.
using Losses = std::vector<std::int32_t>;

/// Names of modes, with as many letters as the oldest loss of all modes needs, at least one.
std::vector<std::string> names_of(const std::vector<const Losses*>& modes) {
  std::int64_t letters = 1;
  for (const Losses* losses : modes)
    letters = std::max(letters, losses->empty() ? 1 : std::int64_t{losses->back()});
  std::vector<std::string> names;
  for (const Losses* losses : modes) {
    std::string& name = names.emplace_back(static_cast<std::size_t>(letters), '1');
    for (const std::int32_t distance : *losses) name[static_cast<std::size_t>(letters - distance)] = '0';
  }
  return names;
}

/// All that can be reached from a past without losses, in descending order of the names.
LossAutomaton unfold(const std::function<std::vector<Losses>(const Losses&)>& successors) {
  std::map<Losses, std::size_t> found = {{Losses(), 0}};
  std::vector<const Losses*> modes = {&found.begin()->first};  // in the order in which they were found
  std::vector<std::pair<std::size_t, std::size_t>> links;
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    for (Losses& next : successors(*modes[mode])) {
      const auto [entry, is_new] = found.try_emplace(std::move(next), modes.size());
      if (is_new) modes.push_back(&entry->first);
      links.emplace_back(mode, entry->second);
    }
  }
  std::vector<std::size_t> order(modes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&modes](std::size_t a, std::size_t b) {
    return std::lexicographical_compare(modes[a]->rbegin(), modes[a]->rend(), modes[b]->rbegin(),
                                        modes[b]->rend());
  });
  std::vector<std::int32_t> number(modes.size());
  std::vector<const Losses*> sorted;
  for (const std::size_t mode : order) {
    number[mode] = static_cast<std::int32_t>(sorted.size());
    sorted.push_back(modes[mode]);
  }
  LossAutomaton result{.names = names_of(sorted), .transitions = {}};
  for (const auto& [from, to] : links) result.transitions.emplace_back(number[from], number[to]);
  std::sort(result.transitions.begin(), result.transitions.end());
  return result;
}

/// Whether "n choose k" is above a limit. @pre 0 <= k <= n, n and limit below 2^31
bool exceeds_binomial(std::int64_t n, std::int64_t k, std::int64_t limit) {
  REQUIRES(0 <= k && k <= n && std::max(n, limit) <= INT32_MAX);
  std::int64_t value = 1;
  for (std::int64_t i = 1; i <= std::min(k, n - k); ++i) {
    value = value * (n - i + 1) / i;  // "n choose i", which grows up to the middle
    if (value > limit) return true;
  }
  return false;
}

/// A step later.
Losses aged(const Losses& losses, bool is_lost) {
  Losses result;
  if (is_lost) result.push_back(1);
  for (const std::int32_t distance : losses) result.push_back(distance + 1);
  return result;
}

/// The r-th newest loss matters if a window that begins with it holds, with misses - r + 1 more at once, one
/// too many. Older losses than the oldest of those may be forgotten; the present step is remembered anyway.
Losses still_limiting(Losses losses, std::int64_t misses, std::int64_t window) {
  const bool is_lost = !losses.empty() && losses.front() == 1;
  std::size_t kept = losses.size();
  while (kept > 0 && losses[kept - 1] + (misses - static_cast<std::int64_t>(kept) + 1) > window) --kept;
  losses.resize(std::max<std::size_t>(kept, is_lost ? 1 : 0));
  return losses;
}

}  // namespace

std::optional<LossAutomaton> delay_automaton(std::int64_t steps, std::size_t most_modes) {
  if (steps >= static_cast<std::int64_t>(most_modes)) return std::nullopt;
  LossAutomaton result;
  for (std::int64_t k = 0; k < steps; ++k) {
    result.names.emplace_back(static_cast<std::size_t>(k + 1), '0');
    result.transitions.emplace_back(k, k + 1);
  }
  result.names.emplace_back("1");
  result.transitions.emplace_back(steps, steps);
  return result;
}

std::optional<LossAutomaton> burst_automaton(std::int64_t length, std::int64_t gap, std::size_t most_modes) {
  REQUIRES(length >= 1 && gap >= 1);
  if (length + gap > static_cast<std::int64_t>(most_modes)) return std::nullopt;
  const auto successors = [length, gap](const Losses& losses) {
    const bool is_lost = !losses.empty() && losses.front() == 1;
    std::vector<Losses> result;
    // Connected: only the newest loss is remembered, as long as the gap lasts.
    Losses after;
    if (!losses.empty() && losses.front() < gap) after.push_back(losses.front() + 1);
    result.push_back(std::move(after));
    if (losses.empty() || (is_lost && static_cast<std::int64_t>(losses.size()) < length)) {
      result.push_back(aged(losses, true));
    }
    return result;
  };
  return unfold(successors);
}

std::optional<LossAutomaton> weakly_hard_automaton(std::int64_t misses, std::int64_t window,
                                                   std::size_t most_modes) {
  REQUIRES(0 <= misses && misses <= window && 1 <= window);
  // One mode for each way to lose `misses` steps of a window: see still_limiting(). All lost: two modes.
  if (exceeds_binomial(window, misses, static_cast<std::int64_t>(most_modes))) return std::nullopt;
  const auto successors = [misses, window](const Losses& losses) {
    std::vector<Losses> result = {still_limiting(aged(losses, false), misses, window)};
    const auto recent = std::upper_bound(losses.begin(), losses.end(), window - 1) - losses.begin();
    if (recent < misses) result.push_back(still_limiting(aged(losses, true), misses, window));
    return result;
  };
  return unfold(successors);
}

}  // namespace coordreq
