#pragma once

#include "app/options.hpp"
#include "results/compare_results.hpp"

namespace coordreq {

/// Prints what `compare` has found. What fields are compared by stands under their names, but for the delay,
/// which is under `partitions`.
void print_comparison(const CommonOptions& asked, const ResultsComparison& comparison,
                      const ResultsReader& before, const ResultsReader& after, const CompareOptions& options);

}  // namespace coordreq
