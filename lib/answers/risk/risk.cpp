#include "answers/risk/risk.hpp"

#include <algorithm>
#include <bit>
#include <deque>
#include <utility>

#include "answers/risk/expected_levels.hpp"
#include "answers/risk/mode_risk.hpp"
#include "answers/risk/risk_levels.hpp"
#include "engine/row_operations.hpp"
#include "numeric/outward.hpp"

namespace coordreq {
namespace {

/// Rows that one thread takes at a time.
constexpr std::int64_t kTaskRows = 16;

/// Numbers of rows to be worked out.
using RowNumbers = std::vector<std::int64_t>;

/// Calls `body(row, worker)` for rows, those of a unit one after the other, with `enter(worker)` before each
/// unit.
template <class Enter, class Body>
void for_each_in_units(const RowEngine& engine, const RowNumbers& rows, ThreadTeam& team, const Enter& enter,
                       const Body& body) {
  team.for_each(std::ssize(rows), kTaskRows, [&](ThreadTeam::Range range, int worker) {
    std::int64_t unit = -1;
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const std::int64_t row = rows[static_cast<std::size_t>(i)];
      if (row / engine.unit_rows() != unit) enter(worker);
      unit = row / engine.unit_rows();
      body(row, worker);
    }
  });
}

class RiskIteration {
 public:
  RiskIteration(const RiskProblem& problem, const RiskWatch& watch, ThreadTeam& team)
      : problem_(problem),
        engine_(*problem.controller->engine),
        going_on_(*problem.controller->invariant),
        ends_early_(problem.controller->invariant != problem.invariant),
        watch_(watch),
        team_(team),
        choices_(*problem.controller, problem.partitions, problem.rules, problem.is_safest, team) {
    if (watch.resumed != nullptr) state_ = std::exchange(*watch.resumed, {});
    if (state_.risks.empty()) state_.risks = first_risks(*problem.invariant, modes(), engine_.share());
    const RowShare::Range own = own_rows(engine_.share(), engine_.rows());
    for (std::int64_t row = own.begin; row < own.end; ++row) {
      if (any_set(going_on_.row(row))) alive_.push_back(row);
    }
  }

  void run() {
    ExpectedLevels<std::uint32_t> expected(engine_, *problem_.expected);
    const auto operators = choices_.operators<std::uint32_t>(team_.size());
    std::deque<Worker<std::uint32_t>> workers;
    for (int w = 0; w < team_.size(); ++w) workers.emplace_back(engine_, expected.of(0));
    std::vector<std::vector<std::uint8_t>> changed(modes());
    while (state_.steps < problem_.horizon) {
      if (!expected.update(state_.risks, changed, team_)) break;
      for (std::size_t mode = 0; mode < modes(); ++mode) {
        changed[mode].assign(static_cast<std::size_t>(engine_.rows()), 0);
        step(mode, expected, *operators[problem_.partition_of[mode]], workers, changed[mode]);
      }
      ++state_.steps;
      tell();
    }
  }

  double rate() {
    ExpectedLevels<std::uint64_t> expected(engine_, *problem_.expected);
    const auto operators = choices_.operators<std::uint64_t>(team_.size());
    std::deque<Worker<std::uint64_t>> workers;
    for (int w = 0; w < team_.size(); ++w) workers.emplace_back(engine_, expected.of(0));
    for (std::size_t number = 0; number < problem_.expected->different.size(); ++number) {
      expected.load(number, state_.risks, team_);
      for (std::size_t mode = 0; mode < modes(); ++mode) {
        if (problem_.expected->of_mode[mode] != number) continue;
        compare(mode, expected, *operators[problem_.partition_of[mode]], workers);
      }
    }
    double greatest = 0;
    for (const auto& worker : workers) greatest = std::max(greatest, worker.rate);
    if (engine_.share() == nullptr) return greatest;
    // The bits of numbers that are not negative have the same order as the numbers.
    return std::bit_cast<double>(engine_.share()->ranks().greatest(std::bit_cast<std::int64_t>(greatest)));
  }

  Risk result(double rate) {
    counts_.rows_visited = sum_of_all(engine_.share(), counts_.rows_visited);
    counts_.rows_skipped = sum_of_all(engine_.share(), counts_.rows_skipped);
    return {std::move(state_.risks), rate, counts_};
  }

 private:
  template <class Level>
  struct Worker {
    Worker(const RowEngine& engine, const LevelRows<Level>& levels)
        : posts(engine, levels),
          next(posts.lanes(), 0),
          lanes(posts.lanes(), 0),
          risks(posts.lanes(), kCertain<Level>) {}
    PostReader<Level> posts;
    std::vector<Level> next;
    std::vector<Level> lanes;
    std::vector<Level> risks;
    double rate = 0;
  };

  [[nodiscard]] std::size_t modes() const { return problem_.partition_of.size(); }

  /// The rows whose posts can meet one of those that have changed.
  [[nodiscard]] RowNumbers pending_rows(const std::vector<std::uint8_t>& changed) const {
    std::vector<std::uint8_t> is_pending(alive_.size(), 0);
    team_.for_each(std::ssize(alive_), 256, [&](ThreadTeam::Range range, int) {
      RowBox box;
      std::vector<std::int64_t> counter;
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        const auto k = static_cast<std::size_t>(i);
        problem_.hull->box(RowPlace(engine_.grid(), alive_[k]), box);
        const auto has_changed = [&](std::int64_t row) {
          return changed[static_cast<std::size_t>(row)] != 0;
        };
        is_pending[k] = any_row(engine_.grid(), 0, box.ranges, counter, has_changed) ? 1 : 0;
      }
    });
    RowNumbers rows;
    for (std::size_t k = 0; k < alive_.size(); ++k) {
      if (is_pending[k] != 0) rows.push_back(alive_[k]);
    }
    return rows;
  }

