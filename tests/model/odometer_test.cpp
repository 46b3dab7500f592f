#include "model/odometer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace coordreq {
namespace {

using Tuple = std::vector<std::int64_t>;

TEST(Odometer, TheLastIndexIsTheFastest) {
  Odometer odometer({2, 1, 3});
  std::vector<Tuple> tuples;
  do {
    tuples.push_back(odometer.indices());
  } while (odometer.advance());
  EXPECT_EQ(tuples, (std::vector<Tuple>{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, 0, 0}, {1, 0, 1}, {1, 0, 2}}));
  EXPECT_EQ(odometer.indices(), (Tuple{0, 0, 0}));  // it has begun again
}

TEST(Odometer, WithoutCountsThereIsOneTuple) {
  Odometer odometer({});
  EXPECT_EQ(odometer.size(), 1);
  EXPECT_TRUE(odometer.indices().empty());
  EXPECT_FALSE(odometer.advance());
}

TEST(Odometer, TuplesAreNumberedAsTheyCome) {
  EXPECT_TRUE(rc::check([] {
    const auto counts = *rc::gen::container<Tuple>(3, rc::gen::inRange<std::int64_t>(1, 6));
    Odometer odometer(counts);
    for (std::int64_t number = 0; number < odometer.size(); ++number, odometer.advance()) {
      const Odometer started(counts, number);
      RC_ASSERT(started.indices() == odometer.indices());
      RC_ASSERT((started[0] * counts[1] + started[1]) * counts[2] + started[2] == number);
    }
  }));
}

}  // namespace
}  // namespace coordreq
