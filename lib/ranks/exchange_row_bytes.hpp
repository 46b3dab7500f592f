#pragma once

#include <span>
#include <utility>

#include "ranks/row_share.hpp"

namespace coordreq {

/// Sends what stands in rows to the ranks in whose halo they are, and takes in what these send. Together.
/// @param row_bytes of every row
/// @param is_sent is asked of own rows, perhaps several times @param bytes_of an own row
/// @param take is given the number of a row of the halo and its bytes
template <class IsSent, class BytesOf, class Take>
void exchange_row_bytes(const RowShare& share, std::size_t row_bytes, const IsSent& is_sent,
                        const BytesOf& bytes_of, const Take& take) {
  for (const RowShare::Peer& peer : share.peers()) {
    if (peer.sent.empty()) continue;
    Bytes message;
    for (const RowShare::Range run : peer.sent) {
      for (std::int64_t row = run.begin; row < run.end; ++row) {
        if (!is_sent(row)) continue;
        put_numbers<std::int64_t>(message, {&row, 1});
        put_numbers<std::byte>(message, bytes_of(row));
      }
    }
    share.ranks().send(peer.rank, std::move(message));
  }
  for (const RowShare::Peer& peer : share.peers()) {
    if (peer.received.empty()) continue;
    const Bytes message = share.ranks().receive(peer.rank);
    for (MessageReader reader(message); !reader.is_at_end();) {
      const std::int64_t row = reader.number();
      take(row, reader.take(row_bytes));
    }
  }
}

}  // namespace coordreq
