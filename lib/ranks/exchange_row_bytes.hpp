#pragma once

#include <span>
#include <utility>

#include "ranks/row_share.hpp"

namespace coordreq {

/// A message with what stands in the rows that a peer holds too.
/// @param is_sent is called with local rows @param bytes_of a local row
template <class IsSent, class BytesOf>
[[nodiscard]] Bytes rows_message(const RowShare::Peer& peer, const IsSent& is_sent, const BytesOf& bytes_of) {
  Bytes message;
  for (const RowShare::Range run : peer.sent) {
    for (std::int64_t row = run.begin; row < run.end; ++row) {
      if (!is_sent(row)) continue;
      put_numbers<std::int64_t>(message, {&row, 1});
      put_numbers<std::byte>(message, bytes_of(row));
    }
  }
  return message;
}

/// Takes such a message in. @param row_bytes of every row @param take is given the number of a ghost
/// row and its bytes
template <class Take>
void take_rows(const Bytes& message, std::size_t row_bytes, const Take& take) {
  for (MessageReader reader(message); !reader.is_at_end();) {
    const std::int64_t row = reader.number();
    take(row, reader.take(row_bytes));
  }
}

/// Sends what stands in rows to the ranks whose ghost rows they are, and takes in what these send. Together.
template <class IsSent, class BytesOf, class Take>
void exchange_row_bytes(const RowShare& share, std::size_t row_bytes, const IsSent& is_sent,
                        const BytesOf& bytes_of, const Take& take) {
  for (const RowShare::Peer& peer : share.peers()) {
    if (!peer.sent.empty()) share.ranks().send(peer.rank, rows_message(peer, is_sent, bytes_of));
  }
  for (const RowShare::Peer& peer : share.peers()) {
    if (!peer.received.empty()) take_rows(share.ranks().receive(peer.rank), row_bytes, take);
  }
}

}  // namespace coordreq
