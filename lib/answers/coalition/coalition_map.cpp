#include "answers/coalition/coalition_map.hpp"

#include <algorithm>
#include <bit>

#include "base/requires.hpp"
#include "spec/coordination_spec.hpp"

namespace coordreq {
namespace {

/// The cells of a row whose level is at least `least`.
template <class Level>
void cells_from_level(const LevelRows<Level>& levels, std::int64_t row, Level least,
                      std::vector<Word>& members) {
  const Level* cells = levels.row(row);
  std::int64_t rest = levels.row_length();
  for (Word& word : members) {
    word = 0;
    const std::int64_t count = std::min(rest, CellSet::kWordBits);
    for (std::int64_t c = 0; c < count; ++c) word |= Word{cells[c] >= least} << c;
    cells += count;
    rest -= count;
  }
}

/// {x in the row : delay(x) >= horizon}. A cell of finite level i has delay i - 1.
void find_enough(const DelayLayers& layers, std::int64_t horizon, std::int64_t row,
                 std::vector<Word>& members) {
  layers.layers_of.visit([&]<class Level>(const LevelRows<Level>& levels) {
    constexpr std::int64_t kTop = LevelRows<Level>::kTop;
    if (layers.top_delay() < horizon) {
      std::fill(members.begin(), members.end(), 0);
    } else {
      cells_from_level(levels, row, static_cast<Level>(std::min(horizon + 1, kTop)), members);
    }
  });
}

/// Finds the choices of the cells of rows. One object a thread.
template <class Level>
class RowChooser {
 public:
  RowChooser(CoalitionMap& map, LevelRows<Level>& chosen, const std::vector<std::vector<std::size_t>>& apart,
             const CellSet& invariant, const std::vector<const DelayLayers*>& layers)
      : map_(map),
        chosen_(chosen),
        apart_(apart),
        invariant_(invariant),
        layers_(layers),
        words_(static_cast<std::size_t>(invariant.words_per_row())),
        open_(words_),
        enough_(words_),
        tied_(words_),
        sometimes_apart_(map.pairs.size(), std::vector<Word>(words_)) {}

  void choose(std::int64_t row) {
    std::copy_n(invariant_.row(row).begin(), words_, open_.begin());
    for (std::size_t i = 0; i < map_.choices.size() && any_set(open_);) i = choose_among_equals(row, i);
    assign(row, open_, LevelRows<Level>::kTop);
  }

 private:
  /// Gives open cells of the row the choices from number i on that cost as much as choice i.
  /// @returns the number of the first choice that costs more
  std::size_t choose_among_equals(std::int64_t row, std::size_t i) {
    const Rational& cost = map_.choices[i].cost;
    std::fill(tied_.begin(), tied_.end(), 0);
    for (auto& cells : sometimes_apart_) std::fill(cells.begin(), cells.end(), 0);
    for (; i < map_.choices.size() && map_.choices[i].cost == cost; ++i) {
      find_enough(*layers_[map_.choices[i].partition], map_.horizon, row, enough_);
      for (std::size_t w = 0; w < words_; ++w) enough_[w] &= open_[w];
      for (const std::size_t pair : apart_[i]) unite(enough_, sometimes_apart_[pair]);
      // Cells that have got an earlier choice of the same cost keep it.
      for (std::size_t w = 0; w < words_; ++w) enough_[w] &= ~tied_[w];
      assign(row, enough_, static_cast<Level>(i + 1));
      unite(enough_, tied_);
    }
    for (std::size_t pair = 0; pair < map_.pairs.size(); ++pair) {
      const MutableRow critical = map_.critical[pair].row(row);
      for (std::size_t w = 0; w < words_; ++w) critical[w] |= tied_[w] & ~sometimes_apart_[pair][w];
    }
    for (std::size_t w = 0; w < words_; ++w) open_[w] &= ~tied_[w];
    return i;
  }

  static void unite(const std::vector<Word>& cells, std::vector<Word>& all) {
    for (std::size_t w = 0; w < cells.size(); ++w) all[w] |= cells[w];
  }

