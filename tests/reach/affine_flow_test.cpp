#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>

#include "reach/matrix_exponential.hpp"
#include "reach/random_flow.hpp"

namespace coordreq {
namespace {

/// x' = A x + b w with x, y, z and one disturbance; zero coefficients are not written down.
struct AffineCase {
  Matrix a;
  Vector b;
  FlowCase system{{}};

  /// exp(A s) b, row i.
  [[nodiscard]] long double kernel(std::size_t i, long double s) const {
    const Matrix e = exponential(a, s);
    long double sum = 0.0L;
    for (std::size_t j = 0; j < a.size(); ++j) sum += e[i][j] * b[j];
    return sum;
  }

  /// Integral of the kernel over [0, s]: w as one more state does it.
  [[nodiscard]] long double signed_integral(std::size_t i, long double s) const {
    Matrix augmented = a;
    for (std::size_t j = 0; j < a.size(); ++j) augmented[j].push_back(b[j]);
    augmented.emplace_back(a.size() + 1);
    return exponential(augmented, s)[i].back();
  }

  /// Integral of |kernel|, from zero to zero.
  [[nodiscard]] long double absolute_integral(std::size_t i) const {
    constexpr int kPieces = 64;
    long double sum = 0.0L;
    long double start = 0.0L;
    for (int k = 0; k < kPieces; ++k) {
      const long double from = k * (system.tau / static_cast<long double>(kPieces));
      const long double to = (k + 1) * (system.tau / static_cast<long double>(kPieces));
      const bool changes = (kernel(i, from) > 0.0L) != (kernel(i, to) > 0.0L);
      if (!changes && k + 1 < kPieces) continue;
      const long double end = changes ? find_zero(i, from, to) : to;
      sum += std::fabs(signed_integral(i, end) - signed_integral(i, start));
      start = end;
      if (changes && k + 1 == kPieces) sum += std::fabs(signed_integral(i, to) - signed_integral(i, start));
    }
    return sum;
  }

  [[nodiscard]] long double find_zero(std::size_t i, long double from, long double to) const {
    const bool rising = kernel(i, to) > 0.0L;
    for (int n = 0; n < 64; ++n) {
      const long double middle = (from + to) / 2;
      ((kernel(i, middle) > 0.0L) == rising ? to : from) = middle;
    }
    return from;
  }
};

AffineCase random_affine_case() {
  AffineCase result;
  const auto n = static_cast<std::size_t>(1 + pick(3));
  result.a.assign(n, Vector(n));
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < n; ++i) {
    std::string text = "0";
    for (std::size_t j = 0; j < n; ++j) {
      const int quarters = pick(3) == 0 ? 0 : pick(17) - 8;
      result.a[i][j] = quarters / 4.0L;
      if (quarters != 0) text += " + " + std::to_string(quarters) + "/4*" + std::string(kFlowNames[j]);
    }
    result.b.push_back(pick(5) - 2);
    if (result.b[i] != 0.0L) text += " + (" + std::to_string(static_cast<int>(result.b[i])) + ")*w";
    texts.push_back(text);
  }
  result.system = FlowCase(texts);
  for (Interval& slot : result.system.slots) {
    const double lower = pick_between(-2.0, 2.0);
    slot = {lower, lower + pick_between(0.0, 1.0)};
  }
  result.system.tau = pick_between(0.1, 2.0);
  return result;
}

struct Hull {
  long double lower;
  long double upper;
  long double size;  ///< of the numbers that were added
};

Hull exact_hull(const AffineCase& affine, std::size_t i) {
  const Matrix e = exponential(affine.a, affine.system.tau);
  const Interval& w = affine.system.slots[kDisturbanceSlot];
  const long double weight = affine.absolute_integral(i);
  const long double middle_w = (static_cast<long double>(w.lower) + w.upper) / 2;
  long double middle = affine.signed_integral(i, affine.system.tau) * middle_w;
  long double radius = weight * (static_cast<long double>(w.upper) - w.lower) / 2;
  long double size = weight * (std::fabs(w.lower) + std::fabs(w.upper));
  for (std::size_t j = 0; j < e.size(); ++j) {
    const Interval& x = affine.system.slots[j];
    middle += e[i][j] * (static_cast<long double>(x.lower) + x.upper) / 2;
    radius += std::fabs(e[i][j]) * (static_cast<long double>(x.upper) - x.lower) / 2;
    size += std::fabs(e[i][j]) * (std::fabs(x.lower) + std::fabs(x.upper));
  }
  return {middle - radius, middle + radius, size};
}

TEST(AffineFlow, HasItsExactHull) {
  EXPECT_TRUE(rc::check([] {
    const AffineCase random = random_affine_case();
    const FlowEnclosure post = random.system.enclosure();
    RC_ASSERT(post.status == FlowEnclosure::Status::ok);
    for (std::size_t i = 0; i < random.a.size(); ++i) {
      RC_LOG(random.system.equations[i].text + "\n");
      const Hull hull = exact_hull(random, i);
      const long double reference_error = 1e-17L * hull.size;
      const long double rounding = 1e-12L * hull.size;
      RC_ASSERT(post.end[i].lower <= hull.lower + reference_error);
      RC_ASSERT(post.end[i].upper >= hull.upper - reference_error);
      RC_ASSERT(post.end[i].lower >= hull.lower - rounding);
      RC_ASSERT(post.end[i].upper <= hull.upper + rounding);
    }
  }));
}

}  // namespace
}  // namespace coordreq
