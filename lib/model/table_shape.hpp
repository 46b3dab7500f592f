#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spec/spec_types.hpp"

namespace coordreq {

/// The variables that the next value of one state depends on; indices into the spec's lists, ascending.
struct Dependencies {
  std::vector<std::int32_t> moving;      ///< states that count with the box of a cell
  std::vector<std::int32_t> parameters;  ///< discrete states whose values are put in one by one
  std::vector<std::int32_t> inputs;
  std::vector<std::int32_t> disturbances;

  /// The moving ones and the parameters, ascending.
  [[nodiscard]] std::vector<std::int32_t> all_states() const;
  [[nodiscard]] bool operator==(const Dependencies&) const = default;
};

/// Read off the equations: in discrete time that of `state`, in continuous time all that it depends on,
/// itself included; but off the update of a state that has one.
[[nodiscard]] Dependencies find_dependencies(const SystemSpec& spec, std::size_t state);

/// The variables that the next value of one state depends on, and the form and size of its table; known
/// without the entries. Indices are those of the spec's lists, ascending.
struct TableShape : Dependencies {
  std::vector<std::int32_t>
      states;                       ///< moving and parameters, the state itself included, if it depends on it
  std::vector<std::int32_t> terms;  ///< states in which it is affine, with a term each; of a sum only
  bool shift = false;  ///< only as an offset to the present value, kept once for all present ones
  bool sum = false;    ///< there are terms; if that fails it is in full after all
  double entries = 1;  ///< that are stored; may be beyond what an integer holds
  double bytes = 0;

  /// Entries are for every cell, if it is in full. @param all states there are
  [[nodiscard]] bool is_by_cells(std::size_t all) const { return !shift && !sum && states.size() == all; }
};

}  // namespace coordreq
