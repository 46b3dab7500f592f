#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/results_reader.hpp"

// The losses and gains of a later result of the same grid against an earlier one.
// Whether and where two results can be compared cell by cell.
namespace coordreq {

/// A set of cells in both files, with its name there and its label.
struct SetComparison {
  std::string name;         ///< "safe"
  std::string label;        ///< "safe set"
  std::int64_t before = 0;  ///< cells
  std::int64_t after = 0;
  std::int64_t left = 0;    ///< that are only in the earlier one
  std::int64_t joined = 0;  ///< only in the later one
};

/// Values of a cell, as ResultsReader::values() reads them.
struct ValueChange {
  std::int64_t cell = 0;
  std::int32_t before = 0;
  std::int32_t after = 0;
};

/// Where a field has a leading axis, such as that of partitions: an entry that both files have.
struct EntryPair {
  std::size_t before = 0;  ///< position along the axis in the earlier file
  std::size_t after = 0;
};

/// A field of numbers, such as the delay, of which more is better, or of arrivals, of which less is. Of
/// probabilities values are the bits, see probability_of(), and nothing is tolerated. Delays
/// are compared as what each file guarantees: a cell outside K tolerates less than a cell with delay 0,
/// unbounded is more than every number, and where `max_delay` stopped an analysis its last delay counts as it
/// is, though the true one may be larger.
struct ValueComparison {
  std::string name;   ///< "delay"
  std::string label;  ///< what it is called
  std::optional<EntryPair> entry;
  std::int64_t lost = 0;          ///< cells with a smaller value than before
  std::int64_t left = 0;          ///< of these, cells that have left K
  std::int64_t from_forever = 0;  ///< of these, cells that are in K and were unbounded
  /// of these, cells with the last delay before `max_delay` of the later file: perhaps they have lost nothing
  std::int64_t cut_off = 0;
  std::int64_t tolerated = 0;      ///< cells that lost steps, but no more than is tolerated; not in `lost`
  std::int64_t gained = 0;         ///< cells with a larger value than before
  std::vector<ValueChange> worst;  ///< of `lost`, see CompareOptions::worst
};

/// A requirement that both files have, by its name, with another verdict.
struct VerdictChange {
  std::string name;
  bool holds_after = false;
};

struct ResultsComparison {
  // Of the fields that both files have and are compared by:
  std::vector<SetComparison> sets;
  std::vector<ValueComparison> values;   ///< one field after the other, partition by partition
  std::vector<EntryPair> partitions;     ///< that both files have
  std::vector<std::size_t> only_before;  ///< partitions that the later file does not have
  std::vector<std::size_t> only_after;   ///< partitions that the earlier file does not have
  std::vector<VerdictChange> verdicts;
  std::vector<std::string> requirements_only_before;
  std::vector<std::string> requirements_only_after;

  /// Whether a cell has lost value, or left K, or a requirement no longer holds.
  [[nodiscard]] bool is_worse() const;
};

struct CompareOptions {
  /// A cell may lose so many steps, unless it leaves K or was unbounded.
  std::int64_t tolerance = 0;
  /// Cells to name for each comparison: first those that have left K, then those that were unbounded, each by
  /// the steps that they have lost, then by number.
  std::size_t worst = 5;
  std::function<void(const std::string& subject)> progress;  ///< often; may be empty
};

/// Reads about a million cells at a time, so that memory does not depend on the size of the files. Partitions
/// are the same if they have the same name, or else the same classes.
/// @throws ResultsError naming the first difference if states, grids or periods are not the same, or no
///   partition is in both files; as ResultsReader does
[[nodiscard]] ResultsComparison compare_results(const ResultsReader& before, const ResultsReader& after,
                                                const CompareOptions& options);

/// @throws ResultsError naming the first difference if states, their grids or units, or periods are not the
///   same
void check_comparable(const ResultsReader& before, const ResultsReader& after);

/// Pairs of partitions with the same name, or else the same classes, and those that are in one spec only.
void match_partitions(const ProblemSpec& before, const ProblemSpec& after, ResultsComparison& result);

}  // namespace coordreq
