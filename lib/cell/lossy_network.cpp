#include "cell/lossy_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "spec/coordination_spec.hpp"

namespace coordreq {
namespace {

/// floor(p 2^64), at most the greatest number.
std::uint64_t fixed_point(const Rational& p) {
  mpq_class scaled = p;
  mpq_mul_2exp(scaled.get_mpq_t(), p.get_mpq_t(), 64);
  const mpz_class whole = scaled.get_num() / scaled.get_den();
  if (mpz_sizeinbase(whole.get_mpz_t(), 2) > 64) return std::numeric_limits<std::uint64_t>::max();
  std::uint64_t bits = 0;
  mpz_export(&bits, nullptr, -1, sizeof(bits), 0, 0, whole.get_mpz_t());
  return bits;
}

/// Whether there are probabilities in the ranges that are 1 in sum.
[[maybe_unused]] bool can_be_one(const std::vector<ProbabilityRange>& ranges) {
  Rational least = 0, most = 0;
  for (const ProbabilityRange& range : ranges) {
    least += range.low;
    most += range.high;
  }
  return least <= 1 && 1 <= most;
}

}  // namespace

std::vector<Rational> likeliest(const std::vector<ProbabilityRange>& ranges) {
  REQUIRES(can_be_one(ranges));
  std::vector<Rational> result;
  std::vector<std::pair<Rational, std::size_t>> rooms;  // on either side, ascending
  Rational rest = 1;
  for (const ProbabilityRange& range : ranges) {
    rooms.emplace_back((range.high - range.low) / 2, result.size());
    result.emplace_back((range.low + range.high) / 2);
    rest -= result.back();
  }
  std::sort(rooms.begin(), rooms.end());
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Rational share = rest / static_cast<unsigned long>(rooms.size() - i);
    const Rational move = abs(share) <= rooms[i].first ? share : Rational(rooms[i].first * sgn(rest));
    result[rooms[i].second] += move;
    rest -= move;
  }
  return result;
}

LossyNetwork::LossyNetwork(const NetworkSpec& network) : modes_(network.modes.size()) {
  REQUIRES(!network.probabilities.empty());
  std::vector<std::vector<ProbabilityRange>> ranges(modes_.size());
  for (std::size_t t = 0; t < network.transitions.size(); ++t) {
    const auto& [from, to] = network.transitions[t];
    modes_[at(from)].next.emplace_back(at(to), 0);
    ranges[at(from)].push_back(network.probabilities[t]);
  }
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
    Mode& one_mode = modes_[mode];
    one_mode.partition = &network.modes[mode].partition;
    one_mode.is_connected = one_mode.partition->classes.size() == 1;
    Rational sum = 0;
    const std::vector<Rational> probabilities = likeliest(ranges[mode]);
    for (std::size_t i = 0; i < one_mode.next.size(); ++i)
      one_mode.next[i].second = fixed_point(sum += probabilities[i]);
  }
}

std::size_t LossyNetwork::draw(std::size_t mode, RandomStream& random) const {
  const auto& next = modes_[mode].next;
  const std::uint64_t number = random.next();
  const auto found = std::find_if(next.begin(), next.end() - 1,
                                  [number](const auto& entry) { return number < entry.second; });
  return found->first;
}

}  // namespace coordreq
