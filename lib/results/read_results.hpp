#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/requirements/result_requirement.hpp"

namespace coordreq {

struct ResultInfo {
  struct Axis {
    std::string name;
    std::string unit;  ///< as UDUNITS spells it; empty if none
    std::uint64_t points = 0;
    double first = 0, last = 0;
  };
  struct Partition {
    std::string name;
    std::int32_t fixed_point_index = -1;  ///< F, -1 if truncated
    std::vector<std::uint64_t> layer_sizes;
  };
  struct Coalition {
    std::int64_t horizon = 0;         ///< steps
    std::vector<std::int64_t> cells;  ///< [partition] that are given it; empty if there are very many
    std::vector<std::pair<std::string, std::int64_t>> critical_pairs;  ///< and the cells where they are
  };
  std::string path, name, coordreq_version, git_sha1, spec_sha256, guarantee, period_unit;
  double period = 0;
  std::vector<Axis> states, inputs;
  std::string controller_sha256;  ///< of `controller.file`; empty if there is none
  std::uint64_t cells = 0, safe_cells = 0, invariant_cells = 0;
  std::int64_t connection_delay = 0;
  std::vector<Partition> partitions;
  std::optional<Coalition> coalition;  ///< if there is a coalition map
  struct Mode {
    std::string name;
    std::uint64_t safe_cells = 0;
  };
  std::vector<Mode> modes;  ///< of the network; none without one
  std::vector<ResultRequirement> requirements;
  std::vector<std::string> datasets;  ///< paths, sorted; without bare dimensions, which hold no data
};

/// What `coordreq info` shows. @param max_memory as of ResultsReader
/// @throws IoError if the file is not there or cannot be read; ResultsError if it is not a results file of a
///   version this program reads, or a part that every file has is missing or has the wrong shape
[[nodiscard]] ResultInfo read_info(const std::string& path,
                                   std::optional<std::uint64_t> max_memory = std::nullopt);

}  // namespace coordreq
