#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "engine/packed_pairs.hpp"

namespace coordreq {

/// Infinite delays, triggers and collision times, whatever type they are stored as.
inline constexpr std::int32_t kForever = INT32_MAX;
/// What a delay says of cells that have none.
inline constexpr std::int32_t kOutsideSafe = -2;
inline constexpr std::int32_t kOutsideInvariant = -1;
/// And an approach delay of cells in K from where the goal cannot be forced.
inline constexpr std::int32_t kNoWayToGoal = -4;

/// What a results file says about one partition. Arrays over all cells, row-major.
struct PartitionClaims {
  std::string name;
  std::vector<std::int32_t> delay;
  std::vector<std::int32_t> trigger;
  std::int32_t fixed_point_index = -1;     ///< F; -1: unknown because max_delay stopped the iteration
  std::vector<std::uint64_t> layer_sizes;  ///< the whole row of the file
  std::vector<std::vector<std::uint8_t>>
      actions;  ///< [class]: bytes [cells, ceil(m / 8)]; empty if not stored
  bool has_layers = false;
  std::vector<std::uint64_t> layer_start;
  std::vector<std::uint64_t> layer_cell;
};

/// What a results file says, all of it to be doubted.
struct Claims {
  std::vector<std::uint8_t> safe;       ///< 0 or 1
  std::vector<std::uint8_t> invariant;  ///< 0 or 1
  std::vector<std::int32_t> collision_time;
  std::vector<PartitionClaims> partitions;  ///< those of the spec, in its order
  bool has_controller = false;
  std::vector<ResultRequirement> requirements;  ///< those of the spec, in its order
  std::vector<std::uint8_t> controller;         ///< bytes [cells, ceil(joint inputs / 8)]
  std::optional<PackedPairs> listed;            ///< what `controller.file` lists, which is not doubted
  std::vector<PostTable> abstraction;           ///< one a state, or none
  /// [path][cell]: fields of numbers over cells alone that have no member here. kForever: the largest number
  /// of the type, where it has that meaning.
  std::map<std::string, std::vector<std::int32_t>> numbers;
  /// The same over partitions and cells: [path][partition][cell].
  std::map<std::string, std::vector<std::vector<std::int32_t>>> partition_numbers;
  /// [path]: bytes [cells, ceil(m / 8)] of fields of one bit an action that have no member here.
  std::map<std::string, std::vector<std::uint8_t>> bits;
  std::map<std::string, std::vector<std::int64_t>> lists;  ///< [path]: small fields of partitions
  std::map<std::string, std::int64_t> attributes;          ///< "PATH NAME": of those fields, as found
  // With a horizon:
  std::vector<std::int64_t> coalition_cells;              ///< [partition] as counted; may be missing
  std::vector<std::string> pairs;                         ///< of agents, in their order
  std::vector<std::vector<std::uint8_t>> critical_pairs;  ///< [pair, cell]: 0 or 1
  std::vector<std::int64_t> critical_pair_cells;          ///< [pair] as counted; may be missing
  std::vector<std::vector<std::uint8_t>> network;         ///< [mode][cell] 0 or 1; none without a network
  std::vector<std::uint64_t> network_cells;               ///< by mode
  std::vector<std::vector<float>> convention_freedom;     ///< [agent][cell]; none without a convention
  std::vector<std::vector<std::uint8_t>>
      convention;            ///< [agent]: bytes [cells, ceil(m / 8)] of what it may do; none if not stored
  bool same_version = true;  ///< written by this version of the program
  std::uint64_t safe_cells = 0;
  std::uint64_t invariant_cells = 0;
  std::int64_t iterations = 0;
};

}  // namespace coordreq
