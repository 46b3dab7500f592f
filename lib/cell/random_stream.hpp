#pragma once

#include <array>
#include <cstdint>

#include "numeric/rational.hpp"

namespace coordreq {

/// Random numbers that are the same on every machine, an independent stream for each run and purpose.
///
/// xoshiro256** of Blackman and Vigna (ACM TOMS 47(4), 2021, doi 10.1145/3460772). Its 256 bits of state are
/// four outputs of SplitMix64 (Steele, Lea, Flood 2014, doi 10.1145/2660193.2660195), which starts at
/// mix(mix(mix(seed) + run) + purpose), mix being the output function of SplitMix64.
class RandomStream {
 public:
  enum class Purpose : std::uint64_t { start = 0, actions = 1, disturbances = 2, losses = 3 };

  RandomStream(std::uint64_t seed, std::uint64_t run, Purpose purpose);

  [[nodiscard]] std::uint64_t next();
  /// Uniform in [0, count): next() modulo count, draws from the incomplete last round thrown away.
  /// @pre count >= 1
  [[nodiscard]] std::uint64_t below(std::uint64_t count);
  /// k / 2^32 with k uniform in [0, 2^32): the upper half of next().
  [[nodiscard]] Rational fraction();

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace coordreq
