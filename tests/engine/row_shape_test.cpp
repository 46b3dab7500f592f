#include "engine/row_shape.hpp"
#include "support/draw.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

namespace coordreq {
namespace {

/// A row that goes on beyond its ends.
struct EndlessRow {
  std::vector<int> cells;
  RowEnds ends;

  [[nodiscard]] int at(std::int64_t k) const {
    const auto n = static_cast<std::int64_t>(cells.size());
    if (ends.below == Outside::periodic) return cells[static_cast<std::size_t>((k % n + n) % n)];
    if (k < 0) return beyond(ends.below, cells.front());
    return k < n ? cells[static_cast<std::size_t>(k)] : beyond(ends.above, cells.back());
  }
  [[nodiscard]] int least(std::int64_t first, std::int64_t last) const {
    int result = at(first);
    for (std::int64_t k = first; k <= last; ++k) result = std::min(result, at(k));
    return result;
  }

 private:
  static int beyond(Outside rule, int boundary) {
    return rule == Outside::unsafe ? 0 : rule == Outside::safe ? 9 : boundary;
  }
};

TEST(RowWindow, FittedOffsetsMeetTheSameLevels) {
  EXPECT_TRUE(rc::check("least levels over a window stay the same", [] {
    EndlessRow row;
    const int n = draw(1, 9);
    for (int c = 0; c < n; ++c) row.cells.push_back(draw(0, 9));
    const std::vector<Outside> rules = {Outside::unsafe, Outside::safe, Outside::saturate, Outside::stop};
    row.ends = draw(0, 2) == 0 ? RowEnds{Outside::periodic, Outside::periodic}
                               : RowEnds{rules[static_cast<std::size_t>(draw(0, 3))],
                                         rules[static_cast<std::size_t>(draw(0, 3))]};
    const int first = draw(-30, 30);
    const IndexRange window{first, first + draw(0, 1) * draw(0, 25)};
    const IndexRange fitted = fit_window(window, n, row.ends);
    RC_ASSERT(fitted.first <= fitted.last);
    RC_ASSERT(fitted.first >= -n);
    RC_ASSERT(fitted.last <= (row.ends.below == Outside::periodic ? n + n / 2 : n));
    RC_ASSERT(fitted.last - fitted.first <= 2 * n);
    for (int c = 0; c < n; ++c) {
      RC_ASSERT(row.least(c + window.first, c + window.last) == row.least(c + fitted.first, c + fitted.last));
    }
  }));
}

TEST(RowWindow, RingsTurnTheShortWay) {
  constexpr RowEnds kRing{Outside::periodic, Outside::periodic};
  EXPECT_EQ(fit_window({9, 10}, 10, kRing), (IndexRange{-1, 0}));
  EXPECT_EQ(fit_window({5, 5}, 10, kRing), (IndexRange{5, 5}));
  EXPECT_EQ(fit_window({6, 7}, 10, kRing), (IndexRange{-4, -3}));
  EXPECT_EQ(fit_window({-23, -22}, 10, kRing), (IndexRange{-3, -2}));
  EXPECT_EQ(fit_window({0, 40}, 10, kRing), (IndexRange{0, 9}));
}

TEST(RowWindow, EndsOfTheNumbersDoNotOverflow) {
  constexpr RowEnds kRing{Outside::periodic, Outside::periodic};
  constexpr RowEnds kLine{Outside::saturate, Outside::unsafe};
  EXPECT_EQ(fit_window({INT32_MIN, INT32_MAX}, 10, kLine), (IndexRange{-10, 10}));
  EXPECT_EQ(fit_window({INT32_MAX, INT32_MAX}, 10, kLine), (IndexRange{10, 10}));
  const IndexRange turned = fit_window({INT32_MIN, INT32_MAX}, 10, kRing);
  EXPECT_EQ(turned.last - turned.first, 9);
}

}  // namespace
}  // namespace coordreq
