#include "engine/interner.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <vector>

namespace coordreq {
namespace {

/// Rows of numbers in slots, so few different hashes that most contents meet others with the same one.
struct Rows {
  Interner interner;
  std::vector<int> held;               // [slot]
  std::vector<std::uint32_t> slot_of;  // [row]

  void put(std::size_t row, int value) {
    const auto hash = static_cast<std::uint64_t>(value % 3) << 62U | static_cast<std::uint64_t>(value % 3);
    std::uint32_t slot = interner.find(hash, [&](std::uint32_t other) { return held[other] == value; });
    if (slot != Interner::kNone) {
      interner.hold(slot);
    } else {
      slot = interner.add(hash);
      held.resize(std::max<std::size_t>(held.size(), slot + 1));
      held[slot] = value;
    }
    if (slot_of[row] != Interner::kNone) interner.drop(slot_of[row]);
    slot_of[row] = slot;
  }
};

TEST(Interner, HoldsEqualContentsOnce) {
  EXPECT_TRUE(rc::check("as a map would", [] {
    Rows rows;
    rows.slot_of.assign(40, Interner::kNone);
    std::vector<int> values(40, -1);
    const int changes = *rc::gen::inRange(0, 400);
    for (int k = 0; k < changes; ++k) {
      const auto row = *rc::gen::inRange<std::size_t>(0, 40);
      values[row] = *rc::gen::inRange(0, 60);
      rows.put(row, values[row]);
    }
    std::map<int, std::int64_t> count;
    for (std::size_t r = 0; r < values.size(); ++r) {
      if (values[r] < 0) continue;
      ++count[values[r]];
      RC_ASSERT(rows.held[rows.slot_of[r]] == values[r]);
      for (std::size_t other = 0; other < r; ++other) {
        if (values[other] < 0) continue;
        RC_ASSERT((rows.slot_of[r] == rows.slot_of[other]) == (values[r] == values[other]));
        RC_ASSERT((rows.interner.content(rows.slot_of[r]) == rows.interner.content(rows.slot_of[other])) ==
                  (values[r] == values[other]));
      }
    }
    std::int64_t held = 0;
    for (std::size_t slot = 0; slot < rows.interner.size(); ++slot)
      held += rows.interner.rows(slot) > 0 ? 1 : 0;
    RC_ASSERT(held == static_cast<std::int64_t>(count.size()));
    for (const auto& [value, times] : count) {
      const auto slot = rows.slot_of[static_cast<std::size_t>(std::find(values.begin(), values.end(), value) -
                                                              values.begin())];
      RC_ASSERT(rows.interner.rows(slot) == times);
    }
  }));
}

TEST(Interner, AFreeSlotIsTakenAgainWithANewNumber) {
  Interner interner;
  const std::uint32_t slot = interner.add(7);
  const std::uint32_t before = interner.content(slot);
  interner.drop(slot);
  EXPECT_EQ(interner.find(7, [](std::uint32_t) { return true; }), Interner::kNone);
  EXPECT_EQ(interner.add(7), slot);
  EXPECT_NE(interner.content(slot), before);
}

}  // namespace
}  // namespace coordreq
