#include "spec/spec_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

Rational read_bound(const Scope& scope, const JsonDocument::Node& node) {
  Rational value = scope.number(node);
  if (value < 0 || value > 1)
    throw SpecError("expected a probability from 0 to 1, found " + to_text(value), node.pointer());
  return value;
}

/// The sums of the ranges of the transitions that leave a mode.
struct Sums {
  Rational low;
  Rational high;
};

void check_sums(const Sums& sums, const std::string& mode, const std::string& pointer) {
  if (sums.low <= 1 && sums.high >= 1) return;
  const bool is_much = sums.low > 1;
  throw SpecError(
      fmt::format("expected probabilities of what follows the mode {} that can be 1 in sum, found {} {}",
                  quote_text(mode), is_much ? "at least" : "at most",
                  to_text(is_much ? sums.low : sums.high)),
      pointer);
}

}  // namespace

ProbabilityRange read_probability(const Scope& scope, const JsonDocument::Node& node) {
  if (node.is_number() || node.is_text()) {
    const Rational value = read_bound(scope, node);
    return {value, value};
  }
  ProbabilityRange range{read_bound(scope, node[0]), read_bound(scope, node[1])};
  if (range.low <= range.high) return range;
  throw SpecError(fmt::format("expected the least probability before the greatest, found [{}, {}]",
                              to_text(range.low), to_text(range.high)),
                  node.pointer());
}

void settle_probabilities(NetworkSpec& network, const std::string& pointer) {
  if (network.probabilities.empty()) return;
  std::vector<Sums> sums(network.modes.size());
  for (std::size_t t = 0; t < network.transitions.size(); ++t) {
    Sums& row_sums = sums[static_cast<std::size_t>(network.transitions[t].first)];
    row_sums.low += network.probabilities[t].low;
    row_sums.high += network.probabilities[t].high;
  }
  for (std::size_t mode = 0; mode < sums.size(); ++mode)
    check_sums(sums[mode], network.modes[mode].name, pointer);
  std::vector<std::pair<std::int32_t, std::int32_t>> transitions;
  std::vector<ProbabilityRange> probabilities;
  for (std::size_t t = 0; t < network.transitions.size(); ++t) {
    const Sums& row_sums = sums[static_cast<std::size_t>(network.transitions[t].first)];
    const ProbabilityRange& range = network.probabilities[t];
    // The rest that the other transitions leave, at most and at least.
    const Rational most = 1 - (row_sums.low - range.low);
    const Rational least = 1 - (row_sums.high - range.high);
    ProbabilityRange narrow{std::max(range.low, least), std::min(range.high, most)};
    if (narrow.high == 0) continue;
    transitions.push_back(network.transitions[t]);
    probabilities.push_back(std::move(narrow));
  }
  network.transitions = std::move(transitions);
  network.probabilities = std::move(probabilities);
}

}  // namespace coordreq
