#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "base/requires.hpp"
#include "base/thread_team.hpp"
#include "base/zeroed_array.hpp"
#include "engine/cell_set.hpp"
#include "engine/interner.hpp"
#include "engine/level_kernels.hpp"
#include "engine/limits.hpp"
#include "engine/list_numbers.hpp"
#include "engine/row_shape.hpp"
#include "ranks/row_share.hpp"

namespace coordreq {

/// One level a cell, in rows, each continued beyond its ends, and the ends of the runs in it, by the levels
/// that a post meets there.
///
/// A level says how long a cell stays in a decreasing sequence of sets: 0 outside the first of them, i if it
/// is in the first i, and `kTop` if it is never lost (as far as is known). Min and max over levels are AND
/// and OR over all sets of the sequence at once.
///
/// Rows that are equal may be *interned*: held once, in a *slot*. Memory is reserved for all rows all the
/// same, but the system gives only pages that are written. Where several processes share the work each has
/// the rows of all of them, of which only those that it holds mean something and take memory (RowShare).
///
/// Threads: any number may read while no thread writes. Different threads may write different rows; interned
/// rows are written by one thread at a time, which may share fill_placed() with others. make_ready() reads.
///
/// 1. A row that was written is *closed*: its margins and gaps follow from its cells. Interned rows are
///    closed from the start.
/// 2. Interned rows are equal exactly if they stand in the same slot.
/// 3. A slot in which rows stand is not written: a row that changes moves to another one. So row(r) is
///    valid until row r is written.
/// 4. The stride is a multiple of 16 bytes, and from any lane of a row a whole block (kLevelBlock bytes)
///    may be read.
template <class Level>
class LevelRows {
 public:
  static constexpr Level kTop = std::numeric_limits<Level>::max();

  LevelRows() = default;
  LevelRows(std::int64_t rows, std::int64_t row_length, RowMargins margins, RowEnds ends)
      : LevelRows(rows, {{{row_length, 1, margins, ends}}}) {}
  /// All levels 0. @param interned whether equal rows are held once; then they are closed
  /// @param share which rows are whose; null: there is one process. @pre unchecked: it outlives this object
  LevelRows(std::int64_t rows, RowShape shape, bool interned = false, const RowShare* share = nullptr)
      : rows_(rows),
        share_(share),
        shape_(std::move(shape)),
        length_(shape_.length()),
        margins_(shape_.margins()) {
    constexpr std::int64_t kAlign = 16 / static_cast<std::int64_t>(sizeof(Level));
    stride_ = (margins_.before + length_ + margins_.after + kAlign - 1) / kAlign * kAlign;
    // One slot more than rows: a row that is put takes a new slot before it leaves its old one.
    const auto size = static_cast<std::size_t>((rows + 1) * stride_) + kLevelBlock / sizeof(Level);
    levels_ = ZeroedArray<Level>(size);
    if (!interned || rows == 0) return;
    lanes_.assign(static_cast<std::size_t>(stride_), 0);
    Level* const first = levels_.data() + margins_.before;
    close_row(first);
    slots_.assign(static_cast<std::size_t>(rows), interner_.add(hash_of(first)));
    interner_.hold(0, rows - 1);
  }

  LevelRows(LevelRows&&) noexcept = default;
  LevelRows& operator=(LevelRows&&) noexcept = default;
  LevelRows(const LevelRows&) = delete;
  LevelRows& operator=(const LevelRows&) = delete;
  ~LevelRows() = default;

  [[nodiscard]] std::int64_t rows() const { return rows_; }
  /// Null if there is one process.
  [[nodiscard]] const RowShare* share() const { return share_; }
  /// Lanes of a row, gaps included.
  [[nodiscard]] std::int64_t row_length() const { return length_; }
  /// In lanes.
  [[nodiscard]] const RowMargins& margins() const { return margins_; }
  [[nodiscard]] const RowShape& shape() const { return shape_; }
  /// Levels from one row to the next.
  [[nodiscard]] std::int64_t stride() const { return stride_; }

  /// Bytes reserved.
  [[nodiscard]] std::size_t bytes() const {
    return (static_cast<std::size_t>((rows_ + 1) * stride_) + kLevelBlock / sizeof(Level)) * sizeof(Level);
  }

