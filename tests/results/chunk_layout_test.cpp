#include "results/chunk_layout.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace coordreq {
namespace {

using Extents = std::vector<std::uint64_t>;

TEST(ChunkLayout, SmallAndEmptyArraysAreNotCut) {
  EXPECT_FALSE(ChunkLayout({}, 8).chunked());
  EXPECT_FALSE(ChunkLayout({0}, 8).chunked());
  EXPECT_FALSE(ChunkLayout({16, 1024}, 1).chunked());
  EXPECT_TRUE(ChunkLayout({16, 1025}, 1).chunked());
  EXPECT_EQ(ChunkLayout({}, 8).elements(), 1U);
  EXPECT_EQ(ChunkLayout({3, 0}, 8).elements(), 0U);
}

TEST(ChunkLayout, TrailingDimensionsStayWhole) {
  const ChunkLayout layout({100, 200, 300}, 2);  // 12 MB: chunks of 1/16 of it
  EXPECT_EQ(layout.chunk_shape(), (Extents{6, 200, 300}));
  EXPECT_EQ(layout.chunk_count(), 17U);
}

TEST(ChunkLayout, LargeSlabsAreCutInsideIntoEvenPieces) {
  const ChunkLayout layout({5, 3000, 1000}, 1);  // a slab of 3 MB, pieces of at most 15 MB / 16
  EXPECT_EQ(layout.chunk_shape(), (Extents{1, 750, 1000}));
  EXPECT_EQ(layout.chunk_count(), 20U);
  const ChunkLayout::Segment second_slab = layout.segment(5);
  EXPECT_EQ(second_slab.offset, (Extents{1, 750, 0}));
  EXPECT_EQ(second_slab.begin, 3750000U);
  EXPECT_EQ(second_slab.count, 750000U);
}

TEST(ChunkLayout, LargeArraysHaveChunksOfAboutOneMebibyte) {
  const ChunkLayout layout({38825361}, 8);
  EXPECT_EQ(layout.chunk_count(), 297U);
  EXPECT_LE(layout.chunk_elements() * 8, 1024U * 1024U);
  EXPECT_GE(layout.chunk_elements() * 8, 1000U * 1000U);
}

/// Linear index of `offset` in an array of this shape.
std::uint64_t linear_index(const Extents& shape, const Extents& offset) {
  std::uint64_t index = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) index = index * shape[i] + offset[i];
  return index;
}

TEST(ChunkLayout, StretchesCoverTheArrayOnceInOrderAndFitTheirChunks) {
  EXPECT_TRUE(rc::check([] {
    const auto rank = *rc::gen::inRange<std::size_t>(1, 5);
    const Extents shape =
        *rc::gen::container<Extents>(rank, rc::gen::inRange<std::uint64_t>(1, rank == 1   ? 3000000
                                                                              : rank == 2 ? 2000
                                                                                          : 60));
    const std::size_t size = *rc::gen::element<std::size_t>(1, 2, 4, 8);
    const ChunkLayout layout(shape, size);
    if (!layout.chunked()) {
      RC_ASSERT(layout.elements() * size <= 16U * 1024U);
      return;
    }
    RC_ASSERT(layout.chunk_elements() * size <= 1024U * 1024U);
    std::uint64_t covered = 0;
    for (std::uint64_t i = 0; i < layout.chunk_count(); ++i) {
      const ChunkLayout::Segment segment = layout.segment(i);
      RC_ASSERT(segment.begin == covered);
      RC_ASSERT(segment.begin == linear_index(shape, segment.offset));
      RC_ASSERT(segment.count > 0U);
      RC_ASSERT(segment.count <= layout.chunk_elements());
      for (std::size_t d = 0; d < rank; ++d) RC_ASSERT(segment.offset[d] % layout.chunk_shape()[d] == 0U);
      covered += segment.count;
    }
    RC_ASSERT(covered == layout.elements());
  }));
}

}  // namespace
}  // namespace coordreq
