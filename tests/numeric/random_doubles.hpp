#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

#include "numeric/interval.hpp"

namespace coordreq {

/// Doubles and intervals that provoke rounding: moderate, tiny, huge, subnormal, integers, neighbours of
/// multiples of a quarter turn and the ends of the range. Seeded, so every run sees the same, unless the
/// environment variable COORDREQ_ATTACK asks for others (scripts/attack).
class RandomDoubles {
 public:
  explicit RandomDoubles(std::uint64_t seed) : engine_(seed + (attack() << 8U)) {}

  [[nodiscard]] double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  [[nodiscard]] int integer(int lower, int upper) {
    return std::uniform_int_distribution<int>(lower, upper)(engine_);
  }

  /// A finite double.
  [[nodiscard]] double any() {
    constexpr double kQuarterTurn = 1.5707963267948966;
    switch (integer(0, 9)) {
      case 0:
        return finite_bits();
      case 1:
        return integer(-20, 20) / 4.0;
      case 2:
        return outward::moved(integer(-40, 40) * kQuarterTurn, integer(-3, 3));
      case 3:
        return outward::moved(0.0, integer(-1000, 1000));
      case 4:
        return outward::moved(integer(0, 1) == 0 ? 1.0 : -1.0, integer(-3, 3));
      case 5:
        return std::ldexp(uniform(-1.0, 1.0), integer(-1080, 1023));
      case 6:
        return outward::moved(integer(0, 1) == 0 ? outward::kLargest : -outward::kLargest, 0);
      case 7:
        return uniform(-1.0, 1.0);
      default:
        return uniform(-12.0, 12.0);
    }
  }

  /// An interval around finite doubles, now and then with an infinite end.
  [[nodiscard]] Interval interval() {
    const double a = any();
    const double b = integer(0, 2) == 0 ? outward::moved(a, integer(0, 20)) : any();
    Interval result{std::min(a, b), std::max(a, b)};
    if (result.upper == outward::kInfinity) result.upper = outward::kLargest;
    if (integer(0, 40) == 0) result.lower = -outward::kInfinity;
    if (integer(0, 40) == 0) result.upper = outward::kInfinity;
    return result;
  }

  /// A finite double of the interval, often an end.
  [[nodiscard]] double within(const Interval& a) {
    const double lower = std::max(a.lower, -outward::kLargest);
    const double upper = std::min(a.upper, outward::kLargest);
    switch (integer(0, 4)) {
      case 0:
        return lower;
      case 1:
        return upper;
      case 2:
        return std::clamp(any(), lower, upper);
      case 3:
        return std::clamp(outward::moved(lower, integer(0, 20)), lower, upper);
      default:
        return std::clamp(lower + uniform(0.0, 1.0) * (upper - lower), lower, upper);
    }
  }

 private:
  static std::uint64_t attack() {
    const char* text = std::getenv("COORDREQ_ATTACK");
    return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
  }

  double finite_bits() {
    while (true) {
      const double value = std::bit_cast<double>(engine_());
      if (std::isfinite(value)) return value;
    }
  }

  std::mt19937_64 engine_;
};

}  // namespace coordreq