  [[nodiscard]] bool is_interned() const { return !slots_.empty(); }
  /// First cell of a row; margins().before levels stand before it, margins().after after its last.
  [[nodiscard]] const Level* row(std::int64_t r) const { return at(slot(r)); }
  /// First cell of slot 0; slots follow one another at stride().
  [[nodiscard]] const Level* first_slot() const { return at(0); }
  /// [row] its slot; empty: rows are not interned, and row r stands in slot r.
  [[nodiscard]] const std::vector<std::uint32_t>& slots() const { return slots_; }

  /// Calls `change(cells)`, which may write to the cells of a row, and closes the row.
  template <class Change>
  void change_row(std::int64_t r, const Change& change) {
    if (!is_interned()) {
      Level* const cells = levels_.data() + r * stride_ + margins_.before;
      change(cells);
      return close_row(cells);
    }
    std::copy_n(row(r), length_, lanes_.data() + margins_.before);
    change(lanes_.data() + margins_.before);
    put_ready(r, lanes_.data(), make_ready(lanes_.data()));
  }
  /// Gives a row these cells, and closes it.
  /// @param cells whole blocks may be read; levels in gaps do not matter
  void put(std::int64_t r, const Level* cells) {
    change_row(r, [&](Level* target) { std::copy_n(cells, length_, target); });
  }
  /// A row that is ready to be put.
  struct Ready {
    std::uint64_t hash = 0;
    std::uint32_t slot = Interner::kNone;  ///< one that had its content; kNone: there was none
    std::uint32_t content = 0;             ///< the number of that content
  };
  /// put() in two steps, the first: closes a row that stands outside this object.
  /// @param lanes stride() of them, margins().before before the first cell
  [[nodiscard]] Ready make_ready(Level* lanes) const {
    const Level* const cells = lanes + margins_.before;
    close_row(lanes + margins_.before);
    if (!is_interned()) return {};
    const std::uint64_t hash = hash_of(cells);
    const std::uint32_t slot = find(hash, cells);
    return {hash, slot, slot == Interner::kNone ? 0 : interner_.content(slot)};
  }
  /// put() in two steps, the second. @param lanes after make_ready(), which returned `ready`, and no
  /// renumber() since then
  void put_ready(std::int64_t r, const Level* lanes, const Ready& ready) {
    place(r, lanes, ready);
    if (is_interned()) fill_placed(nullptr);
  }
  /// put_ready(), but a content that is new to interned rows is only given a slot: fill_placed() copies it.
  /// Until then the row must not be read, and `lanes` must stay.
  void place(std::int64_t r, const Level* lanes, const Ready& ready) {
    if (!is_interned()) {
      std::copy_n(lanes, stride_, levels_.data() + r * stride_);
      return;
    }
    std::uint32_t target = ready.slot;
    if (target == Interner::kNone || !interner_.has(target, ready.content))
      target = find(ready.hash, lanes + margins_.before);
    if (target != Interner::kNone) {
      interner_.hold(target);
    } else {
      target = interner_.add(ready.hash);
      if (placed_.empty()) first_placed_ = interner_.content(target);
      placed_.push_back({target, lanes});
    }
    move_to(r, target);
  }
  /// Copies what was placed. @param team null: this thread alone
  void fill_placed(ThreadTeam* team) {
    for_each(team, std::ssize(placed_), kPlacedAtOnce, [&](ThreadTeam::Range range, int) {
      for (auto k = static_cast<std::uint32_t>(range.begin); k < range.end; ++k) {
        const auto [slot, lanes] = placed_[k];
        // Unless all rows have left the slot since.
        if (interner_.has(slot, first_placed_ + k))
          std::copy_n(lanes, stride_, levels_.data() + slot * stride_);
      }
    });
    placed_.clear();
  }
  /// Makes a row equal to another one. @returns whether it was not.
  bool copy_row(std::int64_t from, std::int64_t to) {
    if (!is_interned()) {
      const Level* const source = levels_.data() + from * stride_;
      Level* const target = levels_.data() + to * stride_;
      if (std::equal(source, source + stride_, target)) return false;
      std::copy_n(source, stride_, target);
      return true;
    }
    const std::uint32_t target = slots_[static_cast<std::size_t>(from)];
    if (slots_[static_cast<std::size_t>(to)] == target) return false;
    interner_.hold(target);
    move_to(to, target);
    return true;
  }
  /// A number for what a row holds: equal numbers mean equal rows, and different numbers different rows, also
  /// at different times, until renumber() is called. @pre rows are interned
  [[nodiscard]] std::uint32_t content(std::int64_t r) const {
    REQUIRES(is_interned());
    return interner_.content(slots_[static_cast<std::size_t>(r)]);
  }
  void renumber() { interner_.renumber(); }

