#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace coordreq {

/// A hash with one more number mixed in.
[[nodiscard]] inline std::uint64_t mixed_hash(std::uint64_t hash, std::uint64_t number) {
  hash = (hash ^ number) * 0x9E3779B97F4A7C15U;
  return hash ^ hash >> 32U;
}

/// Interns lists of numbers: each different list is held once; lists are numbered 0, 1, ... in the order in
/// which they first came. Lists are compared, not their hashes alone.
template <class Number>
class ListNumbers {
 public:
  using List = std::span<const Number>;

  ListNumbers() : slots_(64, kFree) {}

  [[nodiscard]] static std::uint64_t hash_of(List list) {
    std::uint64_t hash = list.size();
    for (const Number number : list) hash = mixed_hash(hash, number);
    return hash;
  }

  /// The number of a list.
  std::uint32_t number(List list) { return number(list, hash_of(list)); }
  /// @param hash hash_of(list)
  std::uint32_t number(List list, std::uint64_t hash) {
    std::size_t slot = hash & (slots_.size() - 1);
    for (; slots_[slot] != kFree; slot = (slot + 1) & (slots_.size() - 1)) {
      const std::uint32_t known = slots_[slot];
      if (hashes_[known] == hash && std::ranges::equal((*this)[known], list)) return known;
    }
    const std::uint32_t added = size();
    slots_[slot] = added;
    hashes_.push_back(hash);
    numbers_.insert(numbers_.end(), list.begin(), list.end());
    ends_.push_back(numbers_.size());
    if (2 * std::size_t{size()} > slots_.size()) grow();
    return added;
  }
  [[nodiscard]] List operator[](std::uint32_t number) const {
    const std::size_t begin = number == 0 ? 0 : ends_[number - 1];
    return {numbers_.data() + begin, ends_[number] - begin};
  }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(ends_.size()); }

  /// Forgets all lists, and keeps the memory.
  void clear() {
    numbers_.clear();
    ends_.clear();
    hashes_.clear();
    std::fill(slots_.begin(), slots_.end(), kFree);
  }

 private:
  static constexpr std::uint32_t kFree = UINT32_MAX;

  void grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::uint32_t n = 0; n < size(); ++n) {
      std::size_t slot = hashes_[n] & (slots_.size() - 1);
      while (slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = n;
    }
  }

  std::vector<Number> numbers_;  ///< of all lists, one after the other
  std::vector<std::size_t> ends_;
  std::vector<std::uint64_t> hashes_;
  std::vector<std::uint32_t> slots_;  ///< open addressing, a power of two
};

}  // namespace coordreq
