#include "answers/network/mode_targets.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#include "ranks/exchange_row_bytes.hpp"

namespace coordreq {
namespace {

/// Rows that one thread takes at a time.
constexpr std::int64_t kGrain = 256;

}  // namespace

ModeTargets::ModeTargets(const RowEngine& engine, const std::vector<NetworkMode>& modes, const CellSet& start)
    : engine_(engine),
      modes_(modes),
      predecessors_(modes.size()),
      state_(modes.size(), State::untouched),
      changed_(modes.size(), std::vector<Word>(static_cast<std::size_t>(engine.rows() + 63) / 64, 0)),
      levels_(engine.make_levels<std::uint8_t>(engine.posts())),
      loaded_(modes.size()) {
  if (engine.share() != nullptr) unsent_ = changed_;
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    CellSet& set = sets_.emplace_back(start.rows(), start.row_length());
    for (const RowShare::Range run : held_rows(engine.share(), start.rows())) {
      for (std::int64_t row = run.begin; row < run.end; ++row)
        std::ranges::copy(start.row(row), set.row(row).begin());
    }
  }
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    for (const std::size_t successor : modes[mode].successors) predecessors_[successor].push_back(mode);
  }
}

void ModeTargets::load_row(std::size_t mode, std::int64_t row, std::vector<Word>& cells,
                           std::vector<std::uint8_t>& lanes) {
  const std::vector<std::size_t>& successors = modes_[mode].successors;
  const ConstRow first = sets_[successors.front()].row(row);
  cells.assign(first.begin(), first.end());
  for (const std::size_t successor : successors) {
    const ConstRow other = sets_[successor].row(row);
    for (std::size_t w = 0; w < cells.size(); ++w) cells[w] &= other[w];
  }
  const auto n = static_cast<std::size_t>(engine_.row_length());
  level_kernels<std::uint8_t>(best_instruction_set()).spread(cells.data(), lanes.data(), n);
  levels_.put(row, lanes.data());
}

void ModeTargets::load(std::size_t mode, ThreadTeam& team) {
  const bool again = loaded_ == mode;
  loaded_ = mode;
  for_each_held_row(team, engine_.share(), engine_.rows(), kGrain, [&](ThreadTeam::Range range, int) {
    std::vector<Word> cells;
    std::vector<std::uint8_t> lanes(static_cast<std::size_t>(engine_.row_length()) + kLevelBlock);
    for (std::int64_t row = range.begin; row < range.end; ++row) {
      if (!again || is_changed(mode, row)) load_row(mode, row, cells, lanes);
    }
  });
}

void ModeTargets::settle(std::size_t mode) {
  state_[mode] = State::settled;
  std::fill(changed_[mode].begin(), changed_[mode].end(), 0);
}

void ModeTargets::shrink(std::size_t mode, std::int64_t row, ConstRow cells) {
  replace(mode, row, cells);
  if (!unsent_.empty()) unsent_[mode][static_cast<std::size_t>(row / 64)] |= Word{1} << (row % 64);
}

bool ModeTargets::exchange() {
  if (engine_.share() == nullptr) return false;
  std::int64_t rows = 0;
  std::vector<Word> cells(engine_.row_words());
  for (std::size_t mode = 0; mode < modes(); ++mode) {
    std::vector<Word>& unsent = unsent_[mode];
    for (const Word word : unsent) rows += std::popcount(word);
    exchange_row_bytes(
        *engine_.share(), cells.size() * sizeof(Word),
        [&](std::int64_t row) {
          return (unsent[static_cast<std::size_t>(row / 64)] >> (row % 64) & 1U) != 0;
        },
        [&](std::int64_t row) { return std::as_bytes(set(mode).row(row)); },
        [&](std::int64_t row, std::span<const std::byte> bytes) {
          std::memcpy(cells.data(), bytes.data(), bytes.size());
          replace(mode, row, cells);
        });
    std::fill(unsent.begin(), unsent.end(), 0);
  }
  return engine_.share()->ranks().sum(rows) > 0;
}

void ModeTargets::replace(std::size_t mode, std::int64_t row, ConstRow cells) {
  std::copy(cells.begin(), cells.end(), sets_[mode].row(row).begin());
  for (const std::size_t before : predecessors_[mode]) {
    changed_[before][static_cast<std::size_t>(row / 64)] |= Word{1} << (row % 64);
    if (state_[before] == State::settled) state_[before] = State::changed;
  }
}

}  // namespace coordreq
