#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "cell/closed_loop.hpp"

namespace coordreq {

struct RunOptions {
  LoopOptions loop;
  std::int64_t runs = 1;
  /// The measured state that every run starts from; none: uniform over K, drawn for each run.
  std::optional<std::vector<Rational>> start;
};

/// Many runs in parallel; the same whatever the number of threads.
///
/// Uniform over K: a cell of K and a point of the cell [a, b), each with equal chances (the point on a
/// lattice of 2^-32 of the cell); drawn again if the point is beyond a `stop` limit, where no state is.
///
/// @pre `options.start` lies in a cell of K; K is not empty
/// @throws LimitError if an exact state grows too long
[[nodiscard]] std::vector<RunTrace> simulate_runs(const LoopProblem& problem, const RunOptions& options,
                                                  ThreadTeam& team);

}  // namespace coordreq
