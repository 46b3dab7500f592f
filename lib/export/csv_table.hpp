#pragma once

#include "export/cell_table.hpp"
#include "export/text_sink.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// One line a cell that the selection leaves: the centre in the dimensions that remain, then `safe`,
/// `invariant`, `collision_time` and for each partition `delay:P` and `countdown:P`, coded as in the results
/// file with "inf" for its maximum. The first line names the columns.
void export_csv(const ResultsReader& results, const TableSelection& selection, const TextSink& sink);

}  // namespace coordreq
