#pragma once

#include <cstdint>
#include <vector>

#include "model/input_space.hpp"
#include "model/odometer.hpp"
#include "model/table_shape.hpp"
#include "model/uniform_grid.hpp"
#include "reach/box_choices.hpp"
#include "reach/state_enclosure.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// States whose posts build_abstraction() takes from the same enclosures.
struct EnclosedGroup {
  std::vector<std::size_t> states;
  std::vector<std::int32_t> terms;  ///< states that are added later: their boxes are 0 (build_sum_tables())
};

/// All of them. A state that is affine for the least, the middle and the greatest choice of parameters and
/// inputs is taken to be affine.
/// @param shapes of table_shapes()
[[nodiscard]] std::vector<EnclosedGroup> enclosed_groups(const SystemSpec& spec,
                                                         const std::vector<TableShape>& shapes);

/// Encloses some boxes of a group, to see what all of them take. Not thread-safe.
class EnclosureSample {
 public:
  /// @pre unchecked: `spec` outlives this object.
  EnclosureSample(const SystemSpec& spec, const EnclosedGroup& group);

  /// Choices of indices of all that the states depend on: so many boxes are enclosed for the tables.
  [[nodiscard]] double choices() const;

  /// Encloses the box of one more choice; choices lie all over the grid, the same every time.
  /// @returns how many subboxes were enclosed
  std::int64_t enclose_next();
  /// See StateEnclosure: of all boxes so far.
  [[nodiscard]] std::int64_t work() const { return enclosure_.work(); }

 private:
  StateEnclosure enclosure_;
  BoxChoices choices_;
  std::vector<std::int64_t> counts_;
  std::vector<double> strides_;  ///< one a variable, of a sequence that fills a cube evenly
  std::int64_t drawn_ = 0;
};

}  // namespace coordreq
