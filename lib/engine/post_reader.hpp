#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/fast_paths.hpp"
#include "base/requires.hpp"
#include "engine/box_reader.hpp"
#include "engine/sum_reader.hpp"

namespace coordreq {

/// The one question that every operator asks, answered for a whole row of cells at once: the least level in
/// f(x, u) for each cell x. 0 where f(x, u) is empty: the post is blocked, or its tube is not safe.
///
/// One object a thread. The levels may change between one enter() and the next, not in between.
template <class Level>
class PostReader {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  /// @pre unchecked: `engine` and `levels` (from engine.make_levels(engine.posts())) outlive this object.
  PostReader(const RowEngine& engine, const LevelRows<Level>& levels);

  PostReader(const PostReader&) = delete;
  PostReader& operator=(const PostReader&) = delete;

  /// Begins with the rows of another unit.
  void enter() {
    boxes_.enter();
    if (sums_) sums_->enter();
  }

  /// The same, with other levels to read from now on.
  void enter(const LevelRows<Level>& levels) {
    boxes_.read(levels);
    if (sums_) sums_->read(levels);
    enter();
  }

  /// For the slices numbered `ids`, one for each of engine.slices(). The row may be read up to the next call;
  /// whole blocks, as LevelKernels ask.
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids) {
    const auto own = ids.first(engine_.tables());
    const Level* levels = posts_->minimum(own);
    return tubes_.empty() ? levels : with_tubes(ids, levels);
  }
  /// In some lanes of the row alone, the first of them first.
  /// @param rest what the rest of their last block holds, unless it holds the minima there
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids, LaneRange lanes, Level rest) {
    return has_bounds() ? sums_->minimum(ids, lanes, rest) : minimum(ids) + lanes.begin;
  }

  /// Takes in several choices of slices, from now on called 0, 1, ...: the same as minimum() of each, but
  /// that the least of several at once may have a bound that costs no more than one of them.
  /// @param ids for each choice as in minimum(), one choice after the other; to be there until the next call
  void take(std::span<const std::uint32_t> ids) {
    taken_ = ids;
    if (has_bounds()) sums_->take(ids);
  }
  [[nodiscard]] const Level* minimum_of(std::size_t choice, LaneRange lanes, Level rest) {
    if (has_bounds()) return sums_->minimum_of(choice, lanes, rest);
    const std::size_t size = engine_.slices().size();
    return minimum(taken_.subspan(choice * size, size)) + lanes.begin;
  }
  /// Levels that are nowhere above those of the choices [begin, end), in some lanes of the row; null: nothing
  /// is known of all of them.
  [[nodiscard]] const Level* bound(std::size_t begin, std::size_t end, LaneRange lanes) {
    return bounds_several_ && has_bounds() ? sums_->bound(begin, end, lanes) : nullptr;
  }
  /// Least levels of the box around all posts of a row. @pre box.covers
  [[nodiscard]] const Level* minimum(const RowBox& box) {
    REQUIRES(box.covers);
    return boxes_.minimum(box, 0, engine_.row_length());
  }
  /// The same for the lanes [begin, end) of the row alone.
  [[nodiscard]] const Level* minimum(const RowBox& box, std::int64_t begin, std::int64_t end) {
    return boxes_.minimum(box, begin, end);
  }

  [[nodiscard]] const LevelKernels<Level>& kernels() const { return boxes_.kernels(); }
  /// A row of this many levels holds the lanes of a row and the rest of its last block.
  [[nodiscard]] std::size_t lanes() const { return boxes_.lanes(); }

 private:
  [[nodiscard]] bool has_bounds() const { return sums_ && tubes_.empty(); }
  [[nodiscard]] const Level* with_tubes(std::span<const std::uint32_t> ids, const Level* levels);

  const RowEngine& engine_;
  BoxReader<Level> boxes_;  ///< around all posts of a row, at least
  std::optional<SumReader<Level>> sums_;
  RowReader<Level>* posts_;  ///< one of these two
  std::vector<BoxReader<std::uint8_t>> tubes_;
  bool bounds_several_ = fast_paths().choice_bounds;
  std::span<const std::uint32_t> taken_;
  std::vector<Word> safe_;
  std::vector<Word> one_;
  std::vector<Level> lanes_;
  std::vector<Level> result_;
};

extern template class PostReader<std::uint8_t>;
extern template class PostReader<std::uint16_t>;
extern template class PostReader<std::uint32_t>;
extern template class PostReader<std::uint64_t>;

}  // namespace coordreq
