#include "answers/risk/risk.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "answers/network/mode_sweep.hpp"
#include "answers/risk/expected_levels.hpp"
#include "answers/risk/risk_levels.hpp"
#include "engine/row_operations.hpp"
#include "numeric/outward.hpp"

namespace coordreq {
namespace {

class RiskIteration {
 public:
  RiskIteration(const RiskProblem& problem, const RiskWatch& watch, ThreadTeam& team)
      : problem_(problem),
        engine_(*problem.network.controller->engine),
        invariant_(*problem.network.invariant),
        nonterminal_(*problem.network.controller->invariant),
        watch_(watch),
        team_(team),
        choices_(problem.network, problem.is_safest ? Agreement::safest : Agreement::none, team) {
    if (watch.resumed != nullptr) state_ = std::exchange(*watch.resumed, {});
    if (state_.risks.empty()) state_.risks = first_risks(invariant_, modes(), engine_.share());
  }

  Risk run() {
    ExpectedLevels<std::uint32_t> expected(engine_, *problem_.expected);
    ModeSweep<std::uint32_t> sweep(problem_.network, choices_, expected.of(0), team_);
    std::vector<std::vector<std::uint8_t>> changed(modes());
    while (state_.steps < problem_.horizon) {
      if (!expected.update(state_.risks, changed, team_)) break;
      for (std::size_t mode = 0; mode < modes(); ++mode) {
        if (mode > 0) report(sweep, 0);
        changed[mode].assign(static_cast<std::size_t>(engine_.rows()), 0);
        step(mode, expected, sweep, changed[mode]);
      }
      ++state_.steps;
      report(sweep, modes());
    }
    return {.risks = {}, .rate = 0, .counts = sweep.counts()};
  }

  double rate() {
    ExpectedLevels<std::uint64_t> expected(engine_, *problem_.expected);
    ModeSweep<std::uint64_t> sweep(problem_.network, choices_, expected.of(0), team_);
    std::vector<double> rates(static_cast<std::size_t>(team_.size()), 0);
    for (std::size_t number = 0; number < problem_.expected->different.size(); ++number) {
      expected.load(number, state_.risks, team_);
      for (std::size_t mode = 0; mode < modes(); ++mode) {
        if (problem_.expected->of_mode[mode] == number) compare(mode, expected, sweep, rates);
      }
    }
    const double greatest = *std::ranges::max_element(rates);
    if (engine_.share() == nullptr) return greatest;
    // The bits of numbers that are not negative have the same order as the numbers.
    return std::bit_cast<double>(engine_.share()->ranks().greatest(std::bit_cast<std::int64_t>(greatest)));
  }

  [[nodiscard]] std::vector<RiskRows> take_risks() { return std::move(state_.risks); }

 private:
  [[nodiscard]] std::size_t modes() const { return problem_.network.modes.size(); }

  /// Finds V_{n+1} of one mode, and the rows that it changes.
  void step(std::size_t mode, const ExpectedLevels<std::uint32_t>& expected, ModeSweep<std::uint32_t>& sweep,
            std::vector<std::uint8_t>& changed) {
    const std::size_t number = problem_.expected->of_mode[mode];
    const std::vector<std::uint8_t>& meets_changes = expected.changed(number);
    // The first step visits all rows: those whose posts meet no row may still have forbidden joint inputs.
    const PendingRows rows = pending_rows(
        problem_.network, nonterminal_, state_.steps == 0,
        [&](std::int64_t row) { return meets_changes[static_cast<std::size_t>(row)] != 0; }, team_);
    const auto n = static_cast<std::size_t>(engine_.row_length());
    const std::vector<std::uint32_t> certain(n + kLevelBlock, kCertain<std::uint32_t>);
    sweep.run(mode, expected.of(number), rows, invariant_, [&](std::int64_t row, std::uint32_t* next, int) {
      sweep.kernels().raise(certain.data(), next, n);
      if (std::equal(next, next + n, state_.risks[mode].row(row))) return;
      state_.risks[mode].put(row, next);
      changed[static_cast<std::size_t>(row)] = 1;
    });
  }

