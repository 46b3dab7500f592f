#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "base/zeroed_array.hpp"

namespace coordreq {

/// The index of a store in which equal rows stand in one *slot* together: for each slot the hash of its
/// content, a number for the content, and how many rows stand there. The contents themselves are with the
/// owner of the store.
///
/// Threads: several may call enter(), hold() and drop(), each for rows of its own. The hash says which
/// *shard* knows a content, and each shard has a lock of its own. Everything else is for one thread.
class Interner {
 public:
  /// @param rows so many stand in slots at any time, at most; there are as many slots
  explicit Interner(std::int64_t rows) : slots_(static_cast<std::size_t>(rows)) {}

  /// A row comes to the slot in use with its content, or takes a free one. Nothing is thrown away before a
  /// row drop()s it: what is read of a slot in which a row stands does not change.
  /// @param is_equal whether a slot has that content
  /// @param write writes the content to a slot
  template <class IsEqual, class Write>
  std::uint32_t enter(std::uint64_t hash, const IsEqual& is_equal, const Write& write) {
    Shard& shard = shard_of(hash);
    const std::lock_guard lock(shard.mutex);
    for (std::size_t at = shard.home(hash); shard.table[at] != kNone; at = shard.next(at)) {
      const std::uint32_t slot = shard.table[at];
      if (slots_[slot].hash != hash || !is_equal(slot)) continue;
      hold(slot);
      return slot;
    }
    const std::uint32_t slot = take_free(hash);
    write(slot);
    if (2 * ++shard.used > shard.table.size()) grow(shard);
    insert(shard, slot);
    return slot;
  }
  /// More rows come to a slot in which a row stands that does not leave meanwhile.
  void hold(std::uint32_t slot, std::uint32_t rows = 1) {
    std::atomic_ref(slots_[slot].rows).fetch_add(rows, std::memory_order_relaxed);
  }
  /// A row leaves a slot; when the last one has left it the slot is free.
  void drop(std::uint32_t slot) {
    const std::atomic_ref rows(slots_[slot].rows);
    for (std::uint32_t n = rows.load(std::memory_order_relaxed); n > 1;) {
      if (rows.compare_exchange_weak(n, n - 1, std::memory_order_release, std::memory_order_relaxed)) return;
    }
    Shard& shard = shard_of(slots_[slot].hash);
    {
      const std::lock_guard lock(shard.mutex);
      if (rows.fetch_sub(1, std::memory_order_acq_rel) > 1) return;  // another one has come
      remove(shard, slot);
      --shard.used;
    }
    const std::lock_guard lock(mutex_);
    free_.push_back(slot);
  }

  /// The number of the content of a slot; no other content has had it, or will have it, before renumber().
  [[nodiscard]] std::uint32_t content(std::uint32_t slot) const { return slots_[slot].content; }
  /// Numbers the contents anew, before numbers run out.
  void renumber() {
    for (contents_ = 0; contents_ < used_; ++contents_) slots_[contents_].content = contents_;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr int kShardBits = 6;

  struct Slot {
    std::uint64_t hash;
    std::uint32_t rows;
    std::uint32_t content;
  };
  struct alignas(64) Shard {
    std::mutex mutex;
    std::vector<std::uint32_t> table = std::vector(16, kNone);  ///< slots: open addressing, a power of two
    std::size_t used = 0;

    [[nodiscard]] std::size_t home(std::uint64_t hash) const { return hash & (table.size() - 1); }
    [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (table.size() - 1); }
  };

  /// Within a shard the lower bits of a hash count.
  [[nodiscard]] Shard& shard_of(std::uint64_t hash) { return shards_[hash >> (64 - kShardBits)]; }

  std::uint32_t take_free(std::uint64_t hash) {
    const std::lock_guard lock(mutex_);
    const std::uint32_t slot = free_.empty() ? used_++ : free_.back();
    if (!free_.empty()) free_.pop_back();
    slots_[slot] = {.hash = hash, .rows = 1, .content = contents_++};
    return slot;
  }

  void insert(Shard& shard, std::uint32_t slot) {
    std::size_t at = shard.home(slots_[slot].hash);
    while (shard.table[at] != kNone) at = shard.next(at);
    shard.table[at] = slot;
  }

  /// Entries after the gap move up, unless the gap lies before the entry's home (Knuth, The Art of Computer
  /// Programming, 6.4, Algorithm R).
  void remove(Shard& shard, std::uint32_t slot) {
    std::vector<std::uint32_t>& table = shard.table;
    std::size_t gap = shard.home(slots_[slot].hash);
    while (table[gap] != slot) gap = shard.next(gap);
    for (std::size_t at = shard.next(gap); table[at] != kNone; at = shard.next(at)) {
      const std::size_t begin = shard.home(slots_[table[at]].hash);
      const bool stays = gap < at ? (gap < begin && begin <= at) : (gap < begin || begin <= at);
      if (stays) continue;
      table[gap] = table[at];
      gap = at;
    }
    table[gap] = kNone;
  }

  void grow(Shard& shard) {
    const auto before = std::exchange(shard.table, std::vector(2 * shard.table.size(), kNone));
    for (const std::uint32_t slot : before) {
      if (slot != kNone) insert(shard, slot);
    }
  }

  ZeroedArray<Slot> slots_;
  std::array<Shard, std::size_t{1} << kShardBits> shards_;
  std::mutex mutex_;                 ///< of what follows
  std::vector<std::uint32_t> free_;  ///< slots that have been in use
  std::uint32_t used_ = 0;           ///< slots that have ever been in use
  std::uint32_t contents_ = 0;
};

}  // namespace coordreq
