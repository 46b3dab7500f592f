#include "reach/tables.hpp"

#include <algorithm>
#include <optional>

#include "reach/cells_meeting.hpp"

namespace coordreq {
namespace {

/// The value jumps where a periodic state does, unless it is that state itself all the time.
bool crosses_a_seam(const AffinePost& post, const std::vector<SampledRow>& rows) {
  for (std::size_t j = 0; j < post.moving.size(); ++j) {
    const auto source = static_cast<std::size_t>(post.moving[j]);
    if (!post.grid[source].periodic()) continue;
    const Rational follows = source == post.state ? 1 : 0;
    for (const SampledRow& row : rows) {
      if (row.coefficient[j] != follows) return true;
    }
  }
  return false;
}

IndexRange covering_from_pieces(const AffinePost& post, const std::vector<SampledRow>& rows,
                                const std::vector<std::int64_t>& cell) {
  const GridDimension& target = post.grid[post.state];
  std::optional<IndexRange> range;
  post.for_each_choice_of_pieces(cell, [&](const std::vector<Piece>& pieces) {
    Piece hull = post.from_pieces(rows.front(), pieces);
    for (const SampledRow& row : rows) {
      const Piece values = post.from_pieces(row, pieces);
      hull = {std::min(hull.lower, values.lower), std::max(hull.upper, values.upper)};
    }
    const IndexRange next = cells_covering(target, hull.lower, hull.upper);
    range = range ? merge_ranges(*range, next, target) : next;
  });
  return *range;
}

}  // namespace

void fill_affine_tube(const AffinePost& post, const std::vector<SampledRow>& rows, std::int64_t base,
                      TransitionTable& tube) {
  if (crosses_a_seam(post, rows)) {
    post.fill(tube, base, [&](const auto& cell) { return covering_from_pieces(post, rows, cell); });
    return;
  }
  // As cells_covering(); the own cell is in the tube, so that first <= last.
  const GridDimension& target = post.grid[post.state];
  const Rational reach = (target.radius() + target.measurement_error) / target.step;
  std::vector<IndexForm> lower;
  std::vector<IndexForm> upper;
  for (const SampledRow& row : rows) {
    lower.push_back(post.end_form(row, false, reach));
    upper.push_back(post.end_form(row, true, -reach));
  }
  post.fill(tube, base, [&](const std::vector<std::int64_t>& cell) {
    std::int64_t first = lower.front().floor(cell);
    std::int64_t last = upper.front().ceil(cell);
    for (std::size_t m = 1; m < rows.size(); ++m) {
      first = std::min(first, lower[m].floor(cell));
      last = std::max(last, upper[m].ceil(cell));
    }
    return raw_range(target, first, last);
  });
}

}  // namespace coordreq