  void assign(std::int64_t row, const std::vector<Word>& cells, Level level) {
    chosen_.change_row(row, [&](Level* levels) {
      for (std::size_t w = 0; w < cells.size(); ++w) {
        for (Word rest = cells[w]; rest != 0; rest &= rest - 1)
          levels[w * CellSet::kWordBits + static_cast<std::size_t>(std::countr_zero(rest))] = level;
      }
    });
  }

  CoalitionMap& map_;
  LevelRows<Level>& chosen_;
  const std::vector<std::vector<std::size_t>>& apart_;
  const CellSet& invariant_;
  const std::vector<const DelayLayers*>& layers_;
  std::size_t words_;
  std::vector<Word> open_;    ///< cells of K without a partition so far
  std::vector<Word> enough_;  ///< open cells for which the partition at hand is enough
  std::vector<Word> tied_;    ///< open cells for which a choice of the cost at hand is enough
  std::vector<std::vector<Word>>
      sometimes_apart_;  ///< [pair] cells at which the two are apart in one of these choices
};

template <class Level>
LevelMap choose_all(CoalitionMap& map, const std::vector<std::vector<std::size_t>>& apart,
                    const CellSet& invariant, const std::vector<const DelayLayers*>& layers,
                    ThreadTeam& team) {
  constexpr std::int64_t kGrain = 64;
  const RowShare* const share = layers.front()->layers_of.share();
  LevelRows<Level> chosen(invariant.rows(), {{{invariant.row_length(), 1, {}, {}}}}, false, share);
  for_each_local_row(team, share, invariant.rows(), kGrain, [&](ThreadTeam::Range range, int) {
    RowChooser<Level> chooser(map, chosen, apart, invariant, layers);
    for (std::int64_t row = range.begin; row < range.end; ++row) chooser.choose(row);
  });
  return LevelMap(std::move(chosen));
}

/// [choice] The numbers of the pairs that are apart in its partition.
std::vector<std::vector<std::size_t>> pairs_apart(const CoalitionMap& map,
                                                  const std::vector<PartitionSpec>& partitions) {
  std::vector<std::vector<std::size_t>> apart;
  for (const CoalitionChoice& choice : map.choices) {
    std::vector<std::size_t>& separated = apart.emplace_back();
    for (std::size_t pair = 0; pair < map.pairs.size(); ++pair) {
      if (!are_together(partitions[choice.partition], map.pairs[pair])) separated.push_back(pair);
    }
  }
  return apart;
}

void count_cells(CoalitionMap& map, ThreadTeam& team) {
  const LevelMap::Histogram histogram = map.chosen.histogram(team);
  map.without = histogram.top;
  map.cells.assign(map.choices.size(), 0);
  for (std::size_t i = 0; i + 1 < histogram.finite.size(); ++i) map.cells[i] = histogram.finite[i + 1];
  const RowShare* const share = map.chosen.share();
  for (const CellSet& cells : map.critical) {
    const RowShare::Range local = local_rows(share, cells.rows());
    map.critical_cells.push_back(cells.count(local.begin, local.end));
  }
  if (share != nullptr) share->ranks().add(map.critical_cells);
}

}  // namespace

CoalitionMap find_coalitions(const CoordinationSpec& coordination, std::size_t agents,
                             const CellSet& invariant, const std::vector<const DelayLayers*>& layers,
                             ThreadTeam& team) {
  REQUIRES(coordination.horizon.has_value());
  CoalitionMap map{.horizon = *coordination.horizon,
                   .choices = order_of_preference(coordination),
                   .pairs = agent_pairs(agents)};
  for (std::size_t pair = 0; pair < map.pairs.size(); ++pair)
    map.critical.emplace_back(invariant.rows(), invariant.row_length());
  const std::vector<std::vector<std::size_t>> apart = pairs_apart(map, coordination.partitions);
  const bool is_short = map.choices.size() < LevelRows<std::uint8_t>::kTop;
  map.chosen = is_short ? choose_all<std::uint8_t>(map, apart, invariant, layers, team)
                        : choose_all<std::uint32_t>(map, apart, invariant, layers, team);
  count_cells(map, team);
  return map;
}

}  // namespace coordreq
