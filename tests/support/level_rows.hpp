#pragma once

#include <cstdint>

#include "engine/level_map.hpp"

namespace coordreq {

/// Gives the cells of a row the levels that a map has there. REQUIRES: rows of both lie alike.
template <class Level>
void put_levels_of(const LevelMap& map, std::int64_t row, LevelRows<Level>& levels) {
  levels.change_row(row, [&](Level* cells) {
    for (std::int64_t lane = 0; lane < levels.row_length(); ++lane) {
      const std::int64_t level = map.at(row * levels.row_length() + lane);
      cells[lane] = level == LevelMap::kTop ? LevelRows<Level>::kTop : static_cast<Level>(level);
    }
  });
}

}  // namespace coordreq
