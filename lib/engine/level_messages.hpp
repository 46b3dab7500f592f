#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "base/requires.hpp"
#include "engine/level_rows.hpp"
#include "ranks/exchange_row_bytes.hpp"

namespace coordreq {

/// Messages with rows of levels: all lanes of each.
template <class Level>
class LevelMessages {
 public:
  /// @pre unchecked: `levels` outlive this object
  explicit LevelMessages(const LevelRows<Level>& levels)
      : levels_(levels),
        lanes_(static_cast<std::size_t>(levels.row_length())),
        cells_(lanes_ + kLevelBlock / sizeof(Level)) {}

  /// The rows that a peer holds and for which is_sent(row) is true.
  template <class IsSent>
  [[nodiscard]] Bytes message(const RowShare::Peer& peer, const IsSent& is_sent) const {
    return rows_message(peer, is_sent, [this](std::int64_t row) { return bytes_of(row); });
  }
  /// Reads a message. @param put called with the number of each row and its levels, in whole blocks
  template <class Put>
  void take(const Bytes& message, const Put& put) {
    take_rows(message, lanes_ * sizeof(Level), putting(put));
  }
  /// exchange_row_bytes() of these messages. @pre there are several processes
  template <class IsSent, class Put>
  void exchange(const IsSent& is_sent, const Put& put) {
    REQUIRES(levels_.share() != nullptr);
    exchange_row_bytes(
        *levels_.share(), lanes_ * sizeof(Level), is_sent, [this](std::int64_t row) { return bytes_of(row); },
        putting(put));
  }

 private:
  [[nodiscard]] std::span<const std::byte> bytes_of(std::int64_t row) const {
    return std::as_bytes(std::span(levels_.row(row), lanes_));
  }
  template <class Put>
  [[nodiscard]] auto putting(const Put& put) {
    return [this, &put](std::int64_t row, std::span<const std::byte> bytes) {
      std::memcpy(cells_.data(), bytes.data(), bytes.size());
      put(row, std::as_const(cells_).data());
    };
  }

  const LevelRows<Level>& levels_;
  std::size_t lanes_;
  std::vector<Level> cells_;
};

}  // namespace coordreq
