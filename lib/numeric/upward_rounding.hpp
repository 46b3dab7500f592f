#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace coordreq {

/// While it lives its thread rounds in one direction; then as before, whichever way the scope is left. For
/// arithmetic on doubles alone: see with_rounding().
class RoundingGuard {
 public:
  enum class Direction { nearest, upward };

  explicit RoundingGuard(Direction direction) : before_(get()) {
    set(direction == Direction::upward ? upward(before_) : nearest(before_));
  }
  ~RoundingGuard() { set(before_); }
  RoundingGuard(const RoundingGuard&) = delete;
  RoundingGuard& operator=(const RoundingGuard&) = delete;

 private:
#if defined(__SSE2__)
  // The register of SSE alone, which is what doubles are computed with; setting that of the x87 too takes
  // several times as long.
  using Mode = unsigned;
  static constexpr Mode kDirections = 0x6000;
  static Mode get() {
    return _mm_getcsr();
  }
  static void set(Mode mode) {
    _mm_setcsr(mode);
  }
  static Mode nearest(Mode before) {
    return before & ~kDirections;
  }
  static Mode upward(Mode before) {
    return (before & ~kDirections) | 0x4000U;
  }
#else
  using Mode = int;
  static Mode get() {
    return std::fegetround();
  }
  static void set(Mode mode) {
    std::fesetround(mode);
  }
  static Mode nearest(Mode) {
    return FE_TONEAREST;
  }
  static Mode upward(Mode) {
    return FE_UPWARD;
  }
#endif

  Mode before_;
};

namespace rounding {
/// A function of its own, which no arithmetic gets out of: compilers know nothing of the register that is set
/// before and after it, but order memory and calls.
template <class Work>
[[gnu::noinline]] void run(Work& work) {
  asm volatile("" : : "r"(&work) : "memory");
  work();
  asm volatile("" : : : "memory");
}
}  // namespace rounding

/// Runs `work()` while its thread rounds in this direction. Arguments and results are what it refers to. It
/// must not call functions of a library that compute with doubles, nor Interval's operations: these rely on
/// rounding to nearest.
template <class Work>
void with_rounding(RoundingGuard::Direction direction, Work work) {
  const RoundingGuard guard(direction);
  rounding::run(work);
}
template <class Work>
void rounded_upward(Work work) {
  with_rounding(RoundingGuard::Direction::upward, work);
}
/// For what relies on rounding to nearest within rounded_upward().
template <class Work>
void rounded_to_nearest(Work work) {
  with_rounding(RoundingGuard::Direction::nearest, work);
}

}  // namespace coordreq
