#pragma once

#include <cstdint>

#include "answers/one_cell/policy.hpp"
#include "base/json.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The document of `info`: the origin of a results file, its axes, the members of each answer, and
/// `datasets`: paths, sorted, without bare dimensions, which hold no data.
/// Each partition has a best state (`best_state`, see best_state_json()) of each of headline_policies(), if
/// is_looked_at(). @throws as ResultsReader
[[nodiscard]] Json read_info(const ResultsReader& results);

/// Up to so many values of a file are looked at for its best states.
inline constexpr std::int64_t kMostCellsLookedAt = 16'000'000;

/// Whether the file is small enough to look for its best states.
[[nodiscard]] bool is_looked_at(const ResultsReader& results);

/// The first cell with the longest finite number of steps of a policy in a partition; where none is above 0
/// the first with an unbounded one; -1 if there is neither, or if none is known to be the longest.
/// @param sizes of the policy's layers in the partition
[[nodiscard]] std::int64_t best_cell(const ResultsReader& results, const AnswerPolicy& policy, std::size_t p,
                                     const StoredPartition& sizes);

/// The centre of best_cell() by the names of the states; null if there is none.
[[nodiscard]] Json best_state_json(const ResultsReader& results, const AnswerPolicy& policy, std::size_t p,
                                   const StoredPartition& sizes);

}  // namespace coordreq