  /// Raises the rate of a worker to the most by which one more step of a mode goes beyond V.
  void compare(std::size_t mode, const ExpectedLevels<std::uint64_t>& expected,
               ModeSweep<std::uint64_t>& sweep, std::vector<double>& rates) const {
    const auto all = [](std::int64_t) { return true; };
    const PendingRows rows = pending_rows(problem_.network, nonterminal_, true, all, team_);
    const auto raise = [&](std::int64_t row, const std::uint64_t* next, int w) {
      double& rate = rates[static_cast<std::size_t>(w)];
      const std::uint32_t* const present = state_.risks[mode].row(row);
      for_each_bit(nonterminal_.row(row), [&](std::int64_t x) {
        rate = std::max(rate, outward::add_up(risk_of(next[x]), -double{risk_of(present[x])}));
      });
    };
    sweep.run(mode, expected.of(problem_.expected->of_mode[mode]), rows, invariant_, raise);
  }

  /// Reports a step of a mode; with the state of all modes after a whole one.
  void report(const ModeSweep<std::uint32_t>& sweep, std::size_t modes) const {
    if (!watch_.step) return;
    sweep.report([this](const WaveStep& step) { watch_.step(step, state_.steps); },
                 std::span<const RiskRows>(state_.risks).first(modes));
  }

  const RiskProblem& problem_;
  const RowEngine& engine_;
  const CellSet& invariant_;
  const CellSet& nonterminal_;  ///< the cells whose posts are looked at
  const RiskWatch& watch_;
  ThreadTeam& team_;
  ModeChoices choices_;
  RiskState state_;
};

}  // namespace

std::vector<RiskRows> first_risks(const CellSet& invariant, std::size_t modes, const RowShare* share) {
  const auto n = static_cast<std::size_t>(invariant.row_length());
  std::vector<std::uint32_t> lanes(n + kLevelBlock);
  std::vector<RiskRows> risks;
  for (std::size_t mode = 0; mode < modes; ++mode)
    risks.emplace_back(invariant.rows(), invariant.row_length(), RowMargins{}, RowEnds{});
  for (const RowShare::Range run : held_rows(share, invariant.rows())) {
    for (std::int64_t row = run.begin; row < run.end; ++row) {
      std::fill(lanes.begin(), lanes.end(), kCertain<std::uint32_t>);
      for_each_bit(invariant.row(row),
                   [&](std::int64_t x) { lanes[static_cast<std::size_t>(x)] = RiskRows::kTop; });
      for (RiskRows& rows : risks) rows.put(row, lanes.data());
    }
  }
  return risks;
}

Risk find_risk(const RiskProblem& problem, const RiskWatch& watch, ThreadTeam& team) {
  RiskIteration iteration(problem, watch, team);
  Risk risk = iteration.run();
  risk.rate = iteration.rate();
  risk.risks = iteration.take_risks();
  return risk;
}

RiskRows drawn_risks(const ExpectedRisk& expected, const std::vector<RiskRows>& risks, const RowShare* share,
                     ThreadTeam& team) {
  const auto n = static_cast<std::size_t>(risks.front().row_length());
  RiskRows drawn(risks.front().rows(), risks.front().row_length(), RowMargins{}, RowEnds{});
  for_each_local_row(team, share, drawn.rows(), 64, [&](ThreadTeam::Range range, int) {
    std::vector<std::uint32_t> lanes(n + kLevelBlock);
    std::vector<const std::uint32_t*> rows(expected.successors().size());
    for (std::int64_t row = range.begin; row < range.end; ++row) {
      std::ranges::transform(expected.successors(), rows.begin(),
                             [&](std::size_t mode) { return risks[mode].row(row); });
      expected.find(rows, n, lanes.data());
      drawn.put(row, lanes.data());
    }
  });
  return drawn;
}

}  // namespace coordreq
