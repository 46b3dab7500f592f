#include "answers/convention/convention_freedom.hpp"

#include <algorithm>
#include <cstring>
#include <deque>
#include <limits>
#include <numeric>

#include "answers/convention/convention_row.hpp"
#include "base/requires.hpp"
#include "choices/action_bits.hpp"
#include "engine/action_groups.hpp"
#include "engine/level_map.hpp"
#include "engine/packed_pairs.hpp"

namespace coordreq {
namespace {

using Histogram = std::array<std::int64_t, 10>;

/// Sums over the rows of one thread.
struct Count {
  std::int64_t full = 0;
  Histogram histogram{};
};

/// The sizes of sets of actions in every cell of a row.
void count_actions(const ActionGroups& groups, const std::vector<Word>& rows, std::size_t words,
                   std::vector<std::int32_t>& sizes) {
  std::vector<std::int32_t> members(groups.size(), 0);
  for (const std::uint32_t g : groups.group_of) ++members[g];
  std::fill(sizes.begin(), sizes.end(), 0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for_each_bit(ConstRow(rows.data() + g * words, words),
                 [&](std::int64_t x) { sizes[static_cast<std::size_t>(x)] += members[g]; });
  }
}

/// Writes the freedom of one agent in one row, and adds up its values.
class Measure {
 public:
  explicit Measure(std::int64_t row_length)
      : kept_(static_cast<std::size_t>(row_length)), all_(static_cast<std::size_t>(row_length)) {}

  /// @param rows how many there are like this one
  /// @returns the sum over the row, from the first cell on
  double measure(const ConventionRow& row, std::size_t agent, ConstRow invariant, std::int64_t rows,
                 float* freedom, Count& count) {
    const ActionGroups& groups = *row.groups.classes[agent];
    count_actions(groups, row.kept[agent], invariant.size(), kept_);
    count_actions(groups, row.projection[agent], invariant.size(), all_);
    double sum = 0;
    for_each_bit(invariant, [&](std::int64_t x) {
      const std::int64_t kept = kept_[static_cast<std::size_t>(x)];
      const std::int64_t all = all_[static_cast<std::size_t>(x)];
      const double ratio = static_cast<double>(kept) / static_cast<double>(all);
      freedom[x] = static_cast<float>(ratio);
      sum += ratio;
      if (kept == all) count.full += rows;
      count.histogram[static_cast<std::size_t>((10 * kept + all - 1) / all - 1)] += rows;
    });
    return sum;
  }

 private:
  std::vector<std::int32_t> kept_;
  std::vector<std::int32_t> all_;
};

/// The sum of the rows of all processes, in their order, so that it does not depend on which process has
/// found which row.
double sum_of_rows(const std::vector<double>& rows, const RowShare* share) {
  if (share == nullptr) return std::accumulate(rows.begin(), rows.end(), 0.0);
  Ranks& ranks = share->ranks();
  double sum = 0;
  if (ranks.rank() > 0) {
    const Bytes before = ranks.receive(ranks.rank() - 1);
    std::memcpy(&sum, MessageReader(before).take(sizeof(sum)).data(), sizeof(sum));
  }
  sum = std::accumulate(rows.begin(), rows.end(), sum);
  Bytes message;
  put_numbers<double>(message, {&sum, 1});
  const int last = ranks.count() - 1;
  if (ranks.rank() < last) ranks.send(ranks.rank() + 1, message);
  // The last rank sends the sum to the first, which sends it to all.
  if (ranks.rank() == last && last > 0) ranks.send(0, message);
  if (ranks.rank() == 0 && last > 0) message = ranks.receive(last);
  message = ranks.from_first(std::move(message));
  std::memcpy(&sum, message.data(), sizeof(sum));
  return sum;
}

/// @param cells of K that were looked at here
void add_up(const std::vector<std::vector<Count>>& counts, const std::vector<std::vector<double>>& sums,
            const RowShare* share, std::int64_t cells, ConventionFreedom& result) {
  cells = sum_of_all(share, cells);
  for (std::size_t i = 0; i < result.agents.size(); ++i) {
    ConventionFreedom::Agent& agent = result.agents[i];
    for (const std::vector<Count>& worker : counts) {
      agent.full += worker[i].full;
      for (std::size_t k = 0; k < agent.histogram.size(); ++k) agent.histogram[k] += worker[i].histogram[k];
    }
    if (share != nullptr) {
      agent.full = share->ranks().sum(agent.full);
      share->ranks().add(agent.histogram);
    }
    if (cells == 0) continue;
    agent.mean = sum_of_rows(sums[i], share) / static_cast<double>(cells);
  }
}

/// Rows with equal results.
struct LikeRows {
  std::vector<std::int64_t> first;  ///< [own row] the first row like it; -1: it has no cell of K
  std::vector<std::int64_t> count;  ///< [own row] number of rows like it; of first rows alone
};

LikeRows find_like_rows(const CellSet& invariant, RowShare::Range local, const RowShare* share,
                        const Tiles* tiles, ThreadTeam& team) {
  const auto rows = static_cast<std::size_t>(local.end - local.begin);
  LikeRows like{std::vector<std::int64_t>(rows, -1), std::vector<std::int64_t>(rows, 0)};
  Tiles::Numbers classes;
  if (tiles != nullptr)
    classes = tiles->refined(tiles->tables(), number_rows(invariant, share, &team), &team);
  const auto has = [&](std::int64_t row) { return any_set(invariant.row(row)); };
  for_each_with_first(tiles, classes, local, has, [&](std::int64_t row, std::int64_t first) {
    like.first[static_cast<std::size_t>(row - local.begin)] = first;
    ++like.count[static_cast<std::size_t>(first - local.begin)];
  });
  return like;
}

/// Copies the results of the first of like rows to the others.
void copy_to_like_rows(const LikeRows& like, std::int64_t begin, std::int64_t length, ThreadTeam& team,
                       std::vector<std::vector<double>>& sums, ConventionFreedom& result) {
  const auto rows = static_cast<std::int64_t>(like.first.size());
  team.for_each(rows, 64, [&](ThreadTeam::Range range, int) {
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      const std::int64_t row = begin + k, first = like.first[static_cast<std::size_t>(k)];
      if (first < 0 || first == row) continue;
      for (std::size_t i = 0; i < sums.size(); ++i) {
        float* const freedom = result.agents[i].freedom.data();
        std::copy_n(freedom + first * length, length, freedom + row * length);
        sums[i][static_cast<std::size_t>(k)] = sums[i][static_cast<std::size_t>(first - begin)];
      }
    }
  });
}

}  // namespace

