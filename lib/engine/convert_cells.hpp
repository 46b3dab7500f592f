#pragma once

#include <cstdint>

#include "engine/level_rows.hpp"
#include "model/cell_order.hpp"

namespace coordreq {

/// out[i] = convert(level of cell begin + i of the spec's grid) for a run of `count` cells; cells that
/// are never lost have the greatest level of the width.
template <class Out, class Level, class Convert>
void convert_cells(const LevelRows<Level>& levels, const CellOrder& order, std::uint64_t begin,
                   std::uint64_t count, Out* out, const Convert& convert) {
  order.for_each_run(static_cast<std::int64_t>(begin), static_cast<std::int64_t>(count),
                     [&](const CellOrder::Run& run) {
                       Out* target = out + run.offset;
                       if (run.row_step != 0) {
                         for (std::int64_t i = 0; i < run.count; ++i)
                           target[i] = convert(levels.row(run.row + i * run.row_step)[run.column]);
                         return;
                       }
                       const Level* source = levels.row(run.row) + run.column;
                       if (run.column_step == 1) {  // a loop of its own, which compilers vectorise
                         for (std::int64_t i = 0; i < run.count; ++i) target[i] = convert(source[i]);
                       } else {
                         for (std::int64_t i = 0; i < run.count; ++i)
                           target[i] = convert(source[i * run.column_step]);
                       }
                     });
}

}  // namespace coordreq
