#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/field_source.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The stored values of a partition that are not arrays over cells.
struct StoredPartition {
  std::string name;
  std::vector<std::string> classes;         ///< names of the classes, in the order of the spec
  std::vector<std::int64_t> actions;        ///< joint actions of each class
  std::int32_t fixed_point_index = -1;      ///< F; -1 if truncated
  std::vector<std::uint64_t> layer_sizes;   ///< |Z_0|, ..., |Z_F|; as far as stored if truncated
  std::vector<std::uint64_t> padded_sizes;  ///< the whole row of /layer_size
  [[nodiscard]] bool truncated() const { return fixed_point_index < 0; }
};

/// /layers/PARTITION: T(k) is cell[start[k]], ..., cell[start[k + 1] - 1].
struct StoredLayers {
  std::vector<std::uint64_t> start;
  std::vector<std::uint64_t> cell;
};

/// @param prefix of the paths, see add_sizes()
/// @throws ResultsError if an F is no layer
[[nodiscard]] std::vector<StoredPartition> read_partition_values(const ProblemSpec& spec,
                                                                 const FieldSource& source,
                                                                 const std::string& prefix = "/");
/// @pre unchecked: the lists are stored. @throws ResultsError unless `start` ascends from 0 to the number of
///   cells and `cell` holds cells of the grid
[[nodiscard]] StoredLayers read_layer_lists(const ProblemSpec& spec, const PartitionSpec& partition,
                                            const FieldSource& source);

}  // namespace coordreq