  /// Closes a row of this layout that stands outside this object.
  void close_row(Level* cells) const { close_from(cells, 0); }

  /// Sets the gaps of a row, or of a copy of it, to 0.
  void clear_gaps(Level* cells) const {
    if (shape_.dimensions.size() == 1) return;
    std::int64_t end = 0;
    shape_.for_each_run([&](std::int64_t lane, std::int64_t count) {
      std::fill(cells + end, cells + lane, Level{0});
      end = lane + count;
    });
    std::fill(cells + end, cells + length_, Level{0});
  }

 private:
  /// Contents that one thread copies at a time.
  static constexpr std::int64_t kPlacedAtOnce = 32;

  struct Placed {
    std::uint32_t slot;
    const Level* lanes;
  };

  /// Closes the lanes along the dimensions from k on that begin at `cells`.
  void close_from(Level* cells, std::size_t k) const {
    const RowDimension& dimension = shape_.dimensions[k];
    if (k + 1 == shape_.dimensions.size()) return close_run(cells, dimension);
    for (std::int64_t i = 0; i < dimension.count; ++i) close_from(cells + i * dimension.stride, k + 1);
    for (std::int64_t i = -dimension.margins.before; i < 0; ++i) continue_at(cells, k, i);
    for (std::int64_t i = 0; i < dimension.margins.after; ++i) continue_at(cells, k, dimension.count + i);
  }

  /// Fills the lanes of an index of dimension k beyond its ends, over all dimensions after k.
  void continue_at(Level* cells, std::size_t k, std::int64_t index) const {
    const RowDimension& dimension = shape_.dimensions[k];
    std::int64_t before = 0;
    std::int64_t after = 1;
    for (std::size_t j = k + 1; j < shape_.dimensions.size(); ++j) {
      const RowDimension& other = shape_.dimensions[j];
      before += other.margins.before * other.stride;
      after += (other.count - 1 + other.margins.after) * other.stride;
    }
    Level* const target = cells + index * dimension.stride;
    const OutsideTraits& rule = traits(index < 0 ? dimension.ends.below : dimension.ends.above);
    if (rule.is_open()) {
      std::fill(target - before, target + after, rule.arrives ? kTop : Level{0});
      // A post that leaves safely in this dimension may leave through an unsafe side in one after it.
      if (rule.arrives) close_from(target, k + 1);
      return;
    }
    const std::int64_t n = dimension.count;
    const std::int64_t source = rule.wraps ? (index % n + n) % n : (index < 0 ? 0 : n - 1);
    const Level* const other = cells + source * dimension.stride;
    std::copy(other - before, other + after, target - before);
  }

  static void close_run(Level* cells, const RowDimension& run) {
    const std::int64_t n = run.count;
    if (traits(run.ends.below).wraps) {
      for (std::int64_t k = 1; k <= run.margins.before; ++k) cells[-k] = cells[(n - k % n) % n];
      for (std::int64_t k = 0; k < run.margins.after; ++k) cells[n + k] = cells[k % n];
      return;
    }
    std::fill_n(cells - run.margins.before, run.margins.before, beyond(run.ends.below, cells[0]));
    std::fill_n(cells + n, run.margins.after, beyond(run.ends.above, cells[n - 1]));
  }

  [[nodiscard]] static Level beyond(Outside rule, Level boundary) {
    if (traits(rule).blocks) return 0;
    return traits(rule).arrives ? kTop : boundary;
  }

