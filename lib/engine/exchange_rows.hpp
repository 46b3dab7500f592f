#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "engine/level_rows.hpp"
#include "ranks/exchange_row_bytes.hpp"

namespace coordreq {

/// exchange_row_bytes() of the cells of levels. @param take is given as many lanes as a row has, in whole
/// blocks
/// REQUIRES: there are several processes.
template <class Level, class IsSent, class Take>
void exchange_rows(const LevelRows<Level>& levels, const IsSent& is_sent, const Take& take) {
  const auto lanes = static_cast<std::size_t>(levels.row_length());
  std::vector<Level> cells(lanes + kLevelBlock / sizeof(Level));
  exchange_row_bytes(
      *levels.share(), lanes * sizeof(Level), is_sent,
      [&](std::int64_t row) { return std::as_bytes(std::span(levels.row(row), lanes)); },
      [&](std::int64_t row, std::span<const std::byte> bytes) {
        std::memcpy(cells.data(), bytes.data(), bytes.size());
        take(row, std::as_const(cells).data());
      });
}

}  // namespace coordreq
