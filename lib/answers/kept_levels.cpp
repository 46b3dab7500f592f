#include "answers/kept_levels.hpp"

#include <utility>
#include <vector>

#include "base/requires.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {
namespace {

template <class Level, class Body>
void for_each_held(const LevelRows<Level>& levels, const Body& body) {
  for (const RowShare::Range run : held_rows(levels.share(), levels.rows())) {
    for (std::int64_t row = run.begin; row < run.end; ++row) body(row);
  }
}

/// Whether every level is one that a cell can have. Gaps of rows do not count.
template <class Level>
bool are_possible(const LevelRows<Level>& levels, const LevelBounds& bounds) {
  bool possible = true;
  for_each_held(levels, [&](std::int64_t r) {
    const Level* const row = levels.row(r);
    levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
      for (std::int64_t i = lane; i < lane + count; ++i) {
        const bool is_member = bounds.members->test(r * levels.row_length() + i);
        possible = possible && (row[i] != 0) == is_member;
        possible = possible && (row[i] == LevelRows<Level>::kTop || std::int64_t{row[i]} <= bounds.most);
      }
    });
  });
  return possible;
}

template <class Level>
LevelMap load_levels(Archive& archive, const RowEngine& engine, const LevelBounds& bounds) {
  LevelRows<Level> levels = engine.make_levels<Level>(engine.posts());
  serialise_rows(archive, levels.share(), rows_of(levels));
  archive.expect(are_possible(levels, bounds), "a cell has a level that it cannot have");
  for_each_held(
      levels, [&](std::int64_t r) { levels.change_row(r, [&](Level* cells) { levels.clear_gaps(cells); }); });
  return LevelMap(std::move(levels));
}

/// Saves the rows of a step as serialise() does.
void save_levels(Archive& archive, const RowShare* share, const NumberRows& state) {
  auto width = static_cast<std::uint8_t>(state.number_bytes);
  archive.number(width);
  serialise_rows(archive, share, state);
}

}  // namespace

void serialise_rows(Archive& archive, const RowShare* share, const NumberRows& rows) {
  archive.grid_rows(rows, local_rows(share, rows.rows), held_rows(share, rows.rows));
}

std::function<void(const WaveStep&)> step_of(const StageWork& work, const RowEngine& engine,
                                             const SaveState& save) {
  // Cells of a row, without its gaps.
  return [&work, save, row_length = engine.grid().points() / engine.rows()](const WaveStep& step) {
    if (work.step) work.step(step, row_length);
    if (work.store == nullptr || step.state.empty()) return;
    work.store->step([&](Archive& archive) { save(archive, step.state); });
  };
}

void serialise(Archive& archive, const RowEngine& engine, const LevelBounds& bounds, LevelMap& levels) {
  std::uint8_t width = levels.visit(
      []<class Level>(const LevelRows<Level>&) { return static_cast<std::uint8_t>(sizeof(Level)); });
  archive.number(width);
  if (!archive.is_loading())
    return levels.visit(
        [&](const auto& stored) { serialise_rows(archive, stored.share(), rows_of(stored)); });
  archive.expect(width == 1 || width == 2 || width == 4, "levels have another width");
  levels = width == 1   ? load_levels<std::uint8_t>(archive, engine, bounds)
           : width == 2 ? load_levels<std::uint16_t>(archive, engine, bounds)
                        : load_levels<std::uint32_t>(archive, engine, bounds);
}

void serialise(Archive& archive, const RowShare* share, const CellSet& within, CellSet& set) {
  REQUIRES(within.words().size() == set.words().size());
  serialise_rows(archive, share, rows_of(set));
  bool is_subset = true;
  for (std::size_t w = 0; archive.is_loading() && w < set.words().size(); ++w)
    is_subset = is_subset && (set.words()[w] & ~within.words()[w]) == 0;
  archive.expect(is_subset, "a set has cells that it cannot have");
}

void find_or_take_levels(const StageWork& work, const RowEngine& engine, const LevelBounds& bounds,
                         LevelMap& target, const std::function<LevelMap(const WaveWatch&)>& find) {
  const auto load = [&](Archive& archive) { serialise(archive, engine, bounds, target); };
  const StageStore::Kept kept = work.store == nullptr ? StageStore::Kept::nothing : work.store->take(load);
  if (kept != StageStore::Kept::finished) {
    LevelMap start = std::move(target);
    const SaveState save = [&engine](Archive& archive, std::span<const NumberRows> state) {
      save_levels(archive, engine.share(), state.front());
    };
    target = find({.step = step_of(work, engine, save),
                   .resumed = kept == StageStore::Kept::unfinished ? &start : nullptr});
  }
  if (work.store != nullptr)
    work.store->finish(
        [&engine, bounds, &target](Archive& archive) { serialise(archive, engine, bounds, target); });
}

}  // namespace coordreq
