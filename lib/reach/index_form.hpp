#pragma once

#include <cstdint>
#include <vector>

#include "numeric/rational.hpp"

namespace coordreq {

/// floor or ceil of (sum_j factor_j * k_j + offset) for integers k_j with 0 <= k_j < count_j, exactly.
///
/// Everything is brought to one denominator; where all sums provably fit, plain 64-bit integers do the work
/// (a table has millions of entries), else GMP's.
class IndexForm {
 public:
  IndexForm(const std::vector<Rational>& factors, const Rational& offset,
            const std::vector<std::int64_t>& counts);

  /// Saturated to +-2^62. @pre as many indices as factors. @pre unchecked: each is in its range
  [[nodiscard]] std::int64_t floor(const std::vector<std::int64_t>& indices) const;
  [[nodiscard]] std::int64_t ceil(const std::vector<std::int64_t>& indices) const;
  /// True if the value is an integer.
  [[nodiscard]] bool integral(const std::vector<std::int64_t>& indices) const;

 private:
  [[nodiscard]] Rational value(const std::vector<std::int64_t>& indices) const;
  [[nodiscard]] std::int64_t numerator(const std::vector<std::int64_t>& indices) const;

  std::vector<Rational> factors_;
  Rational offset_;
  bool small_ = false;
  std::vector<std::int64_t> small_factors_;
  std::int64_t small_offset_ = 0;
  std::int64_t denominator_ = 1;
};

}  // namespace coordreq
