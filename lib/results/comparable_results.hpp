#pragma once

#include "results/compare_results.hpp"

// Whether and where two results can be compared cell by cell.
namespace coordreq {

/// @throws ResultsError naming the first difference if states, their grids or units, or periods are not the
///   same
void check_comparable(const ResultsReader& before, const ResultsReader& after);

/// Pairs of partitions with the same name, or else the same classes, and those that are in one spec only.
void match_partitions(const ProblemSpec& before, const ProblemSpec& after, ResultsComparison& result);

}  // namespace coordreq
