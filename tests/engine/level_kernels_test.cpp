#include "engine/level_kernels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "instruction_sets.hpp"

namespace coordreq {
namespace {

/// A row of n levels that begins anywhere, with the rest of its last block after it. Small and extreme levels
/// are frequent, as in analyses.
template <class Level>
struct Row {
  std::vector<Level> storage;
  std::size_t offset = 0;

  explicit Row(std::size_t n)
      : storage(n + 33 + kLevelBlock / sizeof(Level)), offset(*rc::gen::inRange<std::size_t>(0, 33)) {
    for (Level& level : storage) {
      constexpr Level kTop = std::numeric_limits<Level>::max();
      level = *rc::gen::element<Level>(0, 1, 2, 7, 8, kTop / 2, kTop / 2 + 1, kTop - 2, kTop - 1, kTop);
    }
  }
  [[nodiscard]] Level* data() { return storage.data() + offset; }
  [[nodiscard]] Level operator[](std::size_t i) const { return storage[offset + i]; }
};

template <class Level>
class LevelKernelsTest : public testing::Test {
 protected:
  static constexpr Level kMost = std::numeric_limits<Level>::max();

  /// Rows of every length, in every instruction set that this processor has.
  template <class Property>
  static void check(const char* name, const Property& property) {
    EXPECT_TRUE(rc::check(name, [&] {
      const auto n = *rc::gen::inRange<std::size_t>(1, 300);
      for (const InstructionSet set : sets_at_hand()) property(level_kernels<Level>(set), n);
    }));
  }
  static Row<Level> lanes(std::size_t n) {
    Row<Level> row(n);
    for (Level& level : row.storage) level = level > 2 ? kMost : Level{0};
    return row;
  }
};

using LevelTypes = testing::Types<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(LevelKernelsTest, LevelTypes);

TYPED_TEST(LevelKernelsTest, MinimumOfManyRows) {
  this->check("minimum", [](const auto& kernels, std::size_t n) {
    std::vector<Row<TypeParam>> rows;
    const auto count = *rc::gen::inRange<std::size_t>(1, 6);
    for (std::size_t k = 0; k < count; ++k) rows.emplace_back(n);
    std::vector<const TypeParam*> pointers;
    for (Row<TypeParam>& row : rows) pointers.push_back(row.data());
    Row<TypeParam> out(n);
    kernels.minimum(pointers.data(), count, out.data(), n);
    for (std::size_t j = 0; j < n; ++j) {
      TypeParam least = rows[0][j];
      for (const Row<TypeParam>& row : rows) least = row[j] < least ? row[j] : least;
      RC_ASSERT(out[j] == least);
    }
  });
}

TYPED_TEST(LevelKernelsTest, LoweringAtALabel) {
  this->check("lower_at", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> source(n);
    Row<TypeParam> labels(n);
    Row<TypeParam> target(n);
    const Row<TypeParam> before = target;
    const TypeParam label = labels[*rc::gen::inRange<std::size_t>(0, n)];
    kernels.lower_at(source.data(), labels.data(), label, target.data(), n);
    for (std::size_t j = 0; j < n; ++j)
      RC_ASSERT(target[j] == (labels[j] == label ? std::min(before[j], source[j]) : before[j]));
  });
}

TYPED_TEST(LevelKernelsTest, RaisingAndLowering) {
  this->check("raise, raise_where, lower_where", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> source(n);
    Row<TypeParam> where = TestFixture::lanes(n);
    Row<TypeParam> raised(n);
    Row<TypeParam> raised_where = raised;
    Row<TypeParam> lowered_where = raised;
    const Row<TypeParam> before = raised;
    kernels.raise(source.data(), raised.data(), n);
    kernels.raise_where(source.data(), where.data(), raised_where.data(), n);
    kernels.lower_where(source.data(), where.data(), lowered_where.data(), n);
    for (std::size_t j = 0; j < n; ++j) {
      RC_ASSERT(raised[j] == std::max(before[j], source[j]));
      RC_ASSERT(raised_where[j] == (where[j] != 0 ? std::max(before[j], source[j]) : before[j]));
      RC_ASSERT(lowered_where[j] == (where[j] != 0 ? std::min(before[j], source[j]) : before[j]));
    }
  });
}

TYPED_TEST(LevelKernelsTest, Settled) {
  this->check("is_settled", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> row(n);
    Row<TypeParam> bound = row;
    for (std::size_t j = 0; j < n; ++j) {
      bound.data()[j] = *rc::gen::arbitrary<bool>() || row[j] == TestFixture::kMost
                            ? row[j]
                            : static_cast<TypeParam>(row[j] + 1);
    }
    RC_ASSERT(kernels.is_settled(row.data(), bound.data(), n));
    const auto j = *rc::gen::inRange<std::size_t>(0, n);
    if (row[j] < TestFixture::kMost - 1) {
      bound.data()[j] = static_cast<TypeParam>(row[j] + 2);
      RC_ASSERT(!kernels.is_settled(row.data(), bound.data(), n));
    }
  });
}

