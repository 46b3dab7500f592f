#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "engine/list_numbers.hpp"

namespace coordreq {

/// ListNumbers for several threads: equal lists have equal numbers, but which ones depends on who comes
/// first. The hash says which *shard* knows a list, and each shard has a lock of its own.
class SharedListNumbers {
 public:
  using Lists = ListNumbers<std::uint32_t>;

  /// The number of a list. @param note called with it while no other thread can ask about an equal list
  template <class Note>
  std::uint32_t number(Lists::List list, const Note& note) {
    const std::uint64_t hash = Lists::hash_of(list);
    const std::size_t at = hash >> (64 - kBits);  // within a shard the lower bits count
    Shard& shard = shards_[at];
    const std::lock_guard lock(shard.mutex);
    const std::uint32_t in_shard = shard.lists.number(list, hash);
    note(at, in_shard);
    return in_shard << kBits | static_cast<std::uint32_t>(at);
  }
  std::uint32_t number(Lists::List list) {
    return number(list, [](std::size_t, std::uint32_t) {});
  }

  /// A number is that of a shard, below kShards, and one within it.
  static constexpr int kBits = 6;
  static constexpr std::size_t kShards = std::size_t{1} << kBits;
  [[nodiscard]] static std::size_t shard_of(std::uint32_t number) { return number & (kShards - 1); }
  [[nodiscard]] static std::uint32_t in_shard(std::uint32_t number) { return number >> kBits; }

  /// Forgets all lists, and keeps the memory.
  void clear() {
    for (Shard& shard : shards_) shard.lists.clear();
  }

 private:
  struct alignas(64) Shard {
    std::mutex mutex;
    Lists lists;
  };
  std::array<Shard, kShards> shards_;
};

}  // namespace coordreq
