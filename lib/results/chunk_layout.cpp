#include "results/chunk_layout.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
namespace {

constexpr std::uint64_t kContiguousBytes = 16 * 1024;
constexpr std::uint64_t kSmallestChunkBytes = 64 * 1024;
constexpr std::uint64_t kLargestChunkBytes = 1024 * 1024;
constexpr std::uint64_t kWantedChunks = 16;

std::uint64_t product(std::vector<std::uint64_t>::const_iterator begin,
                      std::vector<std::uint64_t>::const_iterator end) {
  return std::accumulate(begin, end, std::uint64_t{1}, std::multiplies<>());
}

std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) {
  return a / b + (a % b != 0 ? 1 : 0);
}

}  // namespace

ChunkLayout::ChunkLayout(std::vector<std::uint64_t> shape, std::size_t element_size)
    : shape_(std::move(shape)), elements_(product(shape_.begin(), shape_.end())) {
  const std::uint64_t bytes = elements_ * element_size;
  if (bytes <= kContiguousBytes) return;
  const auto target = static_cast<std::uint64_t>(largest_chunk(static_cast<double>(bytes))) / element_size;

  cut_ = shape_.size() - 1;
  while (cut_ > 0 && inner_ * shape_[cut_] <= target) inner_ *= shape_[cut_--];
  const std::uint64_t longest = std::max<std::uint64_t>(1, target / inner_);
  segments_ = divide_up(shape_[cut_], longest);

  chunk_shape_ = shape_;
  std::fill_n(chunk_shape_.begin(), cut_, 1);
  chunk_shape_[cut_] = divide_up(shape_[cut_], segments_);  // even segments waste little padding
  segments_ = divide_up(shape_[cut_], chunk_shape_[cut_]);
}

double ChunkLayout::largest_chunk(double bytes) {
  if (bytes <= static_cast<double>(kContiguousBytes)) return 0;
  return std::clamp(bytes / static_cast<double>(kWantedChunks), static_cast<double>(kSmallestChunkBytes),
                    static_cast<double>(kLargestChunkBytes));
}

std::uint64_t ChunkLayout::chunk_elements() const {
  REQUIRES(chunked());
  return chunk_shape_[cut_] * inner_;
}

std::uint64_t ChunkLayout::chunk_count() const {
  return product(shape_.begin(), shape_.begin() + static_cast<std::ptrdiff_t>(cut_)) * segments_;
}

ChunkLayout::Segment ChunkLayout::segment(std::uint64_t number) const {
  REQUIRES(number < chunk_count());
  const std::uint64_t length = shape_[cut_];
  const std::uint64_t first = number % segments_ * chunk_shape_[cut_];
  std::uint64_t slab = number / segments_;

  Segment result;
  result.begin = (slab * length + first) * inner_;
  result.count = std::min(chunk_shape_[cut_], length - first) * inner_;
  result.offset.assign(shape_.size(), 0);
  result.offset[cut_] = first;
  for (std::size_t i = cut_; i-- > 0;) {
    result.offset[i] = slab % shape_[i];
    slab /= shape_[i];
  }
  return result;
}

}  // namespace coordreq
