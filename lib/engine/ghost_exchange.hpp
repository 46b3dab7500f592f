#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/dirty_rows.hpp"
#include "engine/level_messages.hpp"
#include "engine/sweep_order.hpp"

namespace coordreq {

/// [peer] The units of this rank, from the first to the last, whose posts can perhaps meet rows of the peer.
[[nodiscard]] std::vector<RowShare::Range> units_that_meet_peers(const RowEngine& engine, const RowHull& hull,
                                                                 std::int64_t unit_rows);

/// When, in a sweep, messages are taken in and sent: the numbers of batches.
struct ExchangeTimes {
  static constexpr std::size_t kNever = SIZE_MAX;
  std::size_t taking = kNever;  ///< the first batch with a unit that can meet rows of the peer
  std::size_t sending = 0;      ///< the last batch with a unit of which it holds rows
};
/// @param meeting, sent units by their numbers less first_unit, from the first to the last
[[nodiscard]] ExchangeTimes find_times(const SweepOrder& order, RowShare::Range meeting,
                                       RowShare::Range sent);

/// The ghost exchange of a wave: sends dirty rows to the ranks that hold them as ghosts, and takes in its own
/// ghost rows that are dirty. Nothing where there is one process.
///
/// In each sweep a rank sends one message to every rank that holds rows of it, after the last batch with such
/// rows. It takes in the message of the sweep before from every rank of which it holds rows, when it comes to
/// the first batch that can meet them. So messages are on their way while other rows are computed;
/// and the levels that a unit sees do not depend on how long messages take.
template <class Level>
class GhostExchange {
 public:
  /// @pre unchecked: all outlive this object.
  /// @param orders of sweeps forwards and backwards, of the units from first_unit on
  GhostExchange(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, DirtyRows& dirty,
                std::int64_t unit_rows, const std::array<SweepOrder, 2>& orders, std::int64_t first_unit)
      : levels_(levels), messages_(levels), dirty_(dirty) {
    if (levels.share() == nullptr) return;
    const std::vector<RowShare::Peer>& all = levels.share()->peers();
    peers_.resize(all.size());
    const std::vector<RowShare::Range> meeting = units_that_meet_peers(engine, hull, unit_rows);
    for (std::size_t p = 0; p < all.size(); ++p) {
      peers_[p].share = &all[p];
      RowShare::Range sent{first_unit, first_unit};
      if (!all[p].sent.empty())
        sent = {all[p].sent.front().begin / unit_rows, (all[p].sent.back().end - 1) / unit_rows + 1};
      const auto counted = [&](RowShare::Range units) {
        return RowShare::Range{units.begin - first_unit, units.end - first_unit};
      };
      for (std::size_t k = 0; k < orders.size(); ++k)
        peers_[p].times[k] = find_times(orders[k], counted(meeting[p]), counted(sent));
    }
  }

  void begin_sweep(std::int64_t number, bool backwards) {
    backwards_ = backwards;
    to_take_.clear();
    to_send_.clear();
    for (Peer& peer : peers_) {
      if (!peer.share->received.empty() && number > 1) to_take_.push_back(&peer);
      if (!peer.share->sent.empty()) to_send_.push_back(&peer);
    }
    const auto later_first = [this](std::size_t ExchangeTimes::*time) {
      return [this, time](const Peer* a, const Peer* b) { return times(*a).*time > times(*b).*time; };
    };
    std::ranges::sort(to_take_, later_first(&ExchangeTimes::taking));
    std::ranges::sort(to_send_, later_first(&ExchangeTimes::sending));
  }

  /// To be called before a batch. Takes in the messages that it needs, and calls `visit(row)` for the ghost
  /// rows in them.
  template <class Visit>
  void before(std::size_t batch, const Visit& visit) {
    while (!to_take_.empty() && times(*to_take_.back()).taking <= batch) take(visit);
  }
  /// To be called after a batch. Sends the messages that are complete.
  void after(std::size_t batch) {
    while (!to_send_.empty() && times(*to_send_.back()).sending <= batch) send();
  }
  /// Receives messages that have arrived, without taking them in.
  void receive_arrived() {
    for (auto peer = to_take_.rbegin(); peer != to_take_.rend(); ++peer) {
      if ((*peer)->arrived) continue;
      if (!ranks().has_message((*peer)->share->rank)) return;
      (*peer)->arrived = ranks().receive((*peer)->share->rank);
    }
  }
  /// Takes in and sends the rest of the messages of the sweep.
  template <class Visit>
  void end_sweep(const Visit& visit) {
    while (!to_take_.empty()) take(visit);
    while (!to_send_.empty()) send();
  }

  /// After the last sweep: receives its messages, which hold no rows.
  void end() {
    for (Peer& peer : peers_) {
      if (!peer.share->received.empty()) static_cast<void>(ranks().receive(peer.share->rank));
    }
  }

 private:
  struct Peer {
    const RowShare::Peer* share = nullptr;
    std::array<ExchangeTimes, 2> times;  ///< in sweeps forwards and backwards
    std::uint32_t sent_batch = 0;        ///< the last batch whose changes it was sent
    std::optional<Bytes> arrived;        ///< a message that was received and not taken in
  };

  [[nodiscard]] Ranks& ranks() const { return levels_.share()->ranks(); }
  [[nodiscard]] const ExchangeTimes& times(const Peer& peer) const { return peer.times[backwards_ ? 1 : 0]; }

  void send() {
    Peer& peer = *to_send_.back();
    to_send_.pop_back();
    ranks().send(peer.share->rank, messages_.message(*peer.share, [&](std::int64_t row) {
      return dirty_.has_changed_after(peer.sent_batch, row);
    }));
    peer.sent_batch = dirty_.batch();
  }

  template <class Visit>
  void take(const Visit& visit) {
    Peer& peer = *to_take_.back();
    to_take_.pop_back();
    const Bytes message =
        peer.arrived ? *std::exchange(peer.arrived, std::nullopt) : ranks().receive(peer.share->rank);
    dirty_.begin_batch();
    messages_.take(message, [&](std::int64_t row, const Level* cells) {
      levels_.put(row, cells);
      visit(row);
    });
  }

  LevelRows<Level>& levels_;
  LevelMessages<Level> messages_;
  DirtyRows& dirty_;
  bool backwards_ = false;
  std::vector<Peer> peers_;
  std::vector<Peer*> to_take_;  ///< in this sweep, the next one last
  std::vector<Peer*> to_send_;
};

}  // namespace coordreq
