#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/check_context.hpp"
#include "answers/checking/post_table.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"
#include "spec/spec_types.hpp"
#include "verify/analysis_tables.hpp"
#include "verify/budget.hpp"

namespace coordreq {

/// True if every cell of `inner` is one of `outer`, in a periodic dimension after wrapping round.
[[nodiscard]] bool holds(const GridDimension& dimension, IndexRange outer, IndexRange inner);

/// Compares a table with the verifier's own, exact one of the same state: both have to be equal in all that
/// the latter has.
/// @param what the name of the check, before that of the state
[[nodiscard]] Finding check_abstraction(const UniformGrid& grid, const InputSpace& inputs, std::size_t state,
                                        const PostTable& posts, const PostTable& claimed,
                                        const std::string& what);

/// Shows one cell after the other to all checks.
/// @param cells ascending; empty: all
/// @param budget null: no matter what it takes; else blocks of cells from all over the grid until it is over
/// @param progress may be empty; called by the caller's thread
/// @returns how many were shown
std::int64_t check_cells(const CheckContext& context, const std::vector<std::unique_ptr<AnswerCheck>>& checks,
                         const std::vector<std::int64_t>& cells, Budget* budget,
                         const std::function<void(std::int64_t done, std::int64_t all)>& progress,
                         ThreadTeam& team);

/// The work of finding the posts that checks rest on, roughly.
struct WorkOfPosts {
  Work of_all = 0;
  Work of_cell = 0;  ///< those of one cell, with all inputs
};
/// @param stored the file has posts that are not exact, which need not be found then
[[nodiscard]] WorkOfPosts work_of_posts(const ProblemSpec& spec, const UniformGrid& grid,
                                        const InputSpace& inputs, bool stored);

/// The ways between the samples that the checks of cells rest on.
struct CheckedTubes {
  std::vector<PostTable> tables;      ///< one a state: the tubes of the analysis
  std::vector<std::uint8_t> beyond;   ///< [cell]: safe for tubes that pass a limit where a state saturates
  bool exact = true;                  ///< no tube could be smaller
  std::vector<std::string> borrowed;  ///< states without tubes of the verifier's own
  std::vector<Finding> findings;
};

/// Takes the tubes of an abstraction and what is safe beyond its limits, which no results file stores, and
/// checks both by another route.
/// @param analysis of `spec`, with tubes
/// @param safe S as the file has it
[[nodiscard]] CheckedTubes check_tubes(const ProblemSpec& spec, const UniformGrid& grid,
                                       const InputSpace& inputs, AnalysisTables& analysis,
                                       const std::vector<std::uint8_t>& safe, Budget& budget,
                                       ThreadTeam& team);

}  // namespace coordreq
