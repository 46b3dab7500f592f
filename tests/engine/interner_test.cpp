#include "engine/interner.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

namespace coordreq {
namespace {

/// Rows of numbers in slots, so few different hashes that most contents meet others with the same one.
struct Rows {
  static constexpr std::size_t kCount = 40;
  Interner interner{kCount};
  std::vector<int> held = std::vector<int>(kCount, -1);                     // [slot]
  std::vector<std::uint32_t> slot_of = std::vector<std::uint32_t>(kCount);  // [row]
  std::vector<int> values = std::vector<int>(kCount, -1);                   // [row] -1: it stands nowhere

  void put(std::size_t row, int value) {
    if (values[row] >= 0) interner.drop(slot_of[row]);
    values[row] = value;
    const auto hash = static_cast<std::uint64_t>(value % 3) << 62U | static_cast<std::uint64_t>(value % 3);
    slot_of[row] = interner.enter(
        hash, [&](std::uint32_t slot) { return held.at(slot) == value; },
        [&](std::uint32_t slot) { held.at(slot) = value; });
  }
};

TEST(Interner, HoldsEqualContentsOnce) {
  EXPECT_TRUE(rc::check("as a map would", [] {
    Rows rows;
    const int changes = *rc::gen::inRange(0, 400);
    for (int k = 0; k < changes; ++k)
      rows.put(*rc::gen::inRange<std::size_t>(0, Rows::kCount), *rc::gen::inRange(0, 60));
    for (std::size_t r = 0; r < Rows::kCount; ++r) {
      if (rows.values[r] < 0) continue;
      RC_ASSERT(rows.held[rows.slot_of[r]] == rows.values[r]);
      for (std::size_t other = 0; other < r; ++other) {
        if (rows.values[other] < 0) continue;
        const bool are_equal = rows.values[r] == rows.values[other];
        RC_ASSERT((rows.slot_of[r] == rows.slot_of[other]) == are_equal);
        RC_ASSERT((rows.interner.content(rows.slot_of[r]) == rows.interner.content(rows.slot_of[other])) ==
                  are_equal);
      }
    }
    // Slots that the last row has left are free: there is room for as many contents as rows.
    for (std::size_t r = 0; r < Rows::kCount; ++r) rows.put(r, 100 + static_cast<int>(r));
    for (std::size_t r = 0; r < Rows::kCount; ++r) RC_ASSERT(rows.held[rows.slot_of[r]] == rows.values[r]);
  }));
}

TEST(Interner, AFreeSlotIsTakenAgainWithANewNumber) {
  Interner interner(2);
  const auto enter = [&] {
    return interner.enter(
        7, [](std::uint32_t) { return true; }, [](std::uint32_t) {});
  };
  const std::uint32_t slot = enter();
  const std::uint32_t before = interner.content(slot);
  EXPECT_EQ(enter(), slot);
  EXPECT_EQ(interner.content(slot), before);
  interner.drop(slot);
  interner.drop(slot);
  EXPECT_EQ(enter(), slot);
  EXPECT_NE(interner.content(slot), before);
}

}  // namespace
}  // namespace coordreq
