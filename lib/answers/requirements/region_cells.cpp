#include <algorithm>
#include <vector>

#include "answers/requirements/region.hpp"
#include "engine/row_operations.hpp"
#include "expression/condition.hpp"
#include "model/odometer.hpp"
#include "model/pieces.hpp"

namespace coordreq {
namespace {

RationalInterval exact_range(const Piece& piece) {
  return {.lower = piece.lower, .upper = piece.upper};
}

/// The values that a state can have when cell k is measured. A piece that ends at a seam does not hold the
/// seam, which is the lower end of the period, and of the next cell.
std::vector<Piece> measured_pieces(const GridDimension& dimension, std::int64_t k) {
  std::vector<Piece> ranges = pieces(dimension, k);
  if (ranges.size() > 1 && ranges.back().lower == ranges.back().upper) ranges.pop_back();
  return ranges;
}

/// The values of the states that `where` mentions, for each of their indices.
struct Ranges {
  std::vector<std::uint32_t> states;                              // mentioned, ascending
  std::vector<std::size_t> dimension;                             // [mentioned] of the grid
  std::vector<std::vector<std::vector<RationalInterval>>> exact;  // [mentioned][index][piece]
  std::vector<std::vector<Interval>> hull;                        // [mentioned][index]

  Ranges(const Program& where, const UniformGrid& grid) : states(where.variables()) {
    for (const std::uint32_t state : states) {
      const std::size_t i = dimension.emplace_back(grid.dimension_of(state));
      auto& indices = exact.emplace_back();
      auto& hulls = hull.emplace_back();
      for (std::int64_t k = 0; k < grid[i].count; ++k) {
        std::vector<RationalInterval>& ranges = indices.emplace_back();
        for (const Piece& piece : measured_pieces(grid[i], k)) ranges.push_back(exact_range(piece));
        RationalInterval whole = ranges.front();
        for (const RationalInterval& range : ranges) whole = coordreq::hull(whole, range);
        hulls.push_back(enclose(whole));
      }
    }
  }
};

/// Finds the cells of one slab of rows after the other. One object a thread.
class RegionFinder {
 public:
  /// @param rows cells in other rows need not be found
  RegionFinder(const Program& where, const UniformGrid& grid, const Ranges& ranges, RowShare::Range rows,
               CellSet& cells)
      : grid_(grid),
        ranges_(ranges),
        rows_(rows),
        cells_(cells),
        natural_(where),
        decider_(where),
        box_(grid.size()),
        exact_box_(grid.size()) {}

  /// Decides a box of cells, halving it where needed. What natural evaluation decides for the box holds for
  /// its cells, because narrower ranges never evaluate to wider ones.
  void visit(std::vector<IndexRange>& block) {
    if (!meets_rows(block)) return;
    for (std::size_t s = 0; s < ranges_.states.size(); ++s) set_hull(s, block[ranges_.dimension[s]]);
    const Truth truth = natural_.condition(box_);
    if (truth == Truth::no) return;
    if (truth == Truth::yes) return fill(block, 0, 0);
    const std::size_t longest = longest_side(block);
    IndexRange& side = block[longest];
    if (side.first == side.last) {
      if (may_meet(block)) fill(block, 0, 0);
      return;
    }
    const IndexRange whole = side;
    side.last = whole.first + (whole.last - whole.first) / 2;
    visit(block);
    side = {side.last + 1, whole.last};
    visit(block);
    side = whole;
  }

 private:
  [[nodiscard]] bool meets_rows(const std::vector<IndexRange>& block) const {
    std::int64_t first = 0;
    std::int64_t last = 0;
    for (std::size_t i = 0; i + 1 < block.size(); ++i) {
      first += block[i].first * grid_.row_stride(i);
      last += block[i].last * grid_.row_stride(i);
    }
    return first < rows_.end && last >= rows_.begin;
  }

  void set_hull(std::size_t s, const IndexRange& range) {
    const std::vector<Interval>& hulls = ranges_.hull[s];
    Interval all = hulls[static_cast<std::size_t>(range.first)];
    for (std::int32_t k = range.first + 1; k <= range.last; ++k) {
      all = hull(all, hulls[static_cast<std::size_t>(k)]);
    }
    box_[ranges_.states[s]] = all;
  }

  /// The longest side of a box in the dimensions that `where` mentions; 0 if there are none.
  [[nodiscard]] std::size_t longest_side(const std::vector<IndexRange>& block) const {
    std::size_t longest = ranges_.dimension.empty() ? 0 : ranges_.dimension.front();
    for (const std::size_t i : ranges_.dimension) {
      if (block[i].last - block[i].first > block[longest].last - block[longest].first) longest = i;
    }
    return longest;
  }

  /// Decides a box with one index of each state that `where` mentions, piece by piece.
  [[nodiscard]] bool may_meet(const std::vector<IndexRange>& block) {
    std::vector<const std::vector<RationalInterval>*> ranges;
    std::vector<std::int64_t> counts;
    for (std::size_t s = 0; s < ranges_.states.size(); ++s) {
      ranges.push_back(&ranges_.exact[s][static_cast<std::size_t>(block[ranges_.dimension[s]].first)]);
      counts.push_back(static_cast<std::int64_t>(ranges.back()->size()));
    }
    Odometer choice(counts);
    do {
      for (std::size_t s = 0; s < ranges.size(); ++s) {
        const std::uint32_t i = ranges_.states[s];
        exact_box_[i] = (*ranges[s])[static_cast<std::size_t>(choice.indices()[s])];
        box_[i] = enclose(exact_box_[i]);
      }
      const auto exact = [this]() -> std::span<const RationalInterval> { return exact_box_; };
      if (decider_.decide(box_, exact) != Truth::no) return true;
    } while (choice.advance());
    return false;
  }

  /// Adds all cells of a box. @param row of the indices chosen in the dimensions before i
  void fill(const std::vector<IndexRange>& block, std::size_t i, std::int64_t row) {
    if (i + 1 == block.size()) {
      set_bits(cells_.row(row), block[i].first, block[i].last + 1);
      return;
    }
    const std::int64_t stride = grid_.row_stride(i);
    for (std::int64_t k = block[i].first; k <= block[i].last; ++k) fill(block, i + 1, row + k * stride);
  }

  const UniformGrid& grid_;
  const Ranges& ranges_;
  RowShare::Range rows_;
  CellSet& cells_;
  Evaluator<Interval> natural_;
  ConditionDecider decider_;
  std::vector<Interval> box_;
  std::vector<RationalInterval> exact_box_;
};

std::vector<IndexRange> whole_grid(const UniformGrid& grid) {
  std::vector<IndexRange> block;
  for (const GridDimension& dimension : grid.dimensions())
    block.push_back({0, static_cast<std::int32_t>(dimension.count - 1)});
  return block;
}

}  // namespace

CellSet cells_of_region(const Program& where, const UniformGrid& grid, ThreadTeam& team,
                        const RowShare* share) {
  CellSet cells(grid.rows(), grid.row_length());
  const Ranges ranges(where, grid);
  // Threads write to different rows: each to those with an index of its own in the first dimension.
  const std::int64_t slabs = grid.size() > 1 ? grid[0].count : 1;
  team.for_each(slabs, 1, [&](ThreadTeam::Range range, int) {
    RegionFinder finder(where, grid, ranges, local_rows(share, grid.rows()), cells);
    std::vector<IndexRange> block = whole_grid(grid);
    if (grid.size() > 1)
      block[0] = {static_cast<std::int32_t>(range.begin), static_cast<std::int32_t>(range.end - 1)};
    finder.visit(block);
  });
  return cells;
}

}  // namespace coordreq
