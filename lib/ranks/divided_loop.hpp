#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <type_traits>
#include <vector>

#include "base/thread_team.hpp"
#include "ranks/ranks.hpp"

namespace coordreq {

/// Values of an array that are exchanged at a time.
inline constexpr std::int64_t kMostExchanged = std::int64_t{1} << 16U;

/// The indices of [0, count) that a process runs where several divide them; all if there is one.
[[nodiscard]] ThreadTeam::Range divided_range(const Ranks* ranks, std::int64_t count);

/// ThreadTeam::for_each() where each of several processes runs some of the indices. Together: of several
/// exceptions the one of the lowest index is thrown, by the process that has run it; it ends the others.
/// @param ranks null: there is one process
void for_each_divided(Ranks* ranks, ThreadTeam& team, std::int64_t count, std::int64_t grain,
                      const ThreadTeam::Body& body);

/// Together: calls `take(value)` for every value of an array in order, in all processes.
/// @param begin position of the local values; those of all processes make the whole array
template <class Value, class Take>
void exchange_all(Ranks& ranks, std::int64_t count, std::int64_t begin, std::span<const Value> local_values,
                  const Take& take) {
  static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) == sizeof(std::int64_t));
  std::vector<std::int64_t> words(static_cast<std::size_t>(std::min(count, kMostExchanged)));
  for (std::int64_t first = 0; first < count; first += kMostExchanged) {
    const std::int64_t last = std::min(first + kMostExchanged, count);
    const std::int64_t local_first = std::max(first, begin),
                       local_last = std::min(last, begin + std::ssize(local_values));
    std::fill(words.begin(), words.end(), 0);
    if (local_first < local_last)
      std::memcpy(words.data() + (local_first - first), local_values.data() + (local_first - begin),
                  static_cast<std::size_t>(local_last - local_first) * sizeof(Value));
    ranks.add(std::span(words).first(static_cast<std::size_t>(last - first)));  // all but one are 0
    for (std::int64_t i = 0; i < last - first; ++i) {
      Value value;
      std::memcpy(static_cast<void*>(&value), &words[static_cast<std::size_t>(i)], sizeof(Value));
      take(value);
    }
  }
}

/// Together: gives all processes what each has put into its segment of an array of which the rest is 0.
template <class Value>
void join_segments(Ranks* ranks, std::span<Value> values) {
  static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) == sizeof(std::int64_t));
  constexpr auto kMost = static_cast<std::size_t>(kMostExchanged);
  if (ranks == nullptr) return;
  std::vector<std::int64_t> words(std::min(values.size(), kMost));
  for (std::size_t begin = 0; begin < values.size(); begin += kMost) {
    const std::size_t count = std::min(kMost, values.size() - begin);
    std::memcpy(words.data(), values.data() + begin, count * sizeof(Value));
    ranks->add(std::span(words).first(count));  // all but one are 0
    std::memcpy(static_cast<void*>(values.data() + begin), words.data(), count * sizeof(Value));
  }
}

}  // namespace coordreq