  /// Finds V_{n+1} of one mode, and the rows that it changes.
  void step(std::size_t mode, const ExpectedLevels<std::uint32_t>& expected, ModeRisk<std::uint32_t>& choices,
            std::deque<Worker<std::uint32_t>>& workers, std::vector<std::uint8_t>& changed) {
    const std::size_t number = problem_.expected->of_mode[mode];
    // The first step visits all rows: those whose posts meet no row may still have forbidden joint inputs.
    const RowNumbers rows = state_.steps == 0 ? alive_ : pending_rows(expected.changed(number));
    const auto n = static_cast<std::size_t>(engine_.row_length());
    for_each_in_units(
        engine_, rows, team_,
        [&](int w) { workers[static_cast<std::size_t>(w)].posts.enter(expected.of(number)); },
        [&](std::int64_t row, int w) {
          Worker<std::uint32_t>& worker = workers[static_cast<std::size_t>(w)];
          find(row, choices, worker, w);
          const std::uint32_t* const own = state_.risks[mode].row(row);
          if (std::equal(own, own + n, worker.risks.begin())) return;
          state_.risks[mode].put(row, worker.risks.data());
          changed[static_cast<std::size_t>(row)] = 1;
        });
    const auto visited = std::ssize(rows), alive = std::ssize(alive_);
    ++counts_.sweeps;
    counts_.rows_visited += visited;
    counts_.rows_skipped += alive - visited;
    step_ = {.sweep = counts_.sweeps, .visited = visited, .rows = alive};
    if (mode + 1 < modes() && watch_.step) watch_.step(step_, state_.steps);
  }

  /// worker.risks = one more step of a row: kCertain outside K, 0 risk where the task is over.
  template <class Level>
  void find(std::int64_t row, ModeRisk<Level>& choices, Worker<Level>& worker, int w) const {
    const auto n = static_cast<std::size_t>(engine_.row_length());
    choices.find(RowPlace(engine_.grid(), row), worker.posts, worker.next.data(), w);
    const LevelKernels<Level>& kernels = worker.posts.kernels();
    kernels.spread(going_on_.row(row).data(), worker.lanes.data(), n);
    std::fill(worker.risks.begin(), worker.risks.end(), kCertain<Level>);
    kernels.raise_where(worker.next.data(), worker.lanes.data(), worker.risks.data(), n);
    if (!ends_early_) return;
    for_each_bit(problem_.invariant->row(row), [&](std::int64_t x) {
      if (worker.lanes[static_cast<std::size_t>(x)] == 0)
        worker.risks[static_cast<std::size_t>(x)] = LevelRows<Level>::kTop;
    });
  }

  /// Raises worker.rate to the most by which one more step of a mode goes beyond V.
  void compare(std::size_t mode, const ExpectedLevels<std::uint64_t>& expected,
               ModeRisk<std::uint64_t>& choices, std::deque<Worker<std::uint64_t>>& workers) const {
    const std::size_t number = problem_.expected->of_mode[mode];
    for_each_in_units(
        engine_, alive_, team_,
        [&](int w) { workers[static_cast<std::size_t>(w)].posts.enter(expected.of(number)); },
        [&](std::int64_t row, int w) {
          Worker<std::uint64_t>& worker = workers[static_cast<std::size_t>(w)];
          find(row, choices, worker, w);
          const std::uint32_t* const own = state_.risks[mode].row(row);
          for_each_bit(going_on_.row(row), [&](std::int64_t x) {
            const double more =
                outward::add_up(risk_of(worker.risks[static_cast<std::size_t>(x)]), -double{risk_of(own[x])});
            worker.rate = std::max(worker.rate, more);
          });
        });
  }

  /// Reports a whole step.
  void tell() {
    if (!watch_.step) return;
    std::vector<NumberRows> rows;
    for (const RiskRows& risks : state_.risks) rows.push_back(rows_of(risks));
    step_.state = rows;
    watch_.step(step_, state_.steps);
    step_.state = {};
  }

  const RiskProblem& problem_;
  const RowEngine& engine_;
  const CellSet& going_on_;  ///< the cells whose posts are looked at
  bool ends_early_;          ///< going_on_ is not all of K
  const RiskWatch& watch_;
  ThreadTeam& team_;
  ModeChoices choices_;
  RiskState state_;
  RowNumbers alive_;  ///< own rows that have cells in K
  WaveStep step_;
  WaveCounts counts_;
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
  iteration.run();
  return iteration.result(iteration.rate());
}

RiskRows drawn_risks(const ExpectedRisk& expected, const std::vector<RiskRows>& risks, const RowShare* share,
                     ThreadTeam& team) {
  const auto n = static_cast<std::size_t>(risks.front().row_length());
  RiskRows drawn(risks.front().rows(), risks.front().row_length(), RowMargins{}, RowEnds{});
  for_each_own_row(team, share, drawn.rows(), kTaskRows, [&](ThreadTeam::Range range, int) {
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
