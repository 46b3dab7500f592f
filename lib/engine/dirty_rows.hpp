#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "base/zeroed_array.hpp"
#include "engine/row_hull.hpp"
#include "engine/row_units.hpp"

namespace coordreq {

/// The dirty rows of a wave: rows that have changed since rows that can meet them were looked at last.
/// Batches of work are numbered from 1 on; a change is known by the batch that made it.
///
/// Whether a unit can meet a change is asked of coarse units first: asking all units took an eighth of the
/// time of three vehicles.
///
/// Threads: several may call mark(), for different rows; several may call mark_seen(), for different units;
/// several may call is_pending(), enter() and meets_change(), each with a scratch of its own, while no thread
/// marks. Everything else is for one thread.
class DirtyRows {
 public:
  struct Scratch {
    RowPosition position;
    RowBox box;
    std::vector<std::uint32_t> merged;  ///< [row of the unit] the last change in the shared dimensions
    std::vector<std::int64_t> counter;
  };

  /// @pre unchecked: all outlive this object.
  DirtyRows(const RowEngine& engine, const RowHull& hull, const RowUnits& units);

  [[nodiscard]] Scratch make_scratch() const { return {units_.first_position(), {}, {}, {}}; }

  /// The unit has to be looked at even if no row that it can meet has changed.
  void set_unseen(std::int64_t unit) { seen_[static_cast<std::size_t>(unit)] = kNever; }
  [[nodiscard]] bool is_unseen(std::int64_t unit) const {
    return seen_[static_cast<std::size_t>(unit)] == kNever;
  }
  /// True if the unit is unseen, or if a unit that its posts can meet has changed since it was looked at
  /// last.
  [[nodiscard]] bool is_pending(std::int64_t unit, Scratch& scratch) const;

  /// Begins the next batch.
  void begin_batch() { ++batch_; }
  /// Nothing was pending for it: its number goes to the next one, so that numbers do not run out.
  void give_up_batch() { --batch_; }
  [[nodiscard]] std::uint32_t batch() const { return batch_; }
  void mark_seen(std::int64_t unit) { seen_[static_cast<std::size_t>(unit)] = batch_; }
  /// The row has changed in this batch.
  void mark(std::int64_t row) {
    changed_[static_cast<std::size_t>(row)] = batch_;
    note(unit_changed_[static_cast<std::size_t>(units_.of(row))]);
    if (coarse_dimensions_ > 0) note(coarse_changed_[static_cast<std::size_t>(row / coarse_rows_)]);
    note(last_change_);
  }

  /// Whether a row of the unit has changed in this batch.
  [[nodiscard]] bool has_unit_changed(std::int64_t unit) const {
    return unit_changed_[static_cast<std::size_t>(unit)] == batch_;
  }
  /// Whether a row has changed after a batch.
  [[nodiscard]] bool has_changed_after(std::uint32_t batch, std::int64_t row) const {
    return changed_[static_cast<std::size_t>(row)] > batch;
  }

  /// Goes to a unit; queries with this scratch are about its rows.
  void enter(std::int64_t unit, Scratch& scratch) const;
  /// True if posts of a row of the unit entered can meet a row that has changed since the unit was looked at.
  [[nodiscard]] bool meets_change(const RowPosition& position, std::int64_t unit, Scratch& scratch) const;

 private:
  /// Several rows of one unit may be marked at once, all with the same number.
  void note(std::uint32_t& last) const { std::atomic_ref(last).store(batch_, std::memory_order_relaxed); }

  /// Instead of the number of the batch that looked at a unit: no batch has; or a batch before number 1 has.
  static constexpr std::uint32_t kNever = 0;
  static constexpr std::uint32_t kBeforeAll = 1;

  const RowEngine& engine_;
  const RowHull& hull_;
  const RowUnits& units_;
  std::uint32_t batch_ = 0;                  ///< number of the last batch
  std::uint32_t last_change_ = 0;            ///< the last batch with a change
  ZeroedArray<std::uint32_t> changed_;       ///< [row] the batch that changed it last
  std::vector<std::uint32_t> unit_changed_;  ///< [unit] the batch that changed a row of it last
  std::vector<std::uint32_t> seen_;          ///< [unit] the batch that looked at it last
  /// Number of leading dimensions that tell *coarse units* apart: one look shows that no unit of a coarse
  /// unit has changed. 0: there are none.
  std::size_t coarse_dimensions_ = 0;
  std::int64_t coarse_rows_ = 1;               ///< of a coarse unit
  std::vector<std::int64_t> coarse_strides_;   ///< [coarse dimension] in coarse units
  std::vector<std::uint32_t> coarse_changed_;  ///< [coarse unit] the batch that changed it last
};

}  // namespace coordreq