TYPED_TEST(LevelKernelsTest, BelowIsFromTheFirstToTheLastLane) {
  this->check("below", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> row(n);
    Row<TypeParam> where = TestFixture::lanes(n);
    Row<TypeParam> bound(n);
    if (*rc::gen::arbitrary<bool>()) {  // nowhere, or in a lane or two
      for (std::size_t j = 0; j < n; ++j)
        if (where[j] != 0) bound.data()[j] = row[j];
      for (int k = *rc::gen::inRange(0, 3); k > 0; --k) {
        const auto j = *rc::gen::inRange<std::size_t>(0, n);
        row.data()[j] = 0;
        bound.data()[j] = TestFixture::kMost;
      }
    }
    std::size_t first = n, last = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (where[j] == 0 || row[j] >= bound[j]) continue;
      first = std::min(first, j);
      last = j + 1;
    }
    const LaneRange found = kernels.below(row.data(), where.data(), bound.data(), n);
    RC_ASSERT(found.size() == (first < last ? last - first : 0));
    RC_ASSERT(found.size() == 0 || found.begin == first);
  });
}

TYPED_TEST(LevelKernelsTest, BitsToLanesAndBack) {
  this->check("spread, top_bits", [](const auto& kernels, std::size_t n) {
    std::vector<std::uint64_t> bits(n / 64 + 2);
    for (std::uint64_t& word : bits) word = *rc::gen::arbitrary<std::uint64_t>() * 0x9E3779B97F4A7C15U;
    Row<TypeParam> spread(n);
    kernels.spread(bits.data(), spread.data(), n);
    std::vector<std::uint64_t> back((n + 63) / 64, 0x5555);
    kernels.top_bits(spread.data(), back.data(), n);
    for (std::size_t j = 0; j < n; ++j) {
      const bool bit = (bits[j / 64] >> (j % 64) & 1) != 0;
      RC_ASSERT(spread[j] == (bit ? TestFixture::kMost : 0));
    }
    if (n % 64 != 0) bits[n / 64] &= (std::uint64_t{1} << (n % 64)) - 1;
    RC_ASSERT(std::equal(back.begin(), back.end(), bits.begin()));
  });
}

TYPED_TEST(LevelKernelsTest, AdvanceAddsOneUpToTheLimit) {
  this->check("advance", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> next(n);
    Row<TypeParam> old(n);
    const auto limit = *rc::gen::element<TypeParam>(0, 1, 8, TestFixture::kMost - 2, TestFixture::kMost - 1);
    if (*rc::gen::arbitrary<bool>()) {  // nothing changes
      for (std::size_t j = 0; j < n; ++j) {
        const TypeParam stepped = next[j] < limit ? static_cast<TypeParam>(next[j] + 1) : TestFixture::kMost;
        old.data()[j] = j % 4 == 0 ? TypeParam{0} : stepped;
      }
    }
    Row<TypeParam> out(n);
    const bool changed = kernels.advance(next.data(), old.data(), limit, out.data(), n);
    bool differs = false;
    for (std::size_t j = 0; j < n; ++j) {
      const TypeParam stepped = next[j] < limit ? static_cast<TypeParam>(next[j] + 1) : TestFixture::kMost;
      RC_ASSERT(out[j] == (old[j] == 0 ? 0 : stepped));
      differs = differs || out[j] != old[j];
    }
    RC_ASSERT(changed == differs);
  });
}

TYPED_TEST(LevelKernelsTest, RiseTakesOneLess) {
  this->check("rise", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> next(n);
    Row<TypeParam> old(n);
    if (*rc::gen::arbitrary<bool>()) {  // nothing changes
      for (std::size_t j = 0; j < n; ++j) old.data()[j] = j % 4 == 0 ? TypeParam{0} : TestFixture::kMost;
    }
    Row<TypeParam> out(n);
    const bool changed = kernels.rise(next.data(), old.data(), out.data(), n);
    bool differs = false;
    for (std::size_t j = 0; j < n; ++j) {
      const TypeParam stepped = next[j] == 0 ? TypeParam{0} : static_cast<TypeParam>(next[j] - 1);
      RC_ASSERT(out[j] == (old[j] == 0 ? TypeParam{0} : std::max(old[j], stepped)));
      differs = differs || out[j] != old[j];
    }
    RC_ASSERT(changed == differs);
  });
}

TYPED_TEST(LevelKernelsTest, LowestChangeIsOfLanesThatDiffer) {
  this->check("lowest_change", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> row(n);
    Row<TypeParam> other(n);
    const bool is_same = *rc::gen::arbitrary<bool>();
    for (std::size_t j = 0; j < n; ++j) {
      if (is_same || j % 3 == 0) other.data()[j] = row[j];
    }
    TypeParam lowest = TestFixture::kMost;
    for (std::size_t j = 0; j < n; ++j) {
      if (row[j] != other[j]) lowest = std::min({lowest, row[j], other[j]});
    }
    RC_ASSERT(kernels.lowest_change(row.data(), other.data(), n) == lowest);
  });
}

TYPED_TEST(LevelKernelsTest, BitsOfWhatIsAbove) {
  this->check("above_bits", [](const auto& kernels, std::size_t n) {
    Row<TypeParam> row(n);
    Row<TypeParam> bound(n);
    std::vector<std::uint64_t> bits((n + 63) / 64, ~std::uint64_t{0});
    kernels.above_bits(row.data(), bound.data(), bits.data(), n);
    for (std::size_t j = 0; j < (n + 63) / 64 * 64; ++j)
      RC_ASSERT((bits[j / 64] >> (j % 64) & 1U) == (j < n && row[j] > bound[j] ? 1U : 0U));
  });
}

}  // namespace
}  // namespace coordreq
