#include "answers/goal/showing_order.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "answers/goal/best_steps.hpp"
#include "base/requires.hpp"
#include "engine/level_messages.hpp"

namespace coordreq {
namespace {

using Order = LevelRows<std::uint32_t>;

template <class Level>
std::vector<Level> whole_row(std::int64_t length) {
  return std::vector<Level>(static_cast<std::size_t>(length) + kLevelBlock / sizeof(Level));
}

/// Calls `change(row)` for the rows that this process holds.
template <class Change>
void for_each_held(const RowShare* share, std::int64_t rows, const Change& change) {
  for (const RowShare::Range run : held_rows(share, rows)) {
    for (std::int64_t r = run.begin; r < run.end; ++r) change(r);
  }
}

Word bit_of(std::int64_t x) {
  return Word{1} << (x % CellSet::kWordBits);
}

/// The rounds of `stay`, all cells of a round at once.
template <class Level>
class StayRounds {
 public:
  StayRounds(const LastingProblem& problem, const LevelRows<Level>& nearness, ThreadTeam& team)
      : problem_(problem),
        engine_(problem.progress->engine()),
        nearness_(nearness),
        team_(team),
        visible_(engine_.make_levels<Level>(engine_.posts())),
        order_(engine_.make_levels<std::uint32_t>(engine_.posts())),
        open_(nearness.rows(), nearness.row_length()) {}

  LevelMap run() {
    begin();
    const ActionGrouping grouping(engine_, single_classes(engine_.abstraction().inputs), team_);
    for (std::uint32_t round = 1; find(grouping) > 0; ++round) {
      REQUIRES(round < Order::kTop);
      take(round);
    }
    return LevelMap(std::move(order_));
  }

 private:
  /// In G nothing is shown yet.
  void begin() {
    auto cells = whole_row<Level>(nearness_.row_length());
    for_each_held(nearness_.share(), nearness_.rows(), [&](std::int64_t r) {
      const Level* const nearness = nearness_.row(r);
      auto numbers = whole_row<std::uint32_t>(nearness_.row_length());
      std::copy_n(nearness, nearness_.row_length(), cells.begin());
      const MutableRow open = open_.row(r);
      for_each_bit(problem_.goal->row(r), [&](std::int64_t x) {
        const auto lane = static_cast<std::size_t>(x);
        cells[lane] = LevelRows<Level>::kTop;
        numbers[lane] = Order::kTop;
        if (nearness[x] < LevelRows<Level>::kTop) open[lane / CellSet::kWordBits] |= bit_of(x);
      });
      visible_.put(r, cells.data());
      order_.put(r, numbers.data());
    });
  }

  /// Finds the own cells of the next round. @returns how many there are, of all processes
  std::int64_t find(const ActionGrouping& grouping) {
    of_round_ = CellSet(nearness_.rows(), nearness_.row_length());
    for_each_best(problem_, grouping, visible_, open_, team_,
                  [&](const RowPosition& position, PostReader<Level>&, const Level* best, int) {
                    const Level* const nearness = nearness_.row(position.row);
                    const MutableRow of_round = of_round_.row(position.row);
                    for_each_bit(open_.row(position.row), [&](std::int64_t x) {
                      if (best[x] <= nearness[x])
                        of_round[static_cast<std::size_t>(x / CellSet::kWordBits)] |= bit_of(x);
                    });
                  });
    const RowShare::Range local = local_rows(nearness_.share(), of_round_.rows());
    return sum_of_all(nearness_.share(), of_round_.count(local.begin, local.end));
  }

  void take(std::uint32_t round) {
    const RowShare::Range local = local_rows(nearness_.share(), of_round_.rows());
    for (std::int64_t r = local.begin; r < local.end; ++r) {
      if (any_set(of_round_.row(r))) show(r, round);
    }
    if (nearness_.share() == nullptr) return;
    LevelMessages<Level>(visible_).exchange(
        [this](std::int64_t row) { return any_set(of_round_.row(row)); },
        [&](std::int64_t row, const Level* others) {
          const MutableRow of_round = of_round_.row(row);
          const Level* const before = visible_.row(row);
          for_each_bit(problem_.goal->row(row), [&](std::int64_t x) {
            if (others[x] != before[x])
              of_round[static_cast<std::size_t>(x / CellSet::kWordBits)] |= bit_of(x);
          });
          show(row, round);
        });
  }

  /// Shows the cells of a row that were found.
  void show(std::int64_t r, std::uint32_t round) {
    const ConstRow of_round = of_round_.row(r);
    const MutableRow open = open_.row(r);
    visible_.change_row(r, [&](Level* cells) {
      for_each_bit(of_round, [&](std::int64_t x) { cells[x] = nearness_.row(r)[x]; });
    });
    order_.change_row(
        r, [&](std::uint32_t* cells) { for_each_bit(of_round, [&](std::int64_t x) { cells[x] = round; }); });
    for (std::size_t w = 0; w < of_round.size(); ++w) open[w] &= ~of_round[w];
  }

  const LastingProblem& problem_;
  const RowEngine& engine_;
  const LevelRows<Level>& nearness_;
  ThreadTeam& team_;
  LevelRows<Level> visible_;  ///< nearness outside G and in cells of earlier rounds, else kTop
  Order order_;
  CellSet open_;      ///< cells of G that are in no round yet
  CellSet of_round_;  ///< cells of this round
};

LevelMap order_of_return(const LastingProblem& problem, ThreadTeam& team) {
  const RowEngine& engine = problem.progress->engine();
  auto order = engine.make_levels<std::uint32_t>(engine.posts());
  const std::int64_t length = order.row_length();
  auto numbers = whole_row<std::uint32_t>(length);
  std::fill(numbers.begin(), numbers.end(), Order::kTop);
  for_each_held(order.share(), order.rows(), [&](std::int64_t r) { order.put(r, numbers.data()); });
  std::uint32_t round = 0;
  const auto after_round = [&](const LevelMap& nearness) {
    ++round;
    nearness.visit([&]<class Level>(const LevelRows<Level>& levels) {
      for_each_held(levels.share(), levels.rows(), [&](std::int64_t r) {
        const Level* const row = levels.row(r);
        order.change_row(r, [&](std::uint32_t* cells) {
          levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
            for (std::int64_t x = lane; x < lane + count; ++x) {
              if (row[x] == 1 && cells[x] == Order::kTop) cells[x] = round;
            }
          });
        });
      });
    });
  };
  WaveCounts counts;
  static_cast<void>(find_return_nearness(problem, {}, team, counts, after_round));
  return LevelMap(std::move(order));
}

}  // namespace

LevelMap find_showing_order(const LastingProblem& problem, const LevelMap& nearness, GoalThen then,
                            ThreadTeam& team) {
  if (then == GoalThen::come_back) return order_of_return(problem, team);
  return nearness.visit([&]<class Level>(const LevelRows<Level>& levels) {
    return StayRounds<Level>(problem, levels, team).run();
  });
}

}  // namespace coordreq
