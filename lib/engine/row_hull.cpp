#include "engine/row_hull.hpp"

#include <algorithm>
#include <iterator>

namespace coordreq {
namespace {

/// Counts for each row the boxes of rows that hold it. A box costs its corners and not its rows: changes are
/// added at the corners, and a sum along each dimension in turn spreads them (summed-area table).
class BoxCount {
 public:
  explicit BoxCount(const UniformGrid& grid) : grid_(grid), counts_(static_cast<std::size_t>(grid.rows())) {}

  void add(std::span<const IndexRange> ranges) { add_from(0, 0, 1, ranges); }

  /// [row] The counts. @pre unchecked: fewer than 2^32 boxes; called once
  [[nodiscard]] std::vector<std::uint32_t>& spread() {
    for (std::size_t i = 0; i < grid_.across(); ++i) {
      const auto stride = static_cast<std::size_t>(grid_.row_stride(i));
      const std::size_t length = stride * static_cast<std::size_t>(grid_[i].count);
      for (std::size_t begin = 0; begin < counts_.size(); begin += length) {
        for (std::size_t row = begin + stride; row < begin + length; ++row)
          counts_[row] += counts_[row - stride];
      }
    }
    return counts_;
  }

 private:
  /// Adds a box from dimension i on. `change` wraps around, like the counts.
  void add_from(std::size_t i, std::int64_t row, std::uint32_t change, std::span<const IndexRange> ranges) {
    if (i == ranges.size()) {
      counts_[static_cast<std::size_t>(row)] += change;
      return;
    }
    const std::int64_t count = grid_[i].count, stride = grid_.row_stride(i);
    const auto [first, last] = ranges[i];
    if (first > last) return;
    add_from(i + 1, row + first * stride, change, ranges);
    // On a ring indices beyond the last begin anew.
    if (last >= count) add_from(i + 1, row, change, ranges);
    const std::int64_t end = last + 1 - (last >= count ? count : 0);
    if (end < count) add_from(i + 1, row + end * stride, 0U - change, ranges);
  }

  const UniformGrid& grid_;
  std::vector<std::uint32_t> counts_;
};

/// The ranges of the tubes of rows in one dimension across rows.
struct TubeHull {
  const RowSlices* slices;
  std::vector<IndexRange> hulls;

  [[nodiscard]] IndexRange range(const RowPosition& position) const {
    return hulls[static_cast<std::size_t>(slices->base(position) / slices->input_combinations)];
  }
};
using TubeHulls = std::vector<TubeHull>;

/// [demand][dimension across rows]
std::vector<TubeHulls> hulls_of_tubes(const RowEngine& engine) {
  std::vector<TubeHulls> result;
  for (const RowEngine::Demand& demand : engine.demands()) {
    TubeHulls& hulls = result.emplace_back();
    for (std::size_t i = 0; i < engine.across(); ++i) {
      const RowSlices& slices = demand.family.slices[i];
      hulls.push_back({&slices, slice_hulls(slices, engine.grid()[i], nullptr, nullptr)});
    }
  }
  return result;
}

}  // namespace

RowHull::RowHull(const RowEngine& engine, ThreadTeam* team) : engine_(&engine) {
  const RowFamily posts = engine.posts();
  for (std::size_t i = 0; i < engine.tables(); ++i) {
    const bool is_along = i >= engine.across();
    hulls_.push_back(slice_hulls(posts.slices[i], engine.grid()[i],
                                 is_along ? &posts.shape.dimensions[i - engine.across()] : nullptr, team));
  }
}

IndexRange RowHull::range(const RowPosition& position, std::size_t i) const {
  const RowSlices& slices = engine_->slices()[i];
  return hulls_[i][static_cast<std::size_t>(slices.base(position) / slices.input_combinations)];
}

void RowHull::box(const RowPosition& position, RowBox& box) const {
  box.resize(engine_->grid());
  for (std::size_t i = 0; i < engine_->tables(); ++i) box[i] = range(position, i);
}

std::vector<std::uint8_t> RowHull::rows_reached(const CellSet* set, RowShare::Range rows) const {
  if (rows.end - rows.begin > UINT32_MAX / (1 + std::ssize(engine_->demands())))
    return std::vector<std::uint8_t>(static_cast<std::size_t>(engine_->rows()), 1);
  BoxCount boxes(engine_->grid());
  RowBox reached;
  const std::vector<TubeHulls> tubes = hulls_of_tubes(*engine_);
  RowPosition position(engine_->grid(), rows.begin);
  for (; position.row < rows.end; position.advance(engine_->grid())) {
    if (set != nullptr && !any_set(set->row(position.row))) continue;
    box(position, reached);
    boxes.add(reached.ranges);
    for (const TubeHulls& hulls : tubes) {
      for (std::size_t i = 0; i < hulls.size(); ++i) reached.ranges[i] = hulls[i].range(position);
      boxes.add(reached.ranges);
    }
  }
  std::vector<std::uint8_t> rows_in_boxes(static_cast<std::size_t>(engine_->rows()));
  std::ranges::transform(boxes.spread(), rows_in_boxes.begin(),
                         [](std::uint32_t count) { return count > 0 ? 1 : 0; });
  return rows_in_boxes;
}

std::uint64_t RowHull::bytes() const {
  std::uint64_t total = 0;
  for (const std::vector<IndexRange>& hulls : hulls_) total += hulls.size() * sizeof(IndexRange);
  return total;
}

}  // namespace coordreq
