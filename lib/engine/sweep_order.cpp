#include "engine/sweep_order.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

/// Rows of a batch, if there are as many in some fronts together: fewer cost more to hand out to threads than
/// units that miss the levels found just before cost visits.
constexpr std::int64_t kLeastRows = 32;

/// Finds the fronts of units.
class Fronts {
 public:
  Fronts(const RowUnits& units, const RowHull& hull, const RowSymmetry* symmetry, RowPosition first)
      : units_(units),
        hull_(hull),
        symmetry_(symmetry),
        front_(static_cast<std::size_t>(units.count()), 0),
        position_(std::move(first)) {}

  /// To be called in order. @returns the front of a unit, from 1 on
  std::uint32_t find(std::int64_t unit) {
    units_.go_to(unit, position_);
    units_.enclose(hull_, position_, ranges_);
    std::uint32_t last = 0;
    static_cast<void>(units_.any_in(ranges_, counter_, [&](std::int64_t other) {
      last = std::max(last, front_[static_cast<std::size_t>(other)]);
      return false;
    }));
    set(unit, last + 1);
    return last + 1;
  }

 private:
  /// Rows that are permuted change together with their canonical row.
  void set(std::int64_t unit, std::uint32_t front) {
    front_[static_cast<std::size_t>(unit)] = front;
    if (symmetry_ == nullptr) return;
    symmetry_->for_each_permuted(position_.row, [&](std::int64_t row) {
      std::uint32_t& other = front_[static_cast<std::size_t>(units_.of(row))];
      other = std::max(other, front);
    });
  }

  const RowUnits& units_;
  const RowHull& hull_;
  const RowSymmetry* symmetry_;
  std::vector<std::uint32_t> front_;  ///< [unit] 0: not found yet
  RowPosition position_;
  std::vector<IndexRange> ranges_;
  std::vector<std::int64_t> counter_;
};

}  // namespace

SweepOrder::SweepOrder(const RowUnits& units, const RowHull& hull, const AliveRows& alive,
                       std::int64_t first_unit, std::int64_t count, bool backwards,
                       const RowSymmetry* symmetry, std::int64_t most_rows) {
  Fronts fronts(units, hull, symmetry, units.first_position());
  std::vector<std::uint32_t> front_of(static_cast<std::size_t>(count), 0);  // 0: nothing alive
  std::vector<std::size_t> end(1, 0);                                       // [front] units up to it
  std::vector<std::int64_t> rows(1, 0);                                     // [front]
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t unit = backwards ? count - 1 - k : k;
    const std::int64_t alive_rows = alive.of_unit(first_unit + unit);
    if (alive_rows == 0) continue;
    const std::uint32_t front = fronts.find(first_unit + unit);
    front_of[static_cast<std::size_t>(unit)] = front;
    if (front >= end.size()) {
      end.resize(front + 1, 0);
      rows.resize(front + 1, 0);
    }
    ++end[front];
    rows[front] += alive_rows;
  }
  for (std::size_t f = 1; f < end.size(); ++f) end[f] += end[f - 1];
  units_.resize(end.back());
  std::vector<std::size_t> next(end.begin(), end.end());  // [front] where its next unit goes, if one less
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t unit = backwards ? count - 1 - k : k;
    const std::uint32_t front = front_of[static_cast<std::size_t>(unit)];
    if (front > 0) units_[next[front - 1]++] = static_cast<std::uint32_t>(unit);
  }
  const std::span<const std::uint32_t> all(units_);
  for (std::size_t f = 1; f < end.size();) {
    const std::size_t begin = end[f - 1];
    std::int64_t together = 0;
    for (; f < end.size() && (together == 0 || together + rows[f] <= kLeastRows); ++f) together += rows[f];
    // A front that is large is divided into equal batches.
    const std::int64_t batches = (together + most_rows - 1) / most_rows;
    Batch batch{all.subspan(begin, 0), 0};
    std::int64_t done = 0, number = 1;
    for (std::size_t u = begin; u < end[f - 1]; ++u) {
      batch.units = all.subspan(u - batch.units.size(), batch.units.size() + 1);
      batch.rows += alive.of_unit(first_unit + units_[u]);
      if ((done + batch.rows) * batches < together * number && u + 1 < end[f - 1]) continue;
      batches_.push_back(batch);
      done += batch.rows;
      ++number;
      batch = {all.subspan(u + 1, 0), 0};
    }
  }
}

}  // namespace coordreq
