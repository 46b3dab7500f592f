#pragma once

#include <algorithm>

namespace coordreq {

/// Waits a little while for what is about to happen: what threads wait for often comes within microseconds,
/// and waking a thread that sleeps takes longer than that. Then gives up, to leave the core to others; the
/// sooner, the more often it has waited in vain, as where others want the core.
class ShortWait {
 public:
  /// @param least so many times it looks at least
  explicit ShortWait(int least = 1000) : least_(least) {}

  template <class Condition>
  bool comes_soon(const Condition& condition) {
    for (int i = 0; i < looks_; ++i) {
      if (condition()) {
        looks_ = std::min(2 * looks_, kMostLooks);
        return true;
      }
#if defined(__x86_64__)
      __builtin_ia32_pause();
#endif
    }
    looks_ = std::max(looks_ / 2, least_);
    return condition();
  }

 private:
  static constexpr int kMostLooks = 4000;
  int least_;
  int looks_ = kMostLooks;
};

}  // namespace coordreq
