#include "answers/risk/expected_levels.hpp"

#include <algorithm>

#include "engine/level_messages.hpp"

namespace coordreq {
namespace {

/// Rows that one thread takes at a time.
constexpr std::int64_t kGrain = 64;

}  // namespace

template <class Level>
ExpectedLevels<Level>::ExpectedLevels(const RowEngine& engine, const ExpectedRisks& expected)
    : engine_(engine), expected_(expected), changed_(expected.different.size()) {
  const std::size_t maps = sizeof(Level) == sizeof(std::uint32_t) ? changed_.size() : 1;
  for (std::size_t i = 0; i < maps; ++i) levels_.push_back(engine.make_levels<Level>(engine.posts()));
}

template <class Level>
bool ExpectedLevels<Level>::update(const std::vector<LevelRows<std::uint32_t>>& risks,
                                   const std::vector<std::vector<std::uint8_t>>& changed, ThreadTeam& team) {
  std::int64_t rows = 0;
  const RowShare* const share = engine_.share();
  for (std::size_t number = 0; number < changed_.size(); ++number) {
    changed_[number].assign(static_cast<std::size_t>(engine_.rows()), 0);
    if (is_new_) {
      find_rows(number, risks, held_rows(share, engine_.rows()), nullptr, team);
    } else {
      find_rows(number, risks, {local_rows(share, engine_.rows())}, &changed, team);
      if (share != nullptr) exchange(number);
    }
    rows += std::count(changed_[number].begin(), changed_[number].end(), 1);
  }
  is_new_ = false;
  return sum_of_all(share, rows) > 0;
}

template <class Level>
void ExpectedLevels<Level>::load(std::size_t number, const std::vector<LevelRows<std::uint32_t>>& risks,
                                 ThreadTeam& team) {
  changed_[number].assign(static_cast<std::size_t>(engine_.rows()), 1);
  find_rows(number, risks, {local_rows(engine_.share(), engine_.rows())}, nullptr, team);
  if (engine_.share() != nullptr) exchange(number);
}

template <class Level>
void ExpectedLevels<Level>::find_rows(std::size_t number, const std::vector<LevelRows<std::uint32_t>>& risks,
                                      const std::vector<RowShare::Range>& runs,
                                      const std::vector<std::vector<std::uint8_t>>* changed,
                                      ThreadTeam& team) {
  const ExpectedRisk& expected = expected_.different[number];
  LevelRows<Level>& levels = levels_of(number);
  const auto n = static_cast<std::size_t>(levels.row_length());
  for_each_row_of(team, runs, kGrain, [&](ThreadTeam::Range range, int) {
    std::vector<const std::uint32_t*> sources(expected.successors().size());
    std::vector<Level> lanes(static_cast<std::size_t>(levels.stride()));
    const std::int64_t before = levels.margins().before;
    Level* const next = lanes.data() + before;
    for (std::int64_t row = range.begin; row < range.end; ++row) {
      const auto r = static_cast<std::size_t>(row);
      const auto has_changed = [&](std::size_t mode) { return (*changed)[mode][r] != 0; };
      if (changed != nullptr && std::ranges::none_of(expected.successors(), has_changed)) continue;
      std::ranges::transform(expected.successors(), sources.begin(),
                             [&](std::size_t mode) { return risks[mode].row(row); });
      expected.find<Level>(sources, n, next);
      const auto ready = levels.make_ready(lanes.data());
      if (std::equal(next, next + n, levels.row(row))) continue;
      levels.put_ready(row, lanes.data(), ready);
      changed_[number][r] = 1;
    }
  });
}

/// Sends own rows that have changed, and takes in ghost rows.
template <class Level>
void ExpectedLevels<Level>::exchange(std::size_t number) {
  LevelRows<Level>& levels = levels_of(number);
  LevelMessages<Level> messages(levels);
  messages.exchange([&](std::int64_t row) { return changed_[number][static_cast<std::size_t>(row)] != 0; },
                    [&](std::int64_t row, const Level* cells) {
                      levels.put(row, cells);
                      changed_[number][static_cast<std::size_t>(row)] = 1;
                    });
}

template class ExpectedLevels<std::uint32_t>;
template class ExpectedLevels<std::uint64_t>;

}  // namespace coordreq
