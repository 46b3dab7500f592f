#include "results/chunk_codec.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <random>

namespace coordreq {
namespace {

std::vector<std::byte> bytes(const std::vector<int>& values) {
  std::vector<std::byte> result;
  result.reserve(values.size());
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

std::vector<std::byte> shuffled(const std::vector<int>& values, std::size_t element_size) {
  std::vector<std::byte> result(values.size());
  shuffle_bytes(bytes(values), element_size, result);
  return result;
}

std::vector<std::byte> unpack(const std::vector<std::byte>& packed, std::size_t size) {
  std::vector<std::byte> raw(size);
  libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
  std::size_t found = 0;
  EXPECT_EQ(
      libdeflate_zlib_decompress(decompressor, packed.data(), packed.size(), raw.data(), raw.size(), &found),
      LIBDEFLATE_SUCCESS);
  libdeflate_free_decompressor(decompressor);
  EXPECT_EQ(found, size);
  return raw;
}

TEST(ShuffleBytes, GroupsTheBytesOfAllElementsByPlace) {
  EXPECT_EQ(shuffled({1, 2, 3, 4, 5, 6}, 2), bytes({1, 3, 5, 2, 4, 6}));
  EXPECT_EQ(shuffled({1, 2, 3, 4, 5, 6, 7, 8}, 4), bytes({1, 5, 2, 6, 3, 7, 4, 8}));
  EXPECT_EQ(shuffled({1, 2, 3, 4, 5, 6, 7, 8}, 8), bytes({1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(shuffled({1, 2, 3}, 1), bytes({1, 2, 3}));
}

TEST(ChunkCodec, PacksToAZlibStreamOfTheShuffledBytes) {
  ChunkCodec codec;
  std::vector<std::byte> packed(3);
  codec.pack(bytes({1, 2, 3, 4, 5, 6}), 2, packed);
  EXPECT_EQ(unpack(packed, 6), bytes({1, 3, 5, 2, 4, 6}));
  codec.pack(bytes({1, 2, 3, 4, 5, 6}), 1, packed);
  EXPECT_EQ(unpack(packed, 6), bytes({1, 2, 3, 4, 5, 6}));
}

TEST(ChunkCodec, ChunksOfOneValueArePackedLikeAllOthers) {
  ChunkCodec used;
  const std::vector<std::byte> zeros(1000, std::byte{0});
  const std::vector<std::byte> ones(1000, std::byte{1});
  std::vector<std::byte> mixed = ones;
  mixed.back() = std::byte{2};
  const std::vector<std::byte> longer(1200, std::byte{1});
  for (const auto& raw : {zeros, ones, ones, mixed, ones, longer, zeros}) {
    for (const std::size_t element_size : {1U, 2U, 4U}) {
      std::vector<std::byte> packed, expected;
      used.pack(raw, element_size, packed);
      ChunkCodec().pack(raw, element_size, expected);
      EXPECT_EQ(packed, expected);
    }
  }
}

TEST(ChunkCodec, ChunksThatComeAgainArePackedTheSame) {
  ChunkCodec used;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t k = 0; k < 12; ++k) {  // more than it remembers, alike but for one byte
      std::vector<std::byte> raw(5000, std::byte{3});
      raw[k * 400 + 3] = std::byte{4};
      std::vector<std::byte> packed, expected;
      used.pack(raw, 2, packed);
      ChunkCodec().pack(raw, 2, expected);
      EXPECT_EQ(packed, expected);
      if (k % 4 == 0) used.pack(raw, 2, packed);
      EXPECT_EQ(packed, expected);
    }
  }
}

TEST(ChunkCodec, PiecesArePackedAsTheWhole) {
  const std::vector<std::byte> raw = bytes({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 0});
  for (const std::size_t element_size : {1U, 2U, 4U}) {
    std::vector<std::byte> expected, packed;
    ChunkCodec().pack(raw, element_size, expected);
    ChunkCodec codec;
    codec.begin(raw.size(), element_size);
    codec.put(std::span(raw).first(8));
    codec.put(std::span(raw).subspan(8, 4));  // what is not put is 0
    codec.finish(packed);
    EXPECT_EQ(packed, expected) << element_size;
  }
}

TEST(ChunkCodec, FewerChunksAreKnownWhereThreadsHoldMany) {
  EXPECT_EQ(KnownChunks::most(1), 8);
  EXPECT_EQ(KnownChunks::most(2), 8);
  EXPECT_EQ(KnownChunks::most(8), 2);
  EXPECT_EQ(KnownChunks::most(300), 2);
}

TEST(ChunkCodec, WhatItPackedBeforeLeavesNoTrace) {
  ChunkCodec used;
  std::vector<std::byte> packed;
  used.pack(std::vector<std::byte>(100000, std::byte{7}), 4, packed);
  used.pack(bytes({1, 2, 3, 4}), 4, packed);
  ChunkCodec fresh;
  std::vector<std::byte> expected;
  fresh.pack(bytes({1, 2, 3, 4}), 4, expected);
  EXPECT_EQ(packed, expected);
}

/// Noise, runs, and rows that are like the one before but for some places, of any length.
std::vector<std::byte> draw_chunk(std::mt19937& random) {
  const auto below = [&random](std::size_t end) { return random() % end; };
  std::vector<std::byte> raw(below(4) == 0 ? below(300000) : below(3000));
  const std::size_t values = below(3) == 0 ? 256 : 1 + below(6), row = 1 + below(700);
  std::byte value{};
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const std::size_t kind = values == 256 ? 0 : below(40);
    if (kind == 0) value = static_cast<std::byte>(below(values));
    raw[i] = kind > 1 && i >= row ? raw[i - row] : value;
  }
  return raw;
}

TEST(ChunkCodec, ChunksOfAnyKindComeBackAndHardlyGrow) {
  std::mt19937 random(20180410);
  ChunkCodec codec;
  std::vector<std::byte> packed, found;
  for (int k = 0; k < 400; ++k) {
    const std::vector<std::byte> raw = draw_chunk(random);
    codec.pack(raw, 1, packed);
    ASSERT_TRUE(unpack_chunk(packed, raw.size(), true, 1, found)) << k << ": " << raw.size();
    ASSERT_EQ(found, raw) << k;
    // What does not pack is stored, five bytes beside each 4 KiB.
    EXPECT_LE(packed.size(), raw.size() + raw.size() / 500 + 32) << k;
  }
}

TEST(ChunkCodec, WhatWasPackedIsUnpacked) {
  std::vector<std::byte> raw(4096), packed, found;
  for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = static_cast<std::byte>(i * i % 251);
  for (const std::size_t element_size : {1U, 2U, 4U, 8U}) {
    ChunkCodec().pack(raw, element_size, packed);
    ASSERT_TRUE(unpack_chunk(packed, raw.size(), true, element_size, found));
    EXPECT_EQ(found, raw) << element_size;
    std::vector<std::byte> shuffled(raw.size());
    shuffle_bytes(raw, element_size, shuffled);
    ASSERT_TRUE(unpack_chunk(shuffled, raw.size(), false, element_size, found));
    EXPECT_EQ(found, raw) << element_size;
  }
}

TEST(ChunkCodec, NothingElseThanAChunkOfThisLengthIsUnpacked) {
  std::vector<std::byte> packed, found;
  ChunkCodec().pack(std::vector<std::byte>(4096), 1, packed);
  EXPECT_TRUE(unpack_chunk(packed, 4096, true, 1, found));
  EXPECT_FALSE(unpack_chunk(packed, 4095, true, 1, found));
  EXPECT_FALSE(unpack_chunk(packed, 4097, true, 1, found));
  EXPECT_FALSE(unpack_chunk(packed, 4096, false, 1, found));
  packed[packed.size() / 2] ^= std::byte{0xff};
  EXPECT_FALSE(unpack_chunk(packed, 4096, true, 1, found));
}

}  // namespace
}  // namespace coordreq
