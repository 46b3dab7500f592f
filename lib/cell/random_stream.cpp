#include "cell/random_stream.hpp"

#include <bit>

#include "base/requires.hpp"

namespace coordreq {
namespace {

constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15U;

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t run, Purpose purpose) {
  std::uint64_t counter = mix(mix(mix(seed) + run) + static_cast<std::uint64_t>(purpose));
  for (std::uint64_t& word : state_) {
    counter += kGamma;
    word = mix(counter);
  }
}

std::uint64_t RandomStream::next() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17U;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

std::uint64_t RandomStream::below(std::uint64_t count) {
  REQUIRES(count >= 1);
  // The first 2^64 mod count numbers are those that too many remainders would share.
  const std::uint64_t skipped = (0 - count) % count;
  std::uint64_t drawn = next();
  while (drawn < skipped) drawn = next();
  return drawn % count;
}

Rational RandomStream::fraction() {
  return Rational(static_cast<unsigned long>(next() >> 32U)) / Rational(0x100000000UL);
}

}  // namespace coordreq
