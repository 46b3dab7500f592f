#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <string>
#include <vector>

#include "spec/spec_types.hpp"

// Sizes that no run could handle, refused before anything is allocated for them.
namespace coordreq {

/// @throws LimitError if one dimension has more than 2^31 - 2 points, the most that an index takes
void check_point_count(const mpz_class& count, const std::string& pointer);

/// @throws LimitError if one input has more than 2^20 values; they are kept as a list of exact numbers
void check_value_count(std::int64_t count, const std::string& pointer);

/// @throws LimitError if all values of an input together have more than 2^28 bits
void check_value_bits(const GridSpec& values, const std::string& pointer);

/// @throws LimitError if there are more than 31 states (an HDF5 dataset has at most 32 axes) or more than
/// 2^62 cells
void check_cell_count(const std::vector<StateSpec>& states);

/// @throws LimitError if there are more than 2^31 joint inputs
/// @param counts number of values of each input
void check_joint_input_count(const std::vector<std::int64_t>& counts);

/// @throws LimitError if a network has more than `limit` modes; each takes a set of cells
void check_mode_count(std::size_t count, std::size_t limit, const std::string& pointer);

/// @throws LimitError if there are more than 7 agents: they have 877 partitions, 8 have 4140
void check_all_partitions(std::size_t agents, const std::string& pointer);

}  // namespace coordreq
