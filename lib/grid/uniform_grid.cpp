#include "grid/uniform_grid.hpp"

#include <utility>

namespace coordreq {

UniformGrid::UniformGrid(std::vector<GridDimension> dimensions)
    : dimensions_(std::move(dimensions)), strides_(dimensions_.size()) {
  for (std::size_t i = dimensions_.size(); i-- > 0;) {
    strides_[i] = cells_;
    cells_ *= dimensions_[i].count;
  }
}

UniformGrid make_grid(const ProblemSpec& spec) {
  std::vector<GridDimension> dimensions;
  for (const StateSpec& state : spec.states) {
    dimensions.push_back({.name = state.name,
                          .first = state.grid.first,
                          .step = state.grid.step,
                          .count = state.grid.count,
                          .discrete = state.discrete,
                          .below = state.below,
                          .above = state.above,
                          .lower = state.lower,
                          .upper = state.upper,
                          .measurement_error = state.measurement_error});
  }
  return UniformGrid(std::move(dimensions));
}

}  // namespace coordreq
