#include "model/sample_reset.hpp"

#include "model/outside.hpp"

namespace coordreq {

Rational reset_at_sample(const GridDimension& dimension, const Rational& value) {
  if (dimension.periodic()) {
    const Rational period = dimension.upper - dimension.lower;
    const Rational turns = (value - dimension.lower) / period;
    mpz_class whole;
    mpz_fdiv_q(whole.get_mpz_t(), turns.get_num_mpz_t(), turns.get_den_mpz_t());
    return value - period * whole;
  }
  if (traits(dimension.below).resets && value < dimension.first) return dimension.first;
  const Rational last = dimension.point(dimension.count - 1);
  return traits(dimension.above).resets && value > last ? last : value;
}

}  // namespace coordreq
