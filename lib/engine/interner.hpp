#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace coordreq {

/// The index of a store in which equal rows stand in one *slot* together: for each slot the hash of its
/// content, a number for the content, and how many rows stand there. The contents themselves are with the
/// owner of the store.
class Interner {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  Interner() : table_(64, kNone) {}

  /// The slot in use with a content, or kNone. @param is_equal whether a slot has that content
  template <class IsEqual>
  [[nodiscard]] std::uint32_t find(std::uint64_t hash, const IsEqual& is_equal) const {
    for (std::size_t at = home(hash); table_[at] != kNone; at = next(at)) {
      if (slots_[table_[at]].hash == hash && is_equal(table_[at])) return table_[at];
    }
    return kNone;
  }
  /// Whether a slot still has the content of this number.
  [[nodiscard]] bool has(std::uint32_t slot, std::uint32_t content) const {
    return slots_[slot].rows > 0 && slots_[slot].content == content;
  }
  /// A slot for a content that no slot has; one row stands in it.
  std::uint32_t add(std::uint64_t hash) {
    if (2 * ++used_ > table_.size()) grow();
    auto slot = static_cast<std::uint32_t>(slots_.size());
    if (free_.empty()) {
      slots_.emplace_back();
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    slots_[slot] = {.hash = hash, .rows = 1, .content = contents_++};
    enter(slot);
    return slot;
  }
  /// More rows stand in a slot.
  void hold(std::uint32_t slot, std::int64_t rows = 1) { slots_[slot].rows += rows; }
  /// A row leaves a slot; when the last one has left it the slot is free.
  void drop(std::uint32_t slot) {
    if (--slots_[slot].rows > 0) return;
    remove(slot);
    free_.push_back(slot);
    --used_;
  }

  /// Number of slots that have ever been in use; and of rows in one of them.
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] std::int64_t rows(std::size_t slot) const { return slots_[slot].rows; }
  /// The number of the content of a slot; no other content has had it, or will have it, before renumber().
  [[nodiscard]] std::uint32_t content(std::uint32_t slot) const { return slots_[slot].content; }
  /// Numbers the contents anew, before numbers run out.
  void renumber() {
    contents_ = 0;
    for (Slot& slot : slots_) slot.content = contents_++;
  }

 private:
  struct Slot {
    std::uint64_t hash = 0;
    std::int64_t rows = 0;
    std::uint32_t content = 0;
  };

  [[nodiscard]] std::size_t home(std::uint64_t hash) const { return hash & (table_.size() - 1); }
  [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (table_.size() - 1); }

  void enter(std::uint32_t slot) {
    std::size_t at = home(slots_[slot].hash);
    while (table_[at] != kNone) at = next(at);
    table_[at] = slot;
  }

  /// Entries after the gap move up, unless the gap lies before the entry's home (Knuth, The Art of Computer
  /// Programming, 6.4, Algorithm R).
  void remove(std::uint32_t slot) {
    std::size_t gap = home(slots_[slot].hash);
    while (table_[gap] != slot) gap = next(gap);
    for (std::size_t at = next(gap); table_[at] != kNone; at = next(at)) {
      const std::size_t begin = home(slots_[table_[at]].hash);
      const bool stays = gap < at ? (gap < begin && begin <= at) : (gap < begin || begin <= at);
      if (stays) continue;
      table_[gap] = table_[at];
      gap = at;
    }
    table_[gap] = kNone;
  }

  void grow() {
    table_.assign(2 * table_.size(), kNone);
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
      if (slots_[slot].rows > 0) enter(slot);
    }
  }

  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> table_;  ///< slots by hash: open addressing, a power of two
  std::size_t used_ = 0;
  std::uint32_t contents_ = 0;
};

}  // namespace coordreq
