#include "reach/index_form.hpp"

#include "base/requires.hpp"

namespace coordreq {
namespace {

static_assert(sizeof(long) == sizeof(std::int64_t), "GMP's long must hold 64 bits");

constexpr long kLargest = 1L << 62;

}  // namespace

IndexForm::IndexForm(const std::vector<Rational>& factors, const Rational& offset,
                     const std::vector<std::int64_t>& counts)
    : factors_(factors), offset_(offset) {
  mpz_class denominator = offset.get_den();
  for (const Rational& factor : factors) denominator = lcm(denominator, factor.get_den());
  const auto scaled = [&](const Rational& q) { return mpz_class(q.get_num() * (denominator / q.get_den())); };
  mpz_class bound = abs(scaled(offset)) + denominator;
  for (std::size_t j = 0; j < factors.size(); ++j)
    bound += abs(scaled(factors[j])) * static_cast<long>(counts[j]);
  small_ = bound < kLargest;
  if (!small_) return;
  for (const Rational& factor : factors) small_factors_.push_back(scaled(factor).get_si());
  small_offset_ = scaled(offset).get_si();
  denominator_ = denominator.get_si();
}

Rational IndexForm::value(const std::vector<std::int64_t>& indices) const {
  Rational sum = offset_;
  for (std::size_t j = 0; j < factors_.size(); ++j)
    sum += factors_[j] * Rational(static_cast<long>(indices[j]));
  return sum;
}

std::int64_t IndexForm::numerator(const std::vector<std::int64_t>& indices) const {
  std::int64_t sum = small_offset_;
  for (std::size_t j = 0; j < small_factors_.size(); ++j) sum += small_factors_[j] * indices[j];
  return sum;
}

std::int64_t IndexForm::floor(const std::vector<std::int64_t>& indices) const {
  REQUIRES(indices.size() == factors_.size());
  if (!small_) return floor_to_int(value(indices));
  const std::int64_t n = numerator(indices);
  return n / denominator_ - (n % denominator_ < 0 ? 1 : 0);
}

std::int64_t IndexForm::ceil(const std::vector<std::int64_t>& indices) const {
  REQUIRES(indices.size() == factors_.size());
  if (!small_) return ceil_to_int(value(indices));
  const std::int64_t n = numerator(indices);
  return n / denominator_ + (n % denominator_ > 0 ? 1 : 0);
}

bool IndexForm::integral(const std::vector<std::int64_t>& indices) const {
  REQUIRES(indices.size() == factors_.size());
  return small_ ? numerator(indices) % denominator_ == 0 : is_integer(value(indices));
}

}  // namespace coordreq
