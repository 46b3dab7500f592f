#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/fast_paths.hpp"
#include "base/requires.hpp"
#include "base/thread_team.hpp"
#include "engine/box_reader.hpp"
#include "engine/limits.hpp"
#include "engine/sum_reader.hpp"

namespace coordreq {

/// The one question that every operator asks, answered for a whole row of cells at once: the least level in
/// f(x, u) for each cell x. 0 where f(x, u) is empty: the post is blocked, or its tube is not safe.
///
/// Tables come in two forms, each with a reader of its own: BoxReader for rows that are cut into segments,
/// and SumReader for rows that are added up.
///
/// Threads: one object a thread, each a copy of the first; so they share what SumReader keeps of a unit.
///
/// 1. From one enter() to the next the levels do not change, and all rows asked about are of one unit:
///    minima that its rows share are kept until then.
/// 2. A row that is returned is valid until the next call.
/// 3. minimum() of the box around all posts of a row, and bound(), are nowhere above minimum() of any
///    choice that they stand for.
template <class Level>
class PostReader {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;
  /// @pre unchecked: `engine` and `levels` (from engine.make_levels(engine.posts())) outlive this object.
  PostReader(const RowEngine& engine, const LevelRows<Level>& levels);
  /// A reader for another thread, in no unit yet.
  PostReader(const PostReader& other);
  PostReader& operator=(const PostReader&) = delete;
  ~PostReader() = default;

  /// Goes to the unit of a row: queries from now on are about its rows.
  void enter(std::int64_t row) { enter(row, *levels_); }

  /// Goes to the unit of a row, and reads other levels of the same layout from now on.
  void enter(std::int64_t row, const LevelRows<Level>& levels) {
    const std::int64_t unit = row / engine_.unit_rows();
    if (unit == unit_ && &levels == levels_ && epoch_ == common_->epoch) return;
    unit_ = unit;
    levels_ = &levels;
    epoch_ = common_->epoch;
    boxes_.enter(levels);
    if (sums_) sums_->enter(unit, levels);
  }

  /// From now on only these lanes of rows are asked about, where posts are cut: what stands in others means
  /// nothing.
  void set_lanes(LaneRange lanes) { boxes_.set_lanes(lanes); }

  /// Levels may be others from now on: this reader and its copies forget what they keep of units, until they
  /// enter one. For one thread, while no other reads.
  void forget() const;

  /// The number of units for so many threads to be in at once, with enough rows for all: few, where patches
  /// are kept of them.
  [[nodiscard]] std::int64_t units_at_once(int threads) const {
    const bool keeps_patches = sums_ && threads > 1;
    return keeps_patches ? coordreq::units_at_once(threads, engine_.unit_rows()) : engine_.rows();
  }
  /// Calls `body(range, worker)` for ranges of rows that together are all local rows, each thread with a copy
  /// of this reader, for units_at_once() at a time.
  void for_each_local_row(ThreadTeam& team, const ThreadTeam::Body& body) const;

  /// Least levels of the posts given by the numbers of their slices, one for each of engine.slices(). Whole
  /// blocks may be read, as LevelKernels ask.
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids) {
    const auto of_posts = ids.first(engine_.tables());
    const Level* levels = sums_ ? sums_->minimum(of_posts) : boxes_.minimum(of_posts);
    return tubes_.empty() ? levels : with_tubes(ids, levels);
  }
  /// minimum() in some lanes of the row alone; the first of these lanes comes first.
  /// @param rest the level in the rest of their last block, unless the minima stand there
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids, LaneRange lanes, Level rest) {
    return has_bounds() ? sums_->minimum(ids, lanes, rest) : minimum(ids) + lanes.begin;
  }

  /// Takes several choices of slices for a row, numbered 0, 1, ... in minimum_of() and bound(): several of
  /// them may have a bound together that costs no more than the minimum of one.
  /// @param ids for each choice as in minimum(), one choice after the other; valid until the next take()
  void take(std::span<const std::uint32_t> ids) {
    choices_ = ids;
    if (has_bounds()) sums_->take(ids);
  }
  /// minimum() of one of these choices.
  [[nodiscard]] const Level* minimum_of(std::size_t choice, LaneRange lanes, Level rest) {
    if (has_bounds()) return sums_->minimum_of(choice, lanes, rest);
    const std::size_t size = engine_.slices().size();
    return minimum(choices_.subspan(choice * size, size)) + lanes.begin;
  }
  /// Levels that are nowhere above the minima of the choices [begin, end), in some lanes of the row; null:
  /// there is no such bound. The switch is FastPaths::choice_bounds; see SumReader.
  [[nodiscard]] const Level* bound(std::size_t begin, std::size_t end, LaneRange lanes) {
    return bounds_several_ && has_bounds() ? sums_->bound(begin, end, lanes) : nullptr;
  }
  /// Least levels of a box of cells. @pre unchecked: it lies inside the domain or its margins
  [[nodiscard]] const Level* minimum(const RowBox& box) {
    return boxes_.minimum(box, 0, engine_.row_length());
  }
  /// minimum() for the lanes [begin, end) of the row alone.
  [[nodiscard]] const Level* minimum(const RowBox& box, std::int64_t begin, std::int64_t end) {
    return boxes_.minimum(box, begin, end);
  }

  [[nodiscard]] const LevelKernels<Level>& kernels() const { return boxes_.kernels(); }
  /// A row of this many levels holds the lanes of a row and the rest of its last block.
  [[nodiscard]] std::size_t lanes() const { return boxes_.lanes(); }

 private:
  [[nodiscard]] bool has_bounds() const { return sums_ && tubes_.empty(); }
  [[nodiscard]] const Level* with_tubes(std::span<const std::uint32_t> ids, const Level* levels);

  /// What a reader has in common with its copies.
  struct Common {
    explicit Common(const RowEngine& engine);
    std::uint64_t epoch = 0;                     ///< begins anew when levels may be others
    std::shared_ptr<SumPatches<Level>> patches;  ///< null: posts are cut
  };
  PostReader(const RowEngine& engine, const LevelRows<Level>& levels, std::shared_ptr<Common> common);

  const RowEngine& engine_;
  const LevelRows<Level>* levels_;
  std::shared_ptr<Common> common_;
  std::int64_t unit_ = -1;  ///< that it is in
  std::uint64_t epoch_ = 0;
  BoxReader<Level> boxes_;  ///< reads posts if they are cut, and the box around all posts of a row
  std::optional<SumReader<Level>> sums_;        ///< reads posts if they are added up
  std::vector<BoxReader<std::uint8_t>> tubes_;  ///< [demand]
  bool bounds_several_ = fast_paths().choice_bounds;
  std::span<const std::uint32_t> choices_;
  std::vector<Word> safe_;  ///< lanes whose tube is inside the set of some demand
  std::vector<Word> one_;   ///< lanes whose tube is inside the set of one demand
  std::vector<Level> lanes_;
  std::vector<Level> result_;
};

extern template class PostReader<std::uint8_t>;
extern template class PostReader<std::uint16_t>;
extern template class PostReader<std::uint32_t>;
extern template class PostReader<std::uint64_t>;

}  // namespace coordreq
