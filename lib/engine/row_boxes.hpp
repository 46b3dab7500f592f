#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/action_groups.hpp"
#include "engine/row_box.hpp"

namespace coordreq {

/// A range in one word.
[[nodiscard]] inline Word pack_range(IndexRange range) {
  return Word{static_cast<std::uint32_t>(range.first)} | Word{static_cast<std::uint32_t>(range.last)} << 32U;
}
[[nodiscard]] inline IndexRange unpack_range(Word word) {
  return {static_cast<std::int32_t>(word & 0xFFFFFFFFU), static_cast<std::int32_t>(word >> 32U)};
}

/// The posts of a row class by class, where each state's motion depends on the inputs of one class at most:
/// the post of a joint action is then the product of one box for each class, so that boxes of each class are
/// looked at instead of joint actions. The switch is FastPaths::product_posts.
class RowBoxes {
 public:
  enum class Kind : std::uint8_t {
    box,
    gone,     ///< the post has left the domain safely in some dimension
    blocked,  ///< the post leaves through an unsafe side
  };

  /// @pre unchecked: `grouping` outlives this object.
  explicit RowBoxes(const ActionGrouping& grouping);

  /// True if posts are products: no state is moved by two classes, and no tube can block a post.
  [[nodiscard]] bool is_product() const { return is_product_; }

  /// Reads the posts of a row. @returns false if some slice has several segments, or leads all cells of the
  /// row to the same range along it. @pre is_product()
  bool fill(const RowPosition& position, const RowGroups& groups);

  [[nodiscard]] Kind kind(std::size_t c, std::uint32_t g) const { return kinds_[c][g]; }
  /// Ranges of group g in the dimensions that class c moves, in the order of moved(c).
  [[nodiscard]] std::span<const IndexRange> ranges(std::size_t c, std::uint32_t g) const {
    return {ranges_[c].data() + g * moved_[c].size(), moved_[c].size()};
  }
  /// Dimensions that class c moves; dimensions that no class moves count as the first one's.
  [[nodiscard]] const std::vector<std::size_t>& moved(std::size_t c) const { return moved_[c]; }

  /// True if a group of the row leaves for good in some dimension.
  [[nodiscard]] bool has_gone() const { return has_gone_; }

  /// Writes the ranges of class c into a box of all dimensions; as words they are packed by pack_range().
  void put(std::size_t c, std::span<const Word> ranges, RowBox& box) const;
  void put(std::size_t c, std::span<const IndexRange> ranges, RowBox& box) const;
  /// Moves the ranges of class c in a box. @param shift [dimension] in indices
  void move(std::size_t c, std::span<const std::int32_t> shift, RowBox& box) const;

 private:
  bool add(std::size_t c, std::uint32_t action);

  const ActionGrouping& grouping_;
  std::vector<std::vector<std::size_t>> moved_;
  bool is_product_ = true;
  bool has_gone_ = false;
  std::vector<std::int64_t> base_;  ///< by table, of the row
  std::vector<std::vector<Kind>> kinds_;
  std::vector<std::vector<IndexRange>> ranges_;
};

}  // namespace coordreq
