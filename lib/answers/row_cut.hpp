#pragma once

#include <cstdint>
#include <vector>

#include "engine/row_engine.hpp"
#include "model/model.hpp"

namespace coordreq {

/// True if some table may have entries for every cell. Such tables are divided as the cells are, so that the
/// cut is known before them; and there rows run along the last dimension alone (join_rows()).
[[nodiscard]] bool is_cut_before_tables(const Model& model);

/// Cuts the rows into runs, one for each process, with about as many rows each in which S may have cells,
/// judged by a few rows of each bin: the rows of model.grid() where is_cut_before_tables(), else those of the
/// engine.
/// @param engine may be null where is_cut_before_tables()
/// @returns parts + 1 ascending numbers, as cut_rows()
[[nodiscard]] std::vector<std::int64_t> cut_into_shares(const Model& model, const RowEngine* engine,
                                                        int ranks);

}  // namespace coordreq
