#include "verify/checks.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "answers/invariance/safe_tubes.hpp"
#include "spec/problem_spec.hpp"
#include "verify/check_tube.hpp"
#include "verify/reference_posts.hpp"
#include "verify/safe_beyond.hpp"

namespace coordreq {
namespace {

/// Whether it makes a difference that tubes go on beyond limits (see safe_beyond_limits()).
bool may_go_beyond(const ProblemSpec& spec) {
  const std::vector<std::uint32_t> states = spec.safe.variables();
  return spec.abstraction.safe != Membership::center &&
         std::any_of(states.begin(), states.end(),
                     [&](std::uint32_t i) { return spec.states[i].has(Outside::saturate); });
}

std::vector<std::uint8_t> beyond_limits(const ProblemSpec& spec, const Abstraction& analysis,
                                        const std::vector<std::uint8_t>& safe, ThreadTeam& team) {
  CellSet set(analysis.grid.rows(), analysis.grid.row_length());
  for (std::size_t x = 0; x < safe.size(); ++x) {
    if (safe[x] != 0) set.set(static_cast<std::int64_t>(x));
  }
  const std::optional<CellSet> beyond = safe_beyond_limits(spec, analysis, set, team);
  if (!beyond) return safe;
  std::vector<std::uint8_t> result(safe.size());
  for (std::size_t x = 0; x < safe.size(); ++x)
    result[x] = beyond->test(static_cast<std::int64_t>(x)) ? 1 : 0;
  return result;
}

/// How far any tube goes beyond a limit is a question about all of them.
Finding find_beyond(const ProblemSpec& spec, const UniformGrid& grid, AnalysisTables& analysis,
                    const std::vector<std::uint8_t>& safe, CheckedTubes& result, ThreadTeam& team) {
  std::vector<PostTable> tables;
  for (std::size_t i = 0; i < grid.size(); ++i) tables.push_back(analysis.whole_tubes(i));
  result.beyond = beyond_limits(spec, analysis.whole(), safe, team);
  return SafeBeyond(spec, grid, tables).check(safe, result.beyond, team);
}

}  // namespace

CheckedTubes check_tubes(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                         AnalysisTables& analysis, const std::vector<std::uint8_t>& safe, Budget& budget,
                         ThreadTeam& team) {
  CheckedTubes result{.tables = {}, .beyond = safe};
  std::optional<Finding> beyond;
  if (may_go_beyond(spec)) beyond = find_beyond(spec, grid, analysis, safe, result, team);
  for (std::size_t i = 0; i < grid.size(); ++i) result.tables.push_back(analysis.tubes(i));
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const PostQuestion question{.spec = &spec,
                                .grid = &grid,
                                .inputs = &inputs,
                                .state = i,
                                .claimed = &result.tables[i],
                                .cells = &analysis.cells(),
                                .check = "tubes " + grid[i].name};
    std::optional<TubeFinding> found = check_corner_tubes(question, team);
    if (!found) {
      Budget fraction = budget.fraction(1, static_cast<std::int64_t>(grid.size() - i));
      found = check_outward_tubes(question, fraction, team);
      budget.settle(fraction);
    }
    result.exact = result.exact && found && found->exact;
    if (found) {
      result.findings.push_back(std::move(found->finding));
    } else {
      result.borrowed.push_back(grid[i].name);
    }
  }
  if (beyond && (beyond->checked > 0 || beyond->wrong > 0)) result.findings.push_back(std::move(*beyond));
  return result;
}

}  // namespace coordreq
