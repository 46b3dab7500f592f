#include "reach/index_form.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace coordreq {
namespace {

TEST(IndexForm, FloorAndCeilOfSmallAndHugeDenominatorsAgreeWithRationals) {
  EXPECT_TRUE(rc::check("index form", [] {
    // A huge denominator forces the path through GMP.
    const bool huge = *rc::gen::arbitrary<bool>();
    const Rational unit = huge ? Rational(1, mpz_class("1000000000000000000000007")) : Rational(1, 7);
    const auto number = [&]() -> Rational {
      return Rational(*rc::gen::inRange(-50, 50)) + Rational(*rc::gen::inRange(-50, 50)) * unit;
    };
    const std::vector<Rational> factors = {number(), number()};
    const Rational offset = number();
    const std::vector<std::int64_t> k = {*rc::gen::inRange<std::int64_t>(0, 20),
                                         *rc::gen::inRange<std::int64_t>(0, 20)};
    const IndexForm form(factors, offset, {20, 20});
    const Rational value = factors[0] * Rational(static_cast<long>(k[0])) +
                           factors[1] * Rational(static_cast<long>(k[1])) + offset;
    RC_ASSERT(form.floor(k) == floor_to_int(value));
    RC_ASSERT(form.ceil(k) == ceil_to_int(value));
    RC_ASSERT(form.integral(k) == is_integer(value));
  }));
}

}  // namespace
}  // namespace coordreq
