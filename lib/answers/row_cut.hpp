#pragma once

#include <cstdint>
#include <vector>

#include "engine/row_engine.hpp"
#include "model/model.hpp"

namespace coordreq {

/// Cuts the rows of a grid into runs, one a process, with about as many in which S may have cells, as some
/// rows of each block tell.
/// @param unit_rows rows that are not cut, if these are not too many
/// @returns parts + 1 ascending numbers, as cut_rows()
[[nodiscard]] std::vector<std::int64_t> cut_by_safe_rows(const ProblemSpec& spec, const UniformGrid& grid,
                                                         std::int64_t unit_rows, int parts);

/// True if some table may have entries for every cell. Such tables are divided as the cells are, so that the
/// cut is known before them; and there rows run along the last dimension alone (join_rows()).
[[nodiscard]] bool is_cut_before_tables(const Model& model);

/// The cut of a problem: of the rows of model.grid() then, else of those of the engine.
/// @param engine may be null where is_cut_before_tables()
[[nodiscard]] std::vector<std::int64_t> cut_into_shares(const Model& model, const RowEngine* engine,
                                                        int parts);

}  // namespace coordreq
