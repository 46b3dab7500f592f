#include "safety/wave.hpp"

#include <bit>
#include <utility>
#include <vector>

namespace coordreq {
namespace {

struct ChangedRow {
  std::int64_t row;
  std::vector<Word> bits;
};

class WaveRunner {
 public:
  WaveRunner(CellSet& set, const Wave& wave, const RowEngine& engine, const RowReach& reach, ThreadTeam& team)
      : set_(set),
        target_(engine.target(set, team)),
        wave_(wave),
        reach_(reach),
        team_(team),
        changed_(static_cast<std::size_t>(team.size())) {
    for (std::int64_t r = 0; r < set.rows(); ++r) {
      if (any_set(set.row(r))) pending_.push_back(r);
    }
    cells_left_ = set.count();
  }

  /// @returns false if nothing changed
  bool step(std::int64_t number) {
    sweep(number);
    const bool any = commit();
    if (wave_.stepped) wave_.stepped(number, cells_left_);
    if (any) find_pending();
    return any;
  }

 private:
  void sweep(std::int64_t number) {
    const auto count = static_cast<std::int64_t>(pending_.size());
    team_.for_each(count, 4, [&](ThreadTeam::Range range, int worker) {
      std::vector<Word> keep(static_cast<std::size_t>(set_.words_per_row()));
      std::vector<Word> removed(keep.size());
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        const std::int64_t row = pending_[static_cast<std::size_t>(i)];
        const ConstRow current = std::as_const(set_).row(row);
        keep.assign(current.begin(), current.end());
        wave_.shrink(row, target_, keep, worker);
        for (std::size_t w = 0; w < keep.size(); ++w) removed[w] = current[w] & ~keep[w];
        if (!any_set(removed)) continue;
        wave_.removed(row, removed, number);
        changed_[static_cast<std::size_t>(worker)].push_back({row, keep});
      }
    });
  }

  bool commit() {
    bool any = false;
    changed_before_.assign(static_cast<std::size_t>(set_.rows()) + 1, 0);
    std::vector<std::int64_t> changed_rows;
    for (std::vector<ChangedRow>& rows : changed_) {
      for (const ChangedRow& changed : rows) {
        any = true;
        changed_rows.push_back(changed.row);
        changed_before_[static_cast<std::size_t>(changed.row) + 1] = 1;
        const MutableRow target = set_.row(changed.row);
        for (std::size_t w = 0; w < target.size(); ++w) {
          cells_left_ -= std::popcount(target[w] & ~changed.bits[w]);
          target[w] = changed.bits[w];
        }
      }
      rows.clear();
    }
    team_.for_each(static_cast<std::int64_t>(changed_rows.size()), 64, [&](ThreadTeam::Range range, int) {
      RowEroder eroder;
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        target_.refresh(changed_rows[static_cast<std::size_t>(i)], eroder);
      }
    });
    for (std::size_t r = 1; r < changed_before_.size(); ++r) changed_before_[r] += changed_before_[r - 1];
    return any;
  }

  void find_pending() {
    std::vector<std::uint8_t> wanted(static_cast<std::size_t>(set_.rows()), 0);
    team_.for_each(set_.rows(), 512, [&](ThreadTeam::Range range, int) {
      for (std::int64_t r = range.begin; r < range.end; ++r) {
        wanted[static_cast<std::size_t>(r)] =
            any_set(std::as_const(set_).row(r)) && reach_.meets(r, changed_before_) ? 1 : 0;
      }
    });
    pending_.clear();
    for (std::int64_t r = 0; r < set_.rows(); ++r) {
      if (wanted[static_cast<std::size_t>(r)] != 0) pending_.push_back(r);
    }
  }

  CellSet& set_;
  RowTarget target_;
  const Wave& wave_;
  const RowReach& reach_;
  ThreadTeam& team_;
  std::vector<std::int64_t> pending_;
  std::vector<std::vector<ChangedRow>> changed_;  ///< by worker; taken over only after the sweep
  std::vector<std::int64_t> changed_before_;
  std::int64_t cells_left_ = 0;
};

}  // namespace

WaveResult run_wave(CellSet& set, const Wave& wave, const RowEngine& engine, const RowReach& reach,
                    std::int64_t max_steps, ThreadTeam& team) {
  WaveRunner runner(set, wave, engine, reach, team);
  WaveResult result;
  while (max_steps < 0 || result.steps < max_steps) {
    ++result.steps;
    if (!runner.step(result.steps)) {
      result.fixed_point = true;
      return result;
    }
  }
  return result;
}

}  // namespace coordreq
