#include "engine/bit_kernels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "instruction_sets.hpp"

namespace coordreq {
namespace {

using Words = std::vector<std::uint64_t>;

/// Empty, full and mixed words.
Words draw_words(std::size_t n) {
  Words words(n);
  for (std::uint64_t& word : words) {
    const auto mixed = *rc::gen::arbitrary<std::uint64_t>();
    word = *rc::gen::element<std::uint64_t>(0, ~std::uint64_t{0}, mixed, mixed | mixed << 7, ~mixed);
  }
  return words;
}

bool bit(const Words& words, std::size_t i) {
  return (words[i / 64] >> (i % 64) & 1) != 0;
}

TEST(BitKernels, AndOfShiftedRows) {
  EXPECT_TRUE(rc::check("and_shifted", [] {
    const auto words = *rc::gen::inRange<std::size_t>(1, 40);
    const auto lane = *rc::gen::inRange<std::size_t>(0, 200);
    const auto count = *rc::gen::inRange<std::size_t>(0, 5);
    const Words bits = draw_words(words + (lane + count) / 64 + 2);
    const Words before = draw_words(words);
    for (const InstructionSet set : sets_at_hand()) {
      Words target = before;
      bit_kernels(set).and_shifted(bits.data(), lane, count, target.data(), words);
      for (std::size_t i = 0; i < 64 * words; ++i) {
        bool expected = bit(before, i);
        for (std::size_t s = 0; s < count; ++s) expected = expected && bit(bits, lane + s + i);
        RC_ASSERT(bit(target, i) == expected);
      }
    }
  }));
}

TEST(BitKernels, Comparison) {
  EXPECT_TRUE(rc::check("compare", [] {
    const auto words = *rc::gen::inRange<std::size_t>(1, 40);
    Words a = draw_words(words);
    Words b = draw_words(words);
    const auto kind = *rc::gen::inRange(0, 4);
    for (std::size_t w = 0; w < words; ++w) {
      if (kind == 1) a[w] &= b[w];   // a within b
      if (kind == 2) a[w] &= ~b[w];  // disjoint
      if (kind == 3 && w + 1 < words) a[w] = 0;
    }
    int expected = 0;
    for (std::size_t i = 0; i < 64 * words; ++i) {
      if (bit(a, i)) expected |= bit(b, i) ? 1 : 2;
    }
    RC_CLASSIFY(expected != 3, "not both");
    for (const InstructionSet set : sets_at_hand())
      RC_ASSERT(bit_kernels(set).compare(a.data(), b.data(), words) == expected);
  }));
}

TEST(BitKernels, Union) {
  EXPECT_TRUE(rc::check("join", [] {
    const auto words = *rc::gen::inRange<std::size_t>(1, 40);
    const Words source = draw_words(words);
    const Words before = draw_words(words);
    Words whole = draw_words(words);
    const bool is_within = *rc::gen::arbitrary<bool>();
    for (std::size_t w = 0; is_within && w < words; ++w) whole[w] &= source[w] | before[w];
    bool expected = true;
    for (std::size_t w = 0; w < words; ++w) expected = expected && (whole[w] & ~(source[w] | before[w])) == 0;
    RC_CLASSIFY(expected, "all of it");
    for (const InstructionSet set : sets_at_hand()) {
      Words target = before;
      RC_ASSERT(bit_kernels(set).join(source.data(), whole.data(), target.data(), words) == expected);
      for (std::size_t w = 0; w < words; ++w) RC_ASSERT(target[w] == (source[w] | before[w]));
    }
  }));
}

}  // namespace
}  // namespace coordreq
