#include "verify/check_tubes.hpp"

#include <optional>

#include "answers/invariance/safe_tubes.hpp"
#include "verify/check_tube.hpp"
#include "verify/own_posts.hpp"
#include "verify/safe_beyond.hpp"

namespace coordreq {
namespace {

std::vector<PostTable> tables_of(const ProblemSpec& spec, const Abstraction& analysis) {
  const Abstraction tubes{.grid = analysis.grid, .inputs = analysis.inputs, .tables = analysis.tubes};
  std::vector<PostTable> tables;
  for (std::size_t i = 0; i < analysis.grid.size(); ++i) {
    PostTable& table =
        tables.emplace_back(empty_table(analysis.grid, analysis.inputs, influences_on(spec, i)));
    table.exact = false;
    table.entries = written_out(tubes, i).entries;
  }
  return tables;
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

}  // namespace

CheckedTubes check_tubes(const ProblemSpec& spec, const Abstraction& analysis,
                         const std::vector<std::uint8_t>& safe, const std::vector<std::int64_t>& cells,
                         const Budget& budget, ThreadTeam& team) {
  CheckedTubes result{.tables = tables_of(spec, analysis),
                      .beyond = beyond_limits(spec, analysis, safe, team)};
  const UniformGrid& grid = analysis.grid;
  const InputSpace& inputs = analysis.inputs;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const PostQuestion question{.spec = &spec,
                                .grid = &grid,
                                .inputs = &inputs,
                                .state = i,
                                .claimed = &result.tables[i],
                                .cells = &cells,
                                .budget = &budget,
                                .check = "tubes " + grid[i].name};
    std::optional<TubeFinding> found = check_corner_tubes(question, team);
    if (!found) found = check_outward_tubes(question, team);
    result.exact = result.exact && found && found->exact;
    if (found) {
      result.findings.push_back(std::move(found->finding));
    } else {
      result.borrowed.push_back(grid[i].name);
    }
  }
  Finding beyond = SafeBeyond(spec, grid, result.tables).check(safe, result.beyond, team);
  if (beyond.checked > 0 || beyond.wrong > 0) result.findings.push_back(std::move(beyond));
  return result;
}

}  // namespace coordreq
