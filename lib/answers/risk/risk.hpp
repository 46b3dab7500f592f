#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "answers/network/network_problem.hpp"
#include "answers/risk/expected_risk.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_rows.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {

struct RiskProblem {
  NetworkProblem network;
  const ExpectedRisks* expected = nullptr;
  std::int64_t horizon = 0;  ///< N
  bool is_safest = false;
};

/// Levels of 32 bits without margins, see risk_levels.hpp: V of one mode, kCertain outside K.
using RiskRows = LevelRows<std::uint32_t>;

/// How far the work has come.
struct RiskState {
  std::int64_t steps = 0;       ///< n
  std::vector<RiskRows> risks;  ///< [mode] V_n; of the rows that this process owns
};

struct Risk {
  std::vector<RiskRows> risks;  ///< [mode] V_N; of the rows that this process owns
  double rate = 0;
  WaveCounts counts;
};

/// Observes the work, and says where to take up work that was broken off.
struct RiskWatch {
  /// As WaveWatch::step, after each step of a mode; the state is V of all modes after `steps` whole steps.
  std::function<void(const WaveStep& step, std::int64_t steps)> step;
  /// A state that `step` was given, in the rows held; moved from. Null: begin with V_0.
  RiskState* resumed = nullptr;
};

/// V_0 in all rows held: 0 in K, else 1.
[[nodiscard]] std::vector<RiskRows> first_risks(const CellSet& invariant, std::size_t modes,
                                                const RowShare* share);

/// How likely the agents are to leave K within N steps: for x in K V_{n+1}(x,q) = OPT over u of max over y in
/// f(x,u) of E_q V_n(y,.), see ModeChoices and ExpectedRisk. A post that is blocked, and a cell without u,
/// count as 1; a post that has left for good through a safe side, and a cell of a goal that ends the task,
/// count as 0. This is value iteration for
/// reachability in n steps; losses are drawn after the worst y is known, for they do not depend on the
/// motion.
///
/// Rounded up once a step, so that no V is below the exact one. Synchronous, for V_n is the risk within n
/// steps; ends before N only after a step that has changed no V, since then no later step would.
///
/// `rate` is the least number with T(V_N) <= V_N + rate in all cells of K and modes, T being one more step in
/// double, rounded up: since T is monotone and T(v + c) <= T(v) + c, V_{N+n} <= V_N + n rate.
///
/// Memory: 4 bytes a cell for each mode and each different E_q (for the rate 8 bytes for one E_q at a time
/// instead), and the projections of C for all partitions.
[[nodiscard]] Risk find_risk(const RiskProblem& problem, const RiskWatch& watch, ThreadTeam& team);

/// E_q V: the risks before the mode of the next step is drawn, as one that follows q. In the rows that this
/// process owns.
[[nodiscard]] RiskRows drawn_risks(const ExpectedRisk& expected, const std::vector<RiskRows>& risks,
                                   const RowShare* share, ThreadTeam& team);

}  // namespace coordreq
