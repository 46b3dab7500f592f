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

}  // namespace coordreq