ConventionFreedom find_convention(const Controller& controller, const ActionGrouping& agents,
                                  ThreadTeam& team, const Tiles* tiles) {
  REQUIRES(tiles == nullptr || controller.approaches || &controller.target() == controller.invariant);
  const RowEngine& engine = *controller.engine;
  const RowShare::Range local = local_rows(engine.share(), engine.rows());
  ConventionFreedom result;
  result.agents.resize(agents.size());
  for (ConventionFreedom::Agent& agent : result.agents) {
    agent.freedom = ZeroedArray<float>(static_cast<std::size_t>(engine.grid().cells()));
    std::fill(agent.freedom.begin() + local.begin * engine.row_length(),
              agent.freedom.begin() + local.end * engine.row_length(),
              std::numeric_limits<float>::quiet_NaN());
  }
  std::vector<std::vector<Count>> counts(static_cast<std::size_t>(team.size()),
                                         std::vector<Count>(agents.size()));
  std::vector<std::vector<double>> sums(
      agents.size(), std::vector<double>(static_cast<std::size_t>(local.end - local.begin), 0));
  const LikeRows like = find_like_rows(*controller.invariant, local, engine.share(), tiles, team);
  controller.levels->visit([&]<class Level>(const LevelRows<Level>& levels) {
    std::deque<ConventionRows<Level>> finders;
    const PostReader<Level> posts(engine, levels);
    for (int w = 0; w < team.size(); ++w) finders.emplace_back(controller, agents, levels, posts);
    posts.for_each_local_row(team, [&](ThreadTeam::Range range, int worker) {
      ConventionRows<Level>& finder = finders[static_cast<std::size_t>(worker)];
      ConventionRow row;
      Measure measure(engine.row_length());
      for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
           position.advance(engine.grid())) {
        const auto k = static_cast<std::size_t>(position.row - local.begin);
        if (like.first[k] != position.row) continue;
        const ConstRow invariant = controller.invariant->row(position.row);
        finder.find(position, row);
        for (std::size_t i = 0; i < agents.size(); ++i) {
          sums[i][k] = measure.measure(row, i, invariant, like.count[k],
                                       result.agents[i].freedom.data() + position.row * engine.row_length(),
                                       counts[static_cast<std::size_t>(worker)][i]);
        }
      }
    });
  });
  copy_to_like_rows(like, local.begin, engine.row_length(), team, sums, result);
  add_up(counts, sums, engine.share(), controller.invariant->count(local.begin, local.end), result);
  return result;
}

namespace {

/// The sets of one agent in the cells of one row.
template <class Level>
void write_row(ConventionRows<Level>& finder, const Controller& controller, const RowPosition& position,
               std::size_t agent, std::int64_t bytes, std::uint8_t* cells) {
  const ConstRow invariant = controller.invariant->row(position.row);
  if (!any_set(invariant)) return;
  ConventionRow row;
  finder.find(position, row);
  const ActionGroups& groups = *row.groups.classes[agent];
  for (std::size_t a = 0; a < groups.group_of.size(); ++a) {
    const ConstRow kept(row.kept[agent].data() + groups.group_of[a] * invariant.size(), invariant.size());
    add_action(kept, a, bytes, cells);
  }
}

}  // namespace

void fill_convention_bits(const Controller& controller, const ActionGrouping& agents, std::size_t agent,
                          std::uint64_t begin, std::uint64_t count, void* out) {
  const std::int64_t bytes = agents[agent].bytes();
  const auto row_bytes = static_cast<std::uint64_t>(controller.engine->row_length() * bytes);
  auto* target = static_cast<std::uint8_t*>(out);
  controller.levels->visit([&]<class Level>(const LevelRows<Level>& levels) {
    ConventionRows<Level> finder(controller, agents, levels, {*controller.engine, levels});
    std::vector<std::uint8_t> cells(row_bytes);
    // A segment may begin and end inside a row.
    while (count > 0) {
      const std::uint64_t offset = begin % row_bytes;
      const std::uint64_t take = std::min(count, row_bytes - offset);
      std::fill(cells.begin(), cells.end(), 0);
      const RowPosition position(controller.engine->grid(), static_cast<std::int64_t>(begin / row_bytes));
      write_row(finder, controller, position, agent, bytes, cells.data());
      std::copy_n(cells.begin() + static_cast<std::ptrdiff_t>(offset), take, target);
      begin += take;
      count -= take;
      target += take;
    }
  });
}

}  // namespace coordreq
