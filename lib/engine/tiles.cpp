#include "engine/tiles.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/fast_paths.hpp"
#include "engine/action_sources.hpp"
#include "engine/interner.hpp"
#include "engine/shared_list_numbers.hpp"

namespace coordreq {
namespace {

using Numbers = Tiles::Numbers;
using Kind = RowSegment::Kind;

/// Tiles in the sample that shows whether enough of them are equal.
constexpr std::int64_t kSample = 4096, kSampleAtOnce = 32;
/// If fewer tiles than this fraction are different, looking up pays.
constexpr double kMostDifferent = 0.5;
/// Fewer rows are computed sooner than compared.
constexpr std::int64_t kFewRows = 4;
/// Tiles that one thread takes at a time.
constexpr std::int64_t kTilesAtOnce = 1024;

void add_segment(const RowSegment& segment, std::int64_t origin, const GridDimension& target, Numbers& list) {
  const bool is_moved = segment.kind == Kind::fixed;
  std::int64_t first = std::int64_t{segment.range.first} - (is_moved ? origin : 0);
  if (is_moved && target.periodic()) first = (first % target.count + target.count) % target.count;
  const std::int64_t width = std::int64_t{segment.range.last} - segment.range.first;
  for (const std::int64_t number : {std::int64_t{segment.begin}, std::int64_t{segment.end},
                                    static_cast<std::int64_t>(segment.kind), first, width})
    list.push_back(static_cast<std::uint32_t>(number));
}

/// [choice] Numbers of its list of ids, equal for equal lists.
Numbers number_lists(const std::vector<std::uint32_t>& ids, std::int64_t combinations) {
  const auto width = static_cast<std::size_t>(combinations);
  ListNumbers<std::uint32_t> lists;
  Numbers numbers;
  for (std::size_t base = 0; base < ids.size(); base += width)
    numbers.push_back(lists.number({ids.data() + base, width}));
  return numbers;
}

bool are_possible(const RowEngine& engine) {
  return fast_paths().equal_rows && engine.posts().is_cut() && engine.demands().empty() &&
         engine.across() > 0;
}

}  // namespace

Tiles::Tiles(const RowEngine& engine, const RowHull& hull, std::size_t leading, ThreadTeam* team)
    : engine_(&engine), hull_(&hull), leading_(leading) {
  rows_ = leading == engine.across() ? 1 : engine.grid().row_stride(leading - 1);
  size_ = engine.rows() / rows_;
  const RowShare::Range local = local_rows(engine.share(), engine.rows());
  local_tiles_ = {local.begin / rows_, local.end / rows_};
  std::vector<Numbers> choices(engine.tables());
  for_each(team, std::ssize(choices), 1, [&](ThreadTeam::Range range, int) {
    for (auto t = static_cast<std::size_t>(range.begin); t < static_cast<std::size_t>(range.end); ++t)
      choices[t] = number_choices(t);
  });
  for (std::size_t t = 0; t < choices.size(); ++t) {
    const RowSlices& slices = engine.slices()[t];
    add_source(slices.state_stride, slices.before, slices.input_combinations, std::move(choices[t]));
  }
  // Rows may be equal in the pairs that a file lists, and different in those that `allow` forbids.
  if (engine.allow() != nullptr) add_pairs(*engine.allow());
  if (engine.permitted() != nullptr && engine.permitted() != engine.allow()) add_pairs(*engine.permitted());
}

void Tiles::add_pairs(const PairTable& pairs) {
  const std::int64_t combinations = source_of(pairs, engine_->abstraction().inputs).input_combinations;
  add_source(pairs.positions().state_stride, pairs.positions().before, combinations,
             number_lists(pairs.ids(), combinations));
}

void Tiles::add_source(const std::vector<std::int64_t>& state_stride, std::int64_t before,
                       std::int64_t combinations, Numbers numbers) {
  const auto is_used = [&](std::size_t begin, std::size_t end) {
    return std::any_of(state_stride.begin() + static_cast<std::ptrdiff_t>(begin),
                       state_stride.begin() + static_cast<std::ptrdiff_t>(end),
                       [](std::int64_t stride) { return stride != 0; });
  };
  if (!is_used(0, leading_)) return;  // the same for all tiles
  sources_.push_back(
      {&state_stride, before, combinations, is_used(leading_, engine_->across()), std::move(numbers)});
}

/// [choice of the states of table t] equal numbers for equal slices under all inputs. In the dimensions that
/// tell tiles apart, ranges are counted from the beginning of the box of all posts.
Numbers Tiles::number_choices(std::size_t t) const {
  const RowSlices& slices = engine_->slices()[t];
  if (t >= leading_) return number_lists(slices.ids, slices.input_combinations);
  const GridDimension& target = engine_->grid()[t];
  ListNumbers<std::uint32_t> meanings, lists;
  Numbers result, meaning, list;
  for (std::int64_t base = 0; base < slices.size(); base += slices.input_combinations) {
    const IndexRange hull = hull_->range_of(result.size(), t);
    list.assign(1, static_cast<std::uint32_t>(hull.last - hull.first));
    for (std::int64_t position = base; position < base + slices.input_combinations; ++position) {
      if (position > base && slices.number(position) == slices.number(position - 1)) {
        list.push_back(list.back());
        continue;
      }
      meaning.clear();
      for (const RowSegment& segment : slices.slices[slices.number(position)])
        add_segment(segment, hull.first, target, meaning);
      list.push_back(meanings.number(meaning));
    }
    result.push_back(lists.number(list));
  }
  return result;
}

void Tiles::add_tables(std::int64_t tile, Numbers& list) const {
  const std::int64_t first = tile * rows_;
  for (const Source& source : sources_) {
    RowPosition position(engine_->grid(), first);
    for (; position.row < first + (source.by_rows ? rows_ : 1); position.advance(engine_->grid())) {
      const std::int64_t choice =
          (position.offset(*source.state_stride) - source.before) / source.combinations;
      list.push_back(source.numbers[static_cast<std::size_t>(choice)]);
    }
  }
}

void Tiles::number_tables(ThreadTeam* team) {
  SharedListNumbers lists;
  tables_.assign(static_cast<std::size_t>(size_), 0);
  for_each(team, local_tiles_.end - local_tiles_.begin, kTilesAtOnce, [&](ThreadTeam::Range range, int) {
    Numbers list;
    for (std::int64_t tile = local_tiles_.begin + range.begin; tile < local_tiles_.begin + range.end;
         ++tile) {
      list.clear();
      add_tables(tile, list);
      tables_[static_cast<std::size_t>(tile)] = lists.number(list);
    }
  });
}

void Tiles::find_shift(std::int64_t from, std::int64_t to, std::vector<std::int32_t>& shift) const {
  shift.assign(engine_->tables(), 0);
  if (from == to) return;
  const RowPosition one(engine_->grid(), from);
  const RowPosition other(engine_->grid(), to);
  for (std::size_t t = 0; t < leading_; ++t)
    shift[t] = hull_->range(other, t).first - hull_->range(one, t).first;
}

Numbers Tiles::contents_of_tiles(const Numbers& content) const {
  if (rows_ == 1) return content;
  ListNumbers<std::uint32_t> lists;
  const auto rows = static_cast<std::size_t>(rows_);
  Numbers result;
  for (std::size_t first = 0; first < content.size(); first += rows)
    result.push_back(lists.number({content.data() + first, rows}));
  return result;
}

Numbers Tiles::refined(const Numbers& before, const Numbers& content, ThreadTeam* team) const {
  const Numbers of_tiles = contents_of_tiles(content);
  SharedListNumbers lists;
  Numbers result(static_cast<std::size_t>(size_), 0);
  for_each(team, local_tiles_.end - local_tiles_.begin, kTilesAtOnce, [&](ThreadTeam::Range range, int) {
    Scratch scratch;
    Numbers list;
    for (std::int64_t tile = local_tiles_.begin + range.begin; tile < local_tiles_.begin + range.end;
         ++tile) {
      list.assign(1, before[static_cast<std::size_t>(tile)]);
      add_contents(
          RowPosition(engine_->grid(), tile * rows_),
          [&](std::int64_t other) { return of_tiles[static_cast<std::size_t>(other)]; }, scratch, list);
      result[static_cast<std::size_t>(tile)] = lists.number(list);
    }
  });
  return result;
}

/// The fraction of different tiles in a sample, which is drawn with equal distances that have no factor in
/// common with a dimension: else all of it could have one index there.
double Tiles::fraction_different(const Numbers& content, ThreadTeam* team) const {
  const Numbers of_tiles = contents_of_tiles(content);
  const auto has_common_factor = [this](std::int64_t step) {
    const std::vector<GridDimension>& dimensions = engine_->grid().dimensions();
    return std::any_of(dimensions.begin(), dimensions.begin() + static_cast<std::ptrdiff_t>(leading_),
                       [&](const GridDimension& one) { return std::gcd(one.count, step) > 1; });
  };
  std::int64_t step = std::max<std::int64_t>(1, (local_tiles_.end - local_tiles_.begin) / kSample);
  while (has_common_factor(step)) ++step;
  Numbers drawn(static_cast<std::size_t>((local_tiles_.end - local_tiles_.begin + step - 1) / step));
  SharedListNumbers lists;
  for_each(team, std::ssize(drawn), kSampleAtOnce, [&](ThreadTeam::Range range, int) {
    Scratch scratch;
    Numbers list;
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      const std::int64_t tile = local_tiles_.begin + k * step;
      list.clear();
      add_tables(tile, list);
      const RowPosition position(engine_->grid(), tile * rows_);
      add_contents(
          position, [&](std::int64_t other) { return of_tiles[static_cast<std::size_t>(other)]; }, scratch,
          list);
      drawn[static_cast<std::size_t>(k)] = lists.number(list);
    }
  });
  const auto all = static_cast<double>(drawn.size());
  std::ranges::sort(drawn);
  drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
  return static_cast<double>(drawn.size()) / all;
}

