#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace coordreq {

/// Joint inputs by cell, in a bounded memory: the cells of a run come again and again. One object a thread.
class KeptInputs {
 public:
  using Numbers = std::vector<std::int64_t>;
  /// Memory of one object. What is kept is forgotten, all at once, before it takes more.
  static constexpr std::size_t kMostBytes = std::size_t{4} << 20U;
  static constexpr std::size_t kBytesOfList = 96;  ///< a node of the table, and the list itself

  /// Null if nothing is kept for the cell.
  [[nodiscard]] const Numbers* find(std::int64_t cell) const {
    const auto found = lists_.find(cell);
    return found == lists_.end() ? nullptr : &found->second;
  }

  /// @returns the kept list, valid until the next call
  const Numbers& keep(std::int64_t cell, Numbers numbers) {
    const std::size_t bytes = kBytesOfList + numbers.size() * sizeof(std::int64_t);
    if (bytes_ + bytes > kMostBytes) {
      lists_.clear();
      bytes_ = 0;
    }
    bytes_ += bytes;
    return lists_.insert_or_assign(cell, std::move(numbers)).first->second;
  }

 private:
  std::unordered_map<std::int64_t, Numbers> lists_;
  std::size_t bytes_ = 0;
};

}  // namespace coordreq
