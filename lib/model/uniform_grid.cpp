#include "model/uniform_grid.hpp"

#include <utility>

namespace coordreq {

UniformGrid::UniformGrid(std::vector<GridDimension> dimensions) : UniformGrid(std::move(dimensions), {}) {}

UniformGrid::UniformGrid(std::vector<GridDimension> dimensions, const std::vector<std::int64_t>& gaps)
    : dimensions_(std::move(dimensions)),
      strides_(dimensions_.size()),
      across_(dimensions_.size() - gaps.size() - 1) {
  for (std::size_t i = dimensions_.size(); i-- > 0;) {
    strides_[i] = cells_;
    cells_ *= dimensions_[i].count + (i > across_ ? gaps[i - across_ - 1] : 0);
    if (i == across_) row_length_ = cells_;
  }
}

std::int64_t UniformGrid::points() const {
  std::int64_t product = 1;
  for (const GridDimension& dimension : dimensions_) product *= dimension.count;
  return product;
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
