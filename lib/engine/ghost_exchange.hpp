#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/dirty_rows.hpp"
#include "engine/level_messages.hpp"

namespace coordreq {

/// [peer] The units of this rank, from the first to the last, whose posts can perhaps meet rows of the peer.
[[nodiscard]] std::vector<RowShare::Range> units_that_meet_peers(const RowEngine& engine, const RowHull& hull,
                                                                 std::int64_t unit_rows);

/// The ghost exchange of a wave: sends dirty rows to the ranks that hold them as ghosts, and takes in its own
/// ghost rows that are dirty.
///
/// In each sweep a rank sends one message to every rank that holds rows of it, as soon as it is through with
/// these rows. It takes in the message of the sweep before from every rank of which it holds rows, when it
/// comes to the first unit that can meet them. So messages are on their way while other rows are worked out;
/// and the levels that a unit sees do not depend on how long messages take.
template <class Level>
class GhostExchange {
 public:
  /// @pre unchecked: there are several ranks, and all outlive this object.
  GhostExchange(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, DirtyRows& dirty,
                std::int64_t unit_rows)
      : levels_(levels),
        ranks_(levels.share()->ranks()),
        messages_(levels),
        dirty_(dirty),
        peers_(levels.share()->peers().size()) {
    const std::vector<RowShare::Peer>& all = levels.share()->peers();
    const std::vector<RowShare::Range> meeting = units_that_meet_peers(engine, hull, unit_rows);
    for (std::size_t p = 0; p < all.size(); ++p) {
      peers_[p].share = &all[p];
      peers_[p].meeting = meeting[p];
      if (!all[p].sent.empty())
        peers_[p].sent = {all[p].sent.front().begin / unit_rows,
                          (all[p].sent.back().end - 1) / unit_rows + 1};
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
    const auto later_first = [](const auto& time) {
      return [&time](const Peer* a, const Peer* b) { return time(*a) > time(*b); };
    };
    std::sort(to_take_.begin(), to_take_.end(), later_first(taking_time()));
    std::sort(to_send_.begin(), to_send_.end(), later_first(sending_time()));
  }

  /// To be called before a unit is looked at. Takes in the messages that it needs, and calls `visit(row)` for
  /// the ghost rows in them.
  template <class Visit>
  void before(std::int64_t unit, const Visit& visit) {
    while (!to_take_.empty() && taking_time()(*to_take_.back()) <= time(unit)) take(visit);
  }
  /// To be called when the units up to this one, in the order of the sweep, are done. Sends the messages that
  /// are complete.
  void after(std::int64_t unit) {
    while (!to_send_.empty() && sending_time()(*to_send_.back()) <= time(unit)) send();
  }
  /// Receives messages that have arrived, without taking them in.
  void listen() {
    for (auto peer = to_take_.rbegin(); peer != to_take_.rend(); ++peer) {
      if ((*peer)->arrived) continue;
      if (!ranks_.has_message((*peer)->share->rank)) return;
      (*peer)->arrived = ranks_.receive((*peer)->share->rank);
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
      if (!peer.share->received.empty()) static_cast<void>(ranks_.receive(peer.share->rank));
    }
  }

 private:
  struct Peer {
    const RowShare::Peer* share = nullptr;
    RowShare::Range meeting;       ///< units from the first to the last that can meet rows of it
    RowShare::Range sent;          ///< units from the first to the last with rows that it holds
    std::uint32_t told = 0;        ///< the last batch whose changes it was sent
    std::optional<Bytes> arrived;  ///< a message that was received and not taken in
  };

  /// Ascends in the order of the sweep.
  [[nodiscard]] std::int64_t time(std::int64_t unit) const { return backwards_ ? -unit : unit; }
  [[nodiscard]] auto taking_time() const {
    return [this](const Peer& peer) {
      if (peer.meeting.begin == peer.meeting.end) return std::numeric_limits<std::int64_t>::max();
      return backwards_ ? 1 - peer.meeting.end : peer.meeting.begin;
    };
  }
  [[nodiscard]] auto sending_time() const {
    return [this](const Peer& peer) { return backwards_ ? -peer.sent.begin : peer.sent.end - 1; };
  }

  void send() {
    Peer& peer = *to_send_.back();
    to_send_.pop_back();
    ranks_.send(peer.share->rank, messages_.message(*peer.share, [&](std::int64_t row) {
      return dirty_.has_changed_after(peer.told, row);
    }));
    peer.told = dirty_.batch();
  }

  template <class Visit>
  void take(const Visit& visit) {
    Peer& peer = *to_take_.back();
    to_take_.pop_back();
    const Bytes message =
        peer.arrived ? *std::exchange(peer.arrived, std::nullopt) : ranks_.receive(peer.share->rank);
    dirty_.begin_batch();
    messages_.take(message, [&](std::int64_t row, const Level* cells) {
      levels_.put(row, cells);
      visit(row);
    });
  }

  LevelRows<Level>& levels_;
  Ranks& ranks_;
  LevelMessages<Level> messages_;
  DirtyRows& dirty_;
  bool backwards_ = false;
  std::vector<Peer> peers_;
  std::vector<Peer*> to_take_;  ///< in this sweep, the next one last
  std::vector<Peer*> to_send_;
};

}  // namespace coordreq
