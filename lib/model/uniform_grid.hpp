#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/requires.hpp"
#include "model/outside.hpp"
#include "numeric/rational.hpp"
#include "spec/grid_dimension.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The cells of a state space. Linear indices are row-major, the last dimension fastest, below 2^62.
///
/// Cells come in *rows*: along the last dimension, or along several at once. In rows of several dimensions
/// each run along one that is not the first of them is followed by a gap, linear indices that are no cells:
/// room for what lies beyond both ends of the run.
///
/// Dimensions may stand in another order than the states of the spec: each knows which state it is. Nothing
/// else knows: conditions keep their numbering of variables, and users see cells in the order of the spec
/// (CellOrder).
class UniformGrid {
 public:
  /// Rows along the last dimension; dimension i is state i.
  explicit UniformGrid(const std::vector<GridDimension>& dimensions);

  /// This grid with its dimensions in another order: dimension d is dimension order[d] here. Rows run along
  /// the last one. @pre `order` is a permutation
  [[nodiscard]] UniformGrid arranged(const std::vector<std::size_t>& order) const;
  /// This grid with rows along several dimensions.
  /// @param gaps for each of the last dimensions that rows run along, but for the first of these, its gap, in
  ///   indices of that dimension; none: rows along the last dimension alone
  [[nodiscard]] UniformGrid in_rows(const std::vector<std::int64_t>& gaps) const;
  /// This grid with other rules for leaving the domain.
  /// @pre as many indices in each of `dimensions`
  [[nodiscard]] UniformGrid with(std::vector<GridDimension> dimensions) const;

  /// State of the spec that dimension i is, and the dimension of a state.
  [[nodiscard]] std::size_t state(std::size_t i) const { return states_[i]; }
  [[nodiscard]] std::size_t dimension_of(std::size_t state) const;

  [[nodiscard]] std::size_t size() const { return dimensions_.size(); }
  [[nodiscard]] const GridDimension& operator[](std::size_t i) const { return dimensions_[i]; }
  [[nodiscard]] const std::vector<GridDimension>& dimensions() const { return dimensions_; }
  /// Number of linear indices, gaps included.
  [[nodiscard]] std::int64_t cells() const { return cells_; }
  /// Number of cells.
  [[nodiscard]] std::int64_t points() const;
  /// Linear distance between neighbours in dimension i.
  [[nodiscard]] std::int64_t stride(std::size_t i) const { return strides_[i]; }

  /// Rows from one index to the next of a dimension across rows.
  [[nodiscard]] std::int64_t row_stride(std::size_t i) const { return row_strides_[i]; }
  /// Number of leading dimensions, across which rows are counted; rows run along the others.
  [[nodiscard]] std::size_t across() const { return across_; }
  /// Linear indices of a row, and number of rows: cells() = rows() * row_length().
  [[nodiscard]] std::int64_t row_length() const { return row_length_; }
  [[nodiscard]] std::int64_t rows() const { return cells_ / row_length_; }

  /// @pre `linear` is a cell's
  [[nodiscard]] std::int64_t index(std::int64_t linear, std::size_t i) const {
    REQUIRES(0 <= linear && linear < cells_);
    const std::int64_t index = i == 0 ? linear / strides_[0] : linear % strides_[i - 1] / strides_[i];
    REQUIRES(index < dimensions_[i].count);
    return index;
  }

 private:
  UniformGrid(std::vector<GridDimension> dimensions, std::vector<std::size_t> states,
              const std::vector<std::int64_t>& gaps);

  std::vector<GridDimension> dimensions_;
  std::vector<std::size_t> states_;
  std::vector<std::int64_t> strides_;
  std::vector<std::int64_t> row_strides_;
  std::int64_t cells_ = 1;
  std::int64_t row_length_ = 1;
  std::size_t across_ = 0;
};

[[nodiscard]] UniformGrid make_grid(const SystemSpec& spec);

}  // namespace coordreq
