#include "answers/blind/silent_table.hpp"

#include <algorithm>
#include <atomic>
#include <deque>

#include "answers/blind/class_rows.hpp"
#include "base/index.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {
namespace {

void raise(std::uint8_t& depth, std::uint8_t value) {
  std::atomic_ref<std::uint8_t> shared(depth);
  std::uint8_t old = shared.load(std::memory_order_relaxed);
  while (old < value && !shared.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
  }
}

/// Finds the depth of each cell of a row, 0 outside B_1. @returns whether a depth is above 0
template <class Level>
bool find_depths(const Level* levels, ConstRow invariant, std::int64_t deepest,
                 std::vector<std::uint8_t>& depths, std::vector<Word>& inside) {
  std::ranges::fill(inside, Word{0});
  for_each_bit(invariant, [&](std::int64_t x) {
    const Level level = levels[x];
    const bool is_top = level == LevelRows<Level>::kTop;
    const std::int64_t depth = is_top ? deepest : std::min<std::int64_t>(std::int64_t{level} - 1, deepest);
    depths[at(x)] = static_cast<std::uint8_t>(depth);
    if (depth > 0) inside[at(x / CellSet::kWordBits)] |= Word{1} << (x % CellSet::kWordBits);
  });
  return any_set(inside);
}

class TableBuilder {
 public:
  TableBuilder(const SilentSources& sources, std::vector<SilentTable>& tables)
      : sources_(sources), tables_(tables), rows_(sources) {
    const RowEngine& engine = sources.projections.grouping().engine();
    depths_.resize(at(engine.row_length()));
    inside_.resize(engine.row_words());
    missing_.resize(engine.row_words());
  }

  template <class Level>
  void add(const RowPosition& position, const Level* levels, std::int64_t deepest) {
    if (!find_depths(levels, sources_.invariant.row(position.row), deepest, depths_, inside_)) return;
    rows_.enter(position);
    for (std::size_t c = 0; c < tables_.size(); ++c) {
      if (!sources_.fibres[c]) continue;
      const Fibres& fibres = *sources_.fibres[c];
      const std::int64_t base = fibres.base(position);
      SilentTable& table = tables_[c];
      for_each_bit(inside_, [&](std::int64_t x) {
        raise(table.seen_depth[at(base + fibres.of_lane(x))], depths_[at(x)]);
      });
      for (std::int64_t a = 0; !rows_.is_full() && a < table.actions; ++a) {
        const ConstRow have = rows_.cells(c, static_cast<std::uint32_t>(a));
        for (std::size_t w = 0; w < missing_.size(); ++w) missing_[w] = inside_[w] & ~have[w];
        for_each_bit(missing_, [&](std::int64_t x) {
          raise(table.missing_depth[at((base + fibres.of_lane(x)) * table.actions + a)], depths_[at(x)]);
        });
      }
    }
  }

 private:
  const SilentSources& sources_;
  std::vector<SilentTable>& tables_;
  ClassRows rows_;
  std::vector<std::uint8_t> depths_;
  std::vector<Word> inside_;
  std::vector<Word> missing_;
};

/// Replaces every value by the greatest of all processes. Together.
void take_greatest(const RowShare* share, std::vector<std::uint8_t>& values) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 20U;
  if (share == nullptr) return;
  std::vector<std::int64_t> numbers;
  for (std::size_t begin = 0; begin < values.size(); begin += kAtOnce) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = first + static_cast<std::ptrdiff_t>(std::min(kAtOnce, values.size() - begin));
    numbers.assign(first, last);
    share->ranks().take_greatest(numbers);
    std::ranges::transform(numbers, first,
                           [](std::int64_t value) { return static_cast<std::uint8_t>(value); });
  }
}

}  // namespace

bool SilentTable::has_conflict(std::int64_t fibre) const {
  if (seen_depth[at(fibre)] == 0) return false;
  const auto first = missing_depth.begin() + static_cast<std::ptrdiff_t>(fibre * actions);
  return std::all_of(first, first + static_cast<std::ptrdiff_t>(actions),
                     [](std::uint8_t depth) { return depth > 0; });
}

std::vector<SilentTable> find_silent_tables(const SilentSources& sources, const LevelMap& levels,
                                            std::int64_t deepest, ThreadTeam& team) {
  const ActionGrouping& grouping = sources.projections.grouping();
  const RowEngine& engine = grouping.engine();
  std::vector<SilentTable> tables(sources.fibres.size());
  for (std::size_t c = 0; c < tables.size(); ++c) {
    if (!sources.fibres[c]) continue;
    tables[c].actions = grouping[c].actions();
    tables[c].seen_depth.assign(at(sources.fibres[c]->count()), 0);
    tables[c].missing_depth.assign(tables[c].seen_depth.size() * at(tables[c].actions), 0);
  }
  const std::int64_t most = std::min(deepest, SilentTable::kMostSteps);
  levels.visit([&](const auto& rows) {
    std::deque<TableBuilder> builders;
    for (int w = 0; w < team.size(); ++w) builders.emplace_back(sources, tables);
    for_each_local_row(team, engine.share(), engine.rows(), 64, [&](ThreadTeam::Range range, int worker) {
      for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
           position.advance(engine.grid())) {
        if (any_set(sources.invariant.row(position.row)))
          builders[at(worker)].add(position, rows.row(position.row), most);
      }
    });
  });
  for (SilentTable& table : tables) {
    take_greatest(engine.share(), table.seen_depth);
    take_greatest(engine.share(), table.missing_depth);
  }
  return tables;
}

}  // namespace coordreq
