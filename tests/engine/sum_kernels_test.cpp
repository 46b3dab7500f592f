#include "engine/sum_kernels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "instruction_sets.hpp"

namespace coordreq {
namespace {

/// Indices of either sign with fractions that carry, nearly carry, or are none.
std::int64_t random_sum() {
  const std::int64_t whole = *rc::gen::inRange(-300, 300);
  const std::uint32_t fraction = *rc::gen::element<std::uint32_t>(0, 1, 1U << 31, UINT32_MAX - 1, UINT32_MAX,
                                                                  *rc::gen::arbitrary<std::uint32_t>());
  return (whole << 32) + fraction;
}

/// One dimension with its profiles, which begin anywhere and have the rest of a block after them.
struct Dimension {
  std::vector<std::int64_t> lower, upper;
  std::vector<std::int32_t> whole[2];
  std::vector<std::uint32_t> fraction[2];
  BoxSides sides;

  Dimension(std::size_t n, std::size_t offset) {
    sides.lower = random_sum();
    sides.upper = sides.lower + (std::int64_t{*rc::gen::inRange(0, 5)} << 31);
    sides.count = *rc::gen::inRange(1, 200);
    sides.stride = *rc::gen::inRange(1, 1000);
    sides.width_stride = *rc::gen::inRange(0, 5000);
    for (std::size_t c = 0; c < n; ++c) {
      lower.push_back(random_sum());
      upper.push_back(lower.back() + (std::int64_t{*rc::gen::inRange(0, 5)} << 30));
    }
    for (int k = 0; k < 2; ++k) {
      whole[k].resize(offset + n + kLevelBlock);
      fraction[k].resize(offset + n + kLevelBlock);
      for (std::size_t c = 0; c < n; ++c) {
        const std::int64_t number = (k == 0 ? lower : upper)[c];
        whole[k][offset + c] = static_cast<std::int32_t>(number >> 32);
        fraction[k][offset + c] = static_cast<std::uint32_t>(static_cast<std::uint64_t>(number));
      }
    }
    sides.lower_profile = {whole[0].data() + offset, fraction[0].data() + offset};
    sides.upper_profile = {whole[1].data() + offset, fraction[1].data() + offset};
  }

  [[nodiscard]] std::int64_t offset_of(std::size_t c) const {
    const std::int64_t first = (sides.lower + lower[c]) >> 32;
    const std::int64_t width = ((sides.upper + upper[c]) >> 32) - first;
    const std::int64_t at = std::min<std::int64_t>(std::max(first, -width - 1), sides.count);
    return at * sides.stride + width * sides.width_stride;
  }
};

TEST(SumKernels, PlacesAreThoseOfTheSumsTakenIn64Bits) {
  EXPECT_TRUE(rc::check("find_offsets", [] {
    const auto n = *rc::gen::inRange<std::size_t>(1, 120);
    const auto offset = *rc::gen::inRange<std::size_t>(0, 17);
    std::vector<Dimension> dimensions;
    const auto size = *rc::gen::inRange<std::size_t>(1, 4);
    dimensions.reserve(size);
    std::vector<BoxSides> sides;
    for (std::size_t i = 0; i < size; ++i) sides.push_back(dimensions.emplace_back(n, offset).sides);
    const int origin = *rc::gen::inRange(-100000, 100000);
    for (const InstructionSet set : sets_at_hand()) {
      std::vector<std::int32_t> offsets(n + kLevelBlock);
      sum_kernels(set).find_offsets(sides.data(), size, origin, offsets.data(), n);
      for (std::size_t c = 0; c < n; ++c) {
        std::int64_t expected = origin;
        for (const Dimension& dimension : dimensions) expected += dimension.offset_of(c);
        RC_ASSERT(offsets[c] == expected);
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
