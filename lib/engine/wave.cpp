#include "engine/wave.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/ghost_exchange.hpp"
#include "engine/limits.hpp"
#include "engine/sweep_order.hpp"
#include "engine/wave_batch.hpp"

namespace coordreq {
namespace {

template <class Level>
class WaveRunner {
 public:
  WaveRunner(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
             RowOperator<Level>& op, const WaveWatch& watch, ThreadTeam& team, const EqualWork& equal)
      : levels_(levels),
        share_(engine.share()),
        watch_(watch),
        batch_(levels, engine, hull, limit, op, team, equal),
        orders_(make_orders(hull, equal.symmetry, team)),
        ghosts_(levels, engine, hull, batch_.dirty(), batch_.units().rows(), orders_, batch_.first_unit()) {}

  WaveCounts run() {
    while (goes_on(sweep(++counts_.sweeps))) {
    }
    for (std::int64_t* rows : {&counts_.rows_visited, &counts_.rows_copied, &counts_.rows_skipped})
      *rows = sum_of_all(share_, *rows);
    return counts_;
  }

 private:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  using Orders = std::array<SweepOrder, 2>;

  [[nodiscard]] Orders make_orders(const RowHull& hull, const RowSymmetry* symmetry, ThreadTeam& team) const {
    const std::int64_t most_rows = std::max<std::int64_t>(1, kMostLevelsOfBatch / levels_.stride());
    Orders orders;
    team.for_each(std::ssize(orders), 1, [&](ThreadTeam::Range range, int) {
      for (std::int64_t k = range.begin; k < range.end; ++k)
        orders[static_cast<std::size_t>(k)] =
            SweepOrder(batch_.units(), hull, batch_.alive(), batch_.first_unit(), batch_.unit_count(), k == 1,
                       symmetry, most_rows);
    });
    return orders;
  }

  /// Goes over the grid once. @returns rows visited
  std::int64_t sweep(std::int64_t number) {
    const bool backwards = number % 2 == 1;
    const SweepOrder& order = orders_[backwards ? 1 : 0];
    const std::int64_t alive = batch_.alive().count();
    const auto update_ghost = [this](std::int64_t row) { batch_.update_ghost(row); };
    WaveStep step{.sweep = number, .rows_left = alive, .rows = alive, .layer = layer_};
    batch_.begin_sweep();
    ghosts_.begin_sweep(number, backwards);
    std::int64_t looked_at = 0, turn = 0;
    for (std::size_t b = 0; b < order.size(); ++b) {
      step.rows_left -= order[b].rows;
      ghosts_.before(b, update_ghost);
      if (const std::optional<BatchCounts> done = batch_.run(order[b].units, turn)) {
        count(*done);
        step.visited += done->visited;
        looked_at += done->visited + done->copied;
        report(step, share_ == nullptr);
        ghosts_.receive_arrived();
      }
      ghosts_.after(b);
      turn += std::ssize(order[b].units) * batch_.units().rows();
    }
    ghosts_.end_sweep(update_ghost);
    counts_.rows_skipped += alive - looked_at;
    note_final_layers();
    step.layer = layer_;
    report(step, true);
    return step.visited;
  }

  void count(const BatchCounts& done) {
    counts_.rows_visited += done.visited;
    counts_.rows_copied += done.copied + done.permuted;
    changed_rows_ += done.changed;
  }

  /// Levels below the lowest to which a cell has sunk in a whole sweep are final: the sets up to it did not
  /// change while each cell was found to stay in them. Not so with several processes: changes may be coming.
  void note_final_layers() {
    if (batch_.lowest() == kTop || share_ != nullptr) return;
    layer_ = std::max<std::int64_t>(layer_, std::int64_t{batch_.lowest()} - 1);
  }

  /// @returns whether levels may still change. Several processes know a sweep late, so that none waits.
  bool goes_on(std::int64_t visited) {
    if (share_ == nullptr) return visited > 0;
    Ranks& ranks = share_->ranks();
    if (counts_.sweeps > 1 && ranks.finish_sum() == 0) {
      ghosts_.end();
      return false;
    }
    ranks.begin_sum(std::exchange(changed_rows_, 0));
    return true;
  }

  /// @param is_together whether all processes are at this point now
  void report(WaveStep& step, bool is_together) const {
    if (!watch_.step) return;
    const NumberRows state = rows_of(levels_);
    step.state = {&state, is_together ? std::size_t{1} : std::size_t{0}};
    watch_.step(step);
  }

  LevelRows<Level>& levels_;
  const RowShare* share_;
  const WaveWatch& watch_;
  WaveBatch<Level> batch_;
  Orders orders_;  ///< forwards and backwards
  GhostExchange<Level> ghosts_;
  WaveCounts counts_;
  std::int64_t layer_ = -1;        ///< levels up to it are final
  std::int64_t changed_rows_ = 0;  ///< since the last sum
};

}  // namespace

template <class Level>
WaveCounts run_wave(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
                    RowOperator<Level>& op, const WaveWatch& watch, ThreadTeam& team,
                    const EqualWork& equal) {
  return WaveRunner<Level>(levels, engine, hull, limit, op, watch, team, equal).run();
}

template WaveCounts run_wave(LevelRows<std::uint8_t>&, const RowEngine&, const RowHull&, std::uint8_t,
                             RowOperator<std::uint8_t>&, const WaveWatch&, ThreadTeam&, const EqualWork&);
template WaveCounts run_wave(LevelRows<std::uint16_t>&, const RowEngine&, const RowHull&, std::uint16_t,
                             RowOperator<std::uint16_t>&, const WaveWatch&, ThreadTeam&, const EqualWork&);
template WaveCounts run_wave(LevelRows<std::uint32_t>&, const RowEngine&, const RowHull&, std::uint32_t,
                             RowOperator<std::uint32_t>&, const WaveWatch&, ThreadTeam&, const EqualWork&);

}  // namespace coordreq