std::optional<Tiles> Tiles::make(const RowEngine& engine, const RowHull& hull, std::size_t leading) {
  if (!are_possible(engine) || leading == 0) return std::nullopt;
  Tiles tiles(engine, hull, leading, nullptr);
  tiles.number_tables(nullptr);
  return tiles;
}

std::optional<Tiles> Tiles::find(const RowEngine& engine, const RowHull& hull, const CellSet& set,
                                 ThreadTeam* team) {
  const RowShare::Range local = local_rows(engine.share(), engine.rows());
  if (!are_possible(engine) || local.end - local.begin < kFewRows) return std::nullopt;
  const Numbers content = number_rows(set, engine.share(), team);
  std::optional<Tiles> best;
  double least = kMostDifferent;
  // Units first: if as many are equal, fewer are looked up.
  for (const std::size_t leading : {engine.outer(), engine.across()}) {
    if (leading == 0 || (best && leading == engine.outer())) continue;
    Tiles tiles(engine, hull, leading, team);
    if (tiles.local_tiles().end - tiles.local_tiles().begin < kFewRows) continue;
    if (local.begin % tiles.rows() != 0 || local.end % tiles.rows() != 0) continue;
    const double fraction = tiles.fraction_different(content, team);
    if (fraction >= least) continue;
    least = fraction;
    best = std::move(tiles);
  }
  if (best) best->number_tables(team);
  return best;
}

