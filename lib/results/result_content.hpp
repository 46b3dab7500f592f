#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/field.hpp"
#include "answers/requirements/result_requirement.hpp"

// What goes into a results file, contract section 4, as plain data. Large arrays are handed over as
// functions that fill a stretch, so that nothing is held twice.
namespace coordreq {

/// A state or an input: one dimension scale.
struct ResultAxis {
  std::string name;
  std::string unit;            ///< empty if none
  std::vector<double> points;  ///< grid points
  std::optional<double> step;  ///< none for listed input values
  bool is_state = true;
};

/// The layers T(0), ..., T(F) of one partition as index lists; contract `/layers/PARTITION`.
struct ResultLayers {
  std::vector<std::uint64_t> start;  ///< F + 2 entries
  ResultArray cell;                  ///< start.back() entries, uint32 or uint64
};

/// Admissible joint actions of a class (or joint inputs of all) per cell, bit-packed little-endian;
/// contract `/actions/PARTITION/CLASS` and `/controller`.
struct ResultBits {
  std::string class_name;           ///< agents joined with "+"
  std::vector<std::string> inputs;  ///< names of the inputs it ranges over, in spec order
  std::uint64_t actions = 0;        ///< m; the last axis has ceil(m / 8) bytes
  FillArray fill;                   ///< uint8 [n_1, ..., n_d, ceil(m / 8)]
};

struct ResultPartition {
  std::string name;
  std::vector<std::string> classes;        ///< names of the classes
  std::vector<std::uint64_t> layer_sizes;  ///< |Z_0|, ..., |Z_F| (or to the last computed layer if truncated)
  std::int32_t fixed_point_index = -1;     ///< F; -1 if truncated
  bool truncated = false;
  std::uint64_t unbounded = 0;  ///< |Z_F|; 0 if truncated
  ResultArray delay;            ///< int16 or int32, [cells]; all partitions have the same type
  ResultArray trigger;          ///< likewise
  std::optional<ResultLayers> layers;
  std::vector<ResultBits> actions;
};

/// The finite abstraction of one state dimension; contract `/abstraction/NAME/first` and `.../last`.
struct ResultTable {
  std::string state;
  std::vector<std::string> depends_on;  ///< axis names, in the order of the arrays' axes; may be empty
  std::vector<std::int32_t> first;      ///< row-major over `depends_on`
  std::vector<std::int32_t> last;
};

/// A list of names that is the leading axis of maps, such as the modes of a network: a dimension scale of
/// strings.
struct ResultNames {
  std::string name;  ///< of the axis, reserved in contract section 4
  std::string long_name;
  std::vector<std::string> names;
};

/// A value a cell, or one for each name of a leading axis and each cell; no unit.
struct ResultMap {
  std::string name;  ///< of the dataset, reserved in contract section 4
  std::string long_name;
  std::string leading;                                         ///< a ResultNames or "partition"; empty: none
  std::vector<std::pair<std::int64_t, std::string>> flags;     ///< values that mean a word, CF `flag_values`
  std::vector<std::pair<std::string, std::int64_t>> integers;  ///< further attributes
  /// The attribute `cells`: how many cells have each value, from 0 on, or value 1 for each name of the
  /// leading axis. No such attribute if empty, or longer than 4096.
  std::vector<std::int64_t> cells;
  ResultArray values;  ///< [names, cells] or [cells]
};

struct ResultContent {
  std::string name;  ///< of the spec; attribute `title`
  std::string spec_text;
  std::string guarantee;  ///< "samples", "samples-center", "continuous"
  double period = 0;
  std::string period_unit;  ///< as in the spec, empty if none
  std::int64_t connection_delay = 0;
  bool triggers_are_delays = false;  ///< all partitions' arrays of both are equal: they are packed once
  std::vector<ResultAxis> axes;      ///< states in order, then inputs in order
  std::uint64_t safe_cells = 0, invariant_cells = 0;
  ResultArray safe, invariant;  ///< uint8 [cells]
  ResultArray collision_time;   ///< int16 or int32 [cells]
  std::int64_t iterations = 0;
  std::vector<ResultPartition> partitions;
  std::optional<ResultBits> controller;
  std::optional<ResultBits> listed;  ///< pairs that a controller file lists; `/controller:file`
  std::string listed_sha256;         ///< of that file
  std::vector<ResultTable> abstraction;
  std::vector<ResultRequirement> requirements;
  std::vector<ResultBits> convention;  ///< one an agent, or none; `/actions:convention/AGENT`
  std::vector<ResultNames> names;      ///< leading axes of `maps`
  std::vector<ResultMap> maps;         ///< what else is known of each cell
};

}  // namespace coordreq
