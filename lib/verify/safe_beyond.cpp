#include "verify/safe_beyond.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "answers/checking/posts.hpp"
#include "answers/invariance/check_safe.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

SafeBeyond::SafeBeyond(const ProblemSpec& spec, const UniformGrid& grid, const std::vector<PostTable>& tubes)
    : spec_(spec), grid_(grid) {
  if (spec.abstraction.safe == Membership::center) return;  // centres stay where they are
  std::vector<GridDimension> dimensions = grid.dimensions();
  for (const std::uint32_t i : spec.safe.variables()) extend(i, tubes[i], dimensions);
  grid_ = UniformGrid(dimensions);
}

void SafeBeyond::extend(std::size_t state, const PostTable& tube, std::vector<GridDimension>& dimensions) {
  GridDimension& dimension = dimensions[state];
  std::int64_t below = 0;
  std::int64_t above = 0;
  for (const IndexRange& raw : tube.entries) {
    if (after_leaving(raw, grid_[state]).blocked) continue;
    if (dimension.below == Outside::saturate) below = std::max(below, -std::int64_t{raw.first});
    if (dimension.above == Outside::saturate)
      above = std::max(above, std::int64_t{raw.last} - (dimension.count - 1));
  }
  const auto note = [&](std::int64_t cells, std::int64_t index) {
    if (cells > 0) stretched_.emplace_back(state, index);
    if (cells > INT32_MAX - dimension.count) lost_.emplace_back(state, index);
  };
  note(below, 0);
  note(above, dimension.count - 1);
  dimension.extension_below = dimension.step * Rational(static_cast<long>(below));
  dimension.extension_above = dimension.step * Rational(static_cast<long>(above));
}

bool SafeBeyond::has(const std::vector<std::pair<std::size_t, std::int64_t>>& boundaries,
                     std::int64_t cell) const {
  return std::any_of(boundaries.begin(), boundaries.end(), [&](const auto& boundary) {
    return grid_.index(cell, boundary.first) == boundary.second;
  });
}

Finding SafeBeyond::check(const std::vector<std::uint8_t>& safe, const std::vector<std::uint8_t>& beyond,
                          ThreadTeam& team) const {
  Tally tally("S beyond limits");
  SafeMemory memory(spec_.safe, grid_);
  std::vector<std::unique_ptr<SafeJudge>> judges(static_cast<std::size_t>(team.size()));
  const auto check_cell = [&](std::int64_t cell, SafeJudge& judge) {
    const bool claimed = beyond[static_cast<std::size_t>(cell)] != 0;
    const bool in_safe = safe[static_cast<std::size_t>(cell)] != 0;
    const auto wrong = [&](const char* what) {
      tally.add_wrong(cell, [&] { return fmt::format("cell {}: {}", cell, what); });
    };
    if (!in_safe || !has(stretched_, cell)) {
      if (claimed != in_safe) wrong("not as in S");
      return;
    }
    tally.add_checked(1);
    const SafeVerdict verdict = has(lost_, cell) ? SafeVerdict::unsafe : judge.judge(cell, claimed);
    if (claimed && verdict == SafeVerdict::unsafe) wrong("not safe beyond the limit");
    if (claimed && verdict == SafeVerdict::open) tally.add_unproven();
    if (!claimed && verdict == SafeVerdict::safe) wrong("safe beyond the limit too");
  };
  team.for_each(grid_.cells(), 4096, [&](ThreadTeam::Range range, int worker) {
    auto& judge = judges[static_cast<std::size_t>(worker)];
    if (!judge) judge = std::make_unique<SafeJudge>(spec_, spec_.safe, grid_, memory);
    for (std::int64_t cell = range.begin; cell < range.end; ++cell) check_cell(cell, *judge);
  });
  return tally.finding();
}

}  // namespace coordreq