Numbers number_rows(const CellSet& set, const RowShare* share, ThreadTeam* team) {
  constexpr std::int64_t kRows = 1 << 13, kGrain = 256;
  struct Look {
    std::uint64_t hash = 0;
    std::uint32_t number = Interner::kNone;
  };
  Interner interner;
  std::vector<std::int64_t> first;  // [number] the row that has come first
  std::vector<Look> looks(static_cast<std::size_t>(std::min(kRows, set.rows())));
  Numbers result(static_cast<std::size_t>(set.rows()), 0);
  const auto number_of = [&](std::int64_t r, std::uint64_t hash) {
    return interner.find(
        hash, [&](std::uint32_t other) { return std::ranges::equal(set.row(first[other]), set.row(r)); });
  };
  for (const RowShare::Range run : held_rows(share, set.rows())) {
    for (std::int64_t begin = run.begin; begin < run.end; begin += kRows) {
      const std::int64_t count = std::min(kRows, run.end - begin);
      // Most rows are equal to one of those before: all threads look them up, and one adds the others.
      for_each(team, count, kGrain, [&](ThreadTeam::Range range, int) {
        for (std::int64_t k = range.begin; k < range.end; ++k) {
          std::uint64_t hash = 0;
          for (const Word word : set.row(begin + k)) hash = mixed_hash(hash, word);
          looks[static_cast<std::size_t>(k)] = {hash, number_of(begin + k, hash)};
        }
      });
      for (std::int64_t k = 0; k < count; ++k) {
        auto [hash, number] = looks[static_cast<std::size_t>(k)];
        if (number == Interner::kNone) number = number_of(begin + k, hash);
        if (number == Interner::kNone) {
          number = interner.add(hash);
          first.push_back(begin + k);
        }
        result[static_cast<std::size_t>(begin + k)] = number;
      }
    }
  }
  return result;
}

}  // namespace coordreq
