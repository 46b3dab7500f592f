#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "base/thread_team.hpp"
#include "ranks/ranks.hpp"

namespace coordreq {

/// ThreadTeam::for_each() where each of several processes runs a part of the indices. Together: of several
/// exceptions the one of the lowest index is thrown, by the process that has run it; it ends the others.
/// @param ranks null: there is one process
void for_each_divided(Ranks* ranks, ThreadTeam& team, std::int64_t count, std::int64_t grain,
                      const ThreadTeam::Body& body);

/// Together: tells all processes what each has put into its part of an array of which the rest is 0.
template <class Value>
void join_parts(Ranks* ranks, std::span<Value> values) {
  static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) == sizeof(std::int64_t));
  constexpr std::size_t kAtATime = std::size_t{1} << 16U;
  if (ranks == nullptr) return;
  std::vector<std::int64_t> words(std::min(values.size(), kAtATime));
  for (std::size_t begin = 0; begin < values.size(); begin += kAtATime) {
    const std::size_t count = std::min(kAtATime, values.size() - begin);
    std::memcpy(words.data(), values.data() + begin, count * sizeof(Value));
    ranks->add(std::span(words).first(count));  // all but one are 0
    std::memcpy(static_cast<void*>(values.data() + begin), words.data(), count * sizeof(Value));
  }
}

}  // namespace coordreq
