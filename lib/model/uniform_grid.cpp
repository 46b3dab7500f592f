#include "model/uniform_grid.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/requires.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

std::vector<std::size_t> natural_order(std::size_t size) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

}  // namespace

UniformGrid::UniformGrid(const std::vector<GridDimension>& dimensions)
    : UniformGrid(dimensions, natural_order(dimensions.size()), {}) {}

UniformGrid::UniformGrid(std::vector<GridDimension> dimensions, std::vector<std::size_t> states,
                         const std::vector<std::int64_t>& gaps)
    : dimensions_(std::move(dimensions)),
      states_(std::move(states)),
      strides_(dimensions_.size()),
      across_(dimensions_.size() - gaps.size() - 1) {
  for (std::size_t i = dimensions_.size(); i-- > 0;) {
    strides_[i] = cells_;
    cells_ *= dimensions_[i].count + (i > across_ ? gaps[i - across_ - 1] : 0);
    if (i == across_) row_length_ = cells_;
  }
  for (std::size_t i = 0; i < across_ && i < strides_.size(); ++i)
    row_strides_.push_back(strides_[i] / row_length_);
}

UniformGrid UniformGrid::arranged(const std::vector<std::size_t>& order) const {
  REQUIRES(std::ranges::is_permutation(order, natural_order(size())));
  std::vector<GridDimension> dimensions;
  std::vector<std::size_t> states;
  for (const std::size_t i : order) {
    dimensions.push_back(dimensions_[i]);
    states.push_back(states_[i]);
  }
  return {std::move(dimensions), std::move(states), {}};
}

UniformGrid UniformGrid::in_rows(const std::vector<std::int64_t>& gaps) const {
  return {dimensions_, states_, gaps};
}

UniformGrid UniformGrid::with(std::vector<GridDimension> dimensions) const {
  REQUIRES(std::ranges::equal(dimensions, dimensions_, {}, &GridDimension::count, &GridDimension::count));
  UniformGrid result = *this;
  result.dimensions_ = std::move(dimensions);
  return result;
}

std::size_t UniformGrid::dimension_of(std::size_t state) const {
  return static_cast<std::size_t>(std::find(states_.begin(), states_.end(), state) - states_.begin());
}

std::int64_t UniformGrid::points() const {
  std::int64_t product = 1;
  for (const GridDimension& dimension : dimensions_) product *= dimension.count;
  return product;
}

UniformGrid make_grid(const SystemSpec& spec) {
  std::vector<GridDimension> dimensions;
  for (const StateSpec& state : spec.states) dimensions.push_back(dimension_of(state));
  return UniformGrid(std::move(dimensions));
}

}  // namespace coordreq
