#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "model/input_space.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// A raw range after the rules for leaving the domain (contract, "Leaving the domain").
[[nodiscard]] ResolvedRange after_leaving(IndexRange raw, const GridDimension& dimension);

/// f(x, u) for every pair: one table a state, its ranges resolved. Immutable.
struct Posts {
  const UniformGrid* grid = nullptr;
  std::int64_t joint_inputs = 0;
  std::vector<const PostTable*> tables;
  std::vector<std::vector<ResolvedRange>> resolved;  ///< [state][entry]
  std::vector<std::vector<std::int32_t>>
      input_offset;                         ///< [state][u] entry, counted from the first entry of the cell
  std::vector<std::int64_t> input_choices;  ///< [state]: entries of one cell
};
/// @pre unchecked: `grid` and `tables` outlive the result.
[[nodiscard]] Posts make_posts(const UniformGrid& grid, const InputSpace& inputs,
                               const std::vector<PostTable>& tables);

/// The posts of one cell at a time. Many posts are the same box, or share the ranges of the last dimensions,
/// so that minima over boxes, and over ranges of the last dimensions, are remembered, in memory that the
/// caller keeps. One object a thread.
class PostMinima {
 public:
  /// No more minima than these are remembered for one cell.
  static constexpr std::int64_t kMostMinima = 1 << 18;
  static constexpr std::int32_t kNotKnown = INT32_MIN;

  explicit PostMinima(const Posts& posts);

  void go_to(std::int64_t cell);
  /// Number of minima that are remembered.
  [[nodiscard]] std::size_t memory_size() const { return static_cast<std::size_t>(boxes_ + minima_); }
  /// Minima requested and cells looked at for them, so far: a measure of the work.
  [[nodiscard]] std::int64_t looked_at() const { return looked_at_; }
  /// min over y in f(x, u) of values[y]; `forever` if the post has left safely, `blocked` if there is none.
  /// @param values over all cells
  /// @param memory memory_size() minima of this cell and these values, kNotKnown before the first call
  template <class Value>
  [[nodiscard]] std::int32_t least(std::int64_t u, const std::vector<Value>& values, std::int32_t blocked,
                                   std::int32_t forever, std::vector<std::int32_t>& memory) {
    std::int64_t box = 0;
    ++looked_at_;
    for (std::size_t i = 0; i < ranks_.size(); ++i) {
      const std::int64_t rank =
          ranks_[i][static_cast<std::size_t>((*input_offset_)[i][static_cast<std::size_t>(u)])];
      box_[i] = &different_[i][static_cast<std::size_t>(rank)];
      box = box * static_cast<std::int64_t>(different_[i].size()) + rank;
    }
    if (boxes_ == 0) return compute(box, values.data(), blocked, forever, memory);
    std::int32_t& known = memory[static_cast<std::size_t>(box)];
    if (known == kNotKnown) known = compute(box, values.data(), blocked, forever, memory);
    return known;
  }

 private:
  void find_ranges(std::size_t i, std::int64_t cell);

  template <class Value>
  [[nodiscard]] std::int32_t compute(std::int64_t box, const Value* values, std::int32_t blocked,
                                     std::int32_t forever, std::vector<std::int32_t>& memory) {
    bool gone = false;
    for (const ResolvedRange* range : box_) {
      if (range->blocked) return blocked;
      gone = gone || range->all_left();
    }
    return gone ? forever : least_from(0, 0, 0, box % inner_boxes_, values, forever, memory);
  }

  /// Minimum over the ranges of dimensions i, i + 1, ... at one choice of indices in the dimensions before.
  /// @param window number of that choice, within the ranges of all posts
  template <class Value>
  [[nodiscard]] std::int32_t least_from(std::size_t i, std::int64_t cell, std::int64_t window,
                                        std::int64_t inner_box, const Value* values, std::int32_t forever,
                                        std::vector<std::int32_t>& memory) {
    if (i != split_ || minima_ == 0) return find_least(i, cell, window, inner_box, values, forever, memory);
    std::int32_t& known = memory[static_cast<std::size_t>(boxes_ + window * inner_boxes_ + inner_box)];
    if (known == kNotKnown) known = find_least(i, cell, window, inner_box, values, forever, memory);
    return known;
  }

  template <class Value>
  [[nodiscard]] std::int32_t find_least(std::size_t i, std::int64_t cell, std::int64_t window,
                                        std::int64_t inner_box, const Value* values, std::int32_t forever,
                                        std::vector<std::int32_t>& memory) {
    const GridDimension& dimension = (*grid_)[i];
    const IndexRange range = box_[i]->inside;
    std::int32_t least = forever;
    looked_at_ += range.last - range.first + 1;
    for (std::int64_t k = range.first; k <= range.last; ++k) {
      const std::int64_t next = cell + (k < dimension.count ? k : k - dimension.count) * grid_->stride(i);
      const std::int64_t position =
          window * (window_[i].last - window_[i].first + 1) + (k - window_[i].first);
      const std::int32_t value = i + 1 == box_.size()
                                     ? values[next]
                                     : least_from(i + 1, next, position, inner_box, values, forever, memory);
      least = std::min(least, value);
    }
    return least;
  }

  const Posts* posts_;
  const UniformGrid* grid_;
  const std::vector<std::vector<std::int32_t>>* input_offset_;
  std::size_t split_;  ///< minima over the dimensions from here on are remembered
  std::vector<std::vector<ResolvedRange>> different_;  ///< [state] the different ranges of this cell
  std::vector<std::vector<std::int64_t>> ranks_;  ///< [state][choice of its inputs] index into different_
  std::vector<IndexRange> window_;                ///< [state] a range around all of different_
  std::vector<const ResolvedRange*> box_;
  std::int64_t inner_boxes_ = 1;
  std::int64_t boxes_ = 0;  ///< remembered boxes; 0: too many
  std::int64_t looked_at_ = 0;
  std::int64_t minima_ = 0;  ///< remembered minima over the last dimensions; 0: too many
};

}  // namespace coordreq
