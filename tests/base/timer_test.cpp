#include "base/timer.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "base/sanitizers.hpp"

namespace coordreq {
namespace {

TEST(PeakMemory, BeginsAnewFromWhatIsLeft) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers keep memory that was freed";
  if (!std::ofstream("/proc/self/clear_refs")) GTEST_SKIP() << "the system cannot count anew";
  constexpr std::size_t kBytes = std::size_t{256} << 20U;
  const std::uint64_t before = peak_memory_bytes();
  { const std::vector<char> large(kBytes, 'x'); }
  const std::uint64_t with_large = peak_memory_bytes();
  EXPECT_GE(with_large, before + kBytes / 2);
  reset_peak_memory();
  EXPECT_LE(peak_memory_bytes(), with_large - kBytes / 2);
}

}  // namespace
}  // namespace coordreq