  [[nodiscard]] std::int64_t slot(std::int64_t r) const {
    return slots_.empty() ? r : std::int64_t{slots_[static_cast<std::size_t>(r)]};
  }
  [[nodiscard]] const Level* at(std::int64_t slot) const {
    return levels_.data() + slot * stride_ + margins_.before;
  }
  /// The cells of a slot, which may still stand where they were placed from.
  [[nodiscard]] const Level* cells_of(std::uint32_t slot) const {
    const std::uint32_t k = interner_.content(slot) - first_placed_;
    return k < placed_.size() ? placed_[k].lanes + margins_.before : at(slot);
  }
  void move_to(std::int64_t r, std::uint32_t target) {
    std::uint32_t& slot = slots_[static_cast<std::size_t>(r)];
    interner_.drop(slot);
    slot = target;
  }
  /// The slot with these cells, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint64_t hash, const Level* cells) const {
    const auto bytes = static_cast<std::size_t>(length_) * sizeof(Level);
    return interner_.find(hash,
                          [&](std::uint32_t slot) { return std::memcmp(cells_of(slot), cells, bytes) == 0; });
  }
  [[nodiscard]] std::uint64_t hash_of(const Level* cells) const {
    const auto bytes = static_cast<std::size_t>(length_) * sizeof(Level);
    const char* const from = reinterpret_cast<const char*>(cells);
    std::uint64_t hash = bytes;
    std::uint64_t word = 0;
    std::size_t k = 0;
    for (; k + sizeof(word) <= bytes; k += sizeof(word)) {
      std::memcpy(&word, from + k, sizeof(word));
      hash = mixed_hash(hash, word);
    }
    word = 0;
    std::memcpy(&word, from + k, bytes - k);
    hash = mixed_hash(hash, word);
    return hash;
  }

  std::int64_t rows_ = 0;
  const RowShare* share_ = nullptr;
  RowShape shape_;
  std::int64_t length_ = 0;
  RowMargins margins_;
  std::int64_t stride_ = 0;
  ZeroedArray<Level> levels_;
  std::vector<std::uint32_t> slots_;  ///< [row]; empty: rows are not interned
  Interner interner_;
  /// Contents that are in no slot yet, numbered from first_placed_ on.
  std::vector<Placed> placed_;
  std::uint32_t first_placed_ = 0;
  std::vector<Level> lanes_;  ///< the row being put, with its margins; only if rows are interned
};

/// Gives each row held the cells that `fill(row, cells)` writes, which may be whole blocks beyond the row and
/// read that row of `levels`. All threads do the work but for the slots of interned rows: one finds those, in
/// ascending order.
template <class Level, class Fill>
void put_rows(LevelRows<Level>& levels, ThreadTeam& team, const Fill& fill) {
  const std::int64_t width = levels.stride() + static_cast<std::int64_t>(kLevelBlock / sizeof(Level));
  if (!levels.is_interned()) {
    return for_each_held_row(team, levels.share(), levels.rows(), 256, [&](ThreadTeam::Range range, int) {
      std::vector<Level> cells(static_cast<std::size_t>(width));
      for (std::int64_t r = range.begin; r < range.end; ++r) {
        fill(r, cells.data());
        levels.put(r, cells.data());
      }
    });
  }
  const std::int64_t most = std::clamp<std::int64_t>(kMostLevelsOfBatch / width, 1, levels.rows());
  ZeroedArray<Level> lanes(static_cast<std::size_t>(most * width));
  std::vector<typename LevelRows<Level>::Ready> ready(static_cast<std::size_t>(most));
  for (const RowShare::Range run : held_rows(levels.share(), levels.rows())) {
    for (std::int64_t begin = run.begin; begin < run.end; begin += most) {
      const std::int64_t count = std::min(most, run.end - begin);
      const auto lanes_of = [&](std::int64_t k) { return lanes.data() + k * width; };
      team.for_each(count, count / (kTasksOfThread * team.size()), [&](ThreadTeam::Range range, int) {
        for (std::int64_t k = range.begin; k < range.end; ++k) {
          fill(begin + k, lanes_of(k) + levels.margins().before);
          ready[static_cast<std::size_t>(k)] = levels.make_ready(lanes_of(k));
        }
      });
      for (std::int64_t k = 0; k < count; ++k)
        levels.place(begin + k, lanes_of(k), ready[static_cast<std::size_t>(k)]);
      levels.fill_placed(&team);
    }
  }
}

/// Gives each row held the greatest level in the cells of a set, and 0 in others.
template <class Level>
void put_set(LevelRows<Level>& levels, const CellSet& set, ThreadTeam& team) {
  const LevelKernels<Level>& kernels = level_kernels<Level>(best_instruction_set());
  put_rows(levels, team, [&](std::int64_t r, Level* cells) {
    kernels.spread(set.row(r).data(), cells, static_cast<std::size_t>(levels.row_length()));
  });
}

}  // namespace coordreq
