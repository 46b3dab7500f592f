#include "cell/random_stream.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace coordreq {
namespace {

using Purpose = RandomStream::Purpose;

std::vector<std::uint64_t> first_three(RandomStream stream) {
  return {stream.next(), stream.next(), stream.next()};
}

// The expected numbers are those of an implementation in Python of the documented construction.
TEST(RandomStream, IsTheDocumentedGenerator) {
  EXPECT_EQ(first_three(RandomStream(1, 0, Purpose::start)),
            (std::vector<std::uint64_t>{0xea5a775144563ee8, 0x63bea849ca8ecf6c, 0x6fad673d00160f15}));
  EXPECT_EQ(first_three(RandomStream(UINT64_MAX, 7, Purpose::disturbances)),
            (std::vector<std::uint64_t>{0x9466372708c02a92, 0xce930a481cec28d2, 0x323ea5a46fcf9d55}));
}

TEST(RandomStream, RunsAndPurposesHaveStreamsOfTheirOwn) {
  EXPECT_EQ(first_three(RandomStream(1, 0, Purpose::actions)),
            (std::vector<std::uint64_t>{0xcc9369ebef73f1fe, 0xe840bcb35483a2b0, 0x7a87d60d32e9b802}));
  EXPECT_EQ(first_three(RandomStream(1, 1, Purpose::start)),
            (std::vector<std::uint64_t>{0x65eebbbff67e3af8, 0x3f3d6088dae37488, 0xc22e1f8ad540ca03}));
}

TEST(RandomStream, BelowIsUniform) {
  RandomStream stream(3, 0, Purpose::actions);
  std::vector<int> counts(6, 0);
  constexpr int kDraws = 60000;
  for (int i = 0; i < kDraws; ++i) ++counts.at(stream.below(6));
  // Six standard deviations of a binomial count are 550.
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 6, 550);
}

TEST(RandomStream, BelowThrowsTheIncompleteRoundAway) {
  // Of 2^64 numbers 2^62 are skipped for this count, so that about every fourth draw takes another.
  constexpr std::uint64_t kCount = 3 * (std::uint64_t{1} << 62U);
  RandomStream stream(1, 0, Purpose::start);
  RandomStream raw(1, 0, Purpose::start);
  int skipped = 0;
  for (int i = 0; i < 1000; ++i) {
    std::uint64_t expected = raw.next();
    for (; expected < std::uint64_t{1} << 62U; ++skipped) expected = raw.next();
    ASSERT_EQ(stream.below(kCount), expected % kCount);
  }
  EXPECT_NEAR(skipped, 333, 130);
}

TEST(RandomStream, FractionsAreTheUpperHalf) {
  RandomStream stream(1, 0, Purpose::start);
  EXPECT_EQ(stream.fraction(), Rational(0xea5a7751UL) / Rational(0x100000000UL));
}

}  // namespace
}  // namespace coordreq
