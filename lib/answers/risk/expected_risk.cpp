#include "answers/risk/expected_risk.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cfenv>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "answers/risk/risk_levels.hpp"
#include "spec/coordination_spec.hpp"

namespace coordreq {
namespace {

/// Lanes that are computed together; they stay in the first-level cache.
constexpr std::size_t kLanes = 256;

/// The processor rounds up during the lifetime of this object.
class RoundingUp {
 public:
  RoundingUp() { std::fesetround(FE_UPWARD); }
  ~RoundingUp() { std::fesetround(before_); }
  RoundingUp(const RoundingUp&) = delete;
  RoundingUp& operator=(const RoundingUp&) = delete;

 private:
  int before_ = std::fegetround();
};

struct Block {
  std::array<double, kLanes> sum;
  std::array<float, kLanes> greatest;
};

float risk_at(const std::uint32_t* row, std::size_t lane) {
  return std::bit_cast<float>(~row[lane]);
}

// Functions that compute are never inlined: compilers may move arithmetic over a change of the rounding mode,
// but not out of a function that is called.

[[gnu::noinline]] void add_row(const std::uint32_t* row, double weight, std::size_t n, Block& block) {
  for (std::size_t j = 0; j < n; ++j) {
    const float risk = risk_at(row, j);
    block.sum[j] += weight * double{risk};
    block.greatest[j] = std::max(block.greatest[j], risk);
  }
}

/// Adds for one lane the rest of probability, to the riskiest modes first.
[[gnu::noinline]] void add_rest(std::span<const float> risks, const std::vector<double>& more, double rest,
                                std::vector<std::size_t>& order, double& sum) {
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::tie(risks[b], a) < std::tie(risks[a], b); });
  for (const std::size_t i : order) {
    const double given = std::min(more[i], rest);
    sum += given * double{risks[i]};
    if (given == rest) return;
    rest -= given;
  }
}

template <class Level>
[[gnu::noinline]] void finish(const Block& block, std::size_t n, Level* out) {
  for (std::size_t j = 0; j < n; ++j) {
    const double sum = std::min(block.sum[j], double{block.greatest[j]});
    out[j] = risk_level<Level>(static_cast<RiskNumber<Level>>(sum));
  }
}

}  // namespace

ExpectedRisk::ExpectedRisk(const std::vector<Successor>& successors) {
  Rational rest = 1;
  for (const Successor& next : successors) {
    successors_.push_back(next.mode);
    least_.push_back(upper_double(next.low));
    more_.push_back(upper_double(next.high - next.low));
    rest -= next.low;
  }
  rest_ = upper_double(rest);
  if (rest == 0) more_.clear();
}

template <class Level>
void ExpectedRisk::find(std::span<const std::uint32_t* const> rows, std::size_t n, Level* out) const {
  const RoundingUp up;
  Block block;
  std::vector<float> risks(more_.size());
  std::vector<std::size_t> order(more_.size());
  for (std::size_t first = 0; first < n; first += kLanes) {
    const std::size_t count = std::min(kLanes, n - first);
    block.sum.fill(0);
    block.greatest.fill(0);
    for (std::size_t i = 0; i < rows.size(); ++i) add_row(rows[i] + first, least_[i], count, block);
    for (std::size_t j = 0; !more_.empty() && j < count; ++j) {
      for (std::size_t i = 0; i < rows.size(); ++i) risks[i] = risk_at(rows[i], first + j);
      add_rest(risks, more_, rest_, order, block.sum[j]);
    }
    finish(block, count, out + first);
  }
}

template void ExpectedRisk::find(std::span<const std::uint32_t* const>, std::size_t, std::uint32_t*) const;
template void ExpectedRisk::find(std::span<const std::uint32_t* const>, std::size_t, std::uint64_t*) const;

ExpectedRisks::ExpectedRisks(const NetworkSpec& network) {
  using Successor = ExpectedRisk::Successor;
  std::vector<std::vector<Successor>> successors(network.modes.size());
  for (std::size_t t = 0; t < network.transitions.size(); ++t) {
    const auto& [from, to] = network.transitions[t];
    const ProbabilityRange& range = network.probabilities[t];
    successors[static_cast<std::size_t>(from)].push_back(
        {static_cast<std::size_t>(to), range.low, range.high});
  }
  const auto is_less = [](const std::vector<Successor>& first, const std::vector<Successor>& second) {
    return std::ranges::lexicographical_compare(first, second, [](const Successor& a, const Successor& b) {
      return std::tie(a.mode, a.low, a.high) < std::tie(b.mode, b.low, b.high);
    });
  };
  std::map<std::vector<Successor>, std::size_t, decltype(is_less)> known(is_less);
  for (std::vector<Successor>& list : successors) {
    const auto [entry, is_new] = known.try_emplace(std::move(list), different.size());
    if (is_new) different.emplace_back(entry->first);
    of_mode.push_back(entry->second);
  }
}

}  // namespace coordreq
