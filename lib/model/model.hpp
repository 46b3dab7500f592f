#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/input_space.hpp"
#include "model/table_shape.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The states in the order in which the engine works best.
struct StateOrder {
  std::vector<std::size_t> states;    ///< [dimension] the state
  std::size_t most_along = SIZE_MAX;  ///< rows run along no more than so many of the last ones
};

/// A problem made ready once and handed on: what its states depend on, the grid in the order in which the
/// engine works best, the joint inputs. The spec stays as it was read; whoever meets a dimension of the grid
/// asks it which state it is.
///
/// Immutable, so safe to share between threads.
class Model {
 public:
  /// @param shapes of the tables, one a state: see table_shapes()
  /// @pre unchecked: `spec` outlives this object.
  Model(const ProblemSpec& spec, std::vector<TableShape> shapes);

  [[nodiscard]] const ProblemSpec& spec() const { return *spec_; }
  /// By state of the spec.
  [[nodiscard]] const std::vector<TableShape>& shapes() const { return shapes_; }
  /// [dimension] its state; choose_order().
  [[nodiscard]] const std::vector<std::size_t>& order() const { return order_.states; }
  /// Rows may run along so many of the last dimensions, or none but the last.
  [[nodiscard]] std::size_t most_along() const { return most_along_; }
  /// By dimension of the grid, `states` too.
  [[nodiscard]] const std::vector<TableShape>& arranged_shapes() const { return arranged_shapes_; }
  /// In that order, in rows along the last dimension.
  [[nodiscard]] const UniformGrid& grid() const { return grid_; }
  [[nodiscard]] const InputSpace& inputs() const { return inputs_; }

  /// The order is the one of sums: then their tables are not cut into rows.
  [[nodiscard]] bool keeps_sums() const { return keeps_sums_; }

 private:
  const ProblemSpec* spec_;
  std::vector<TableShape> shapes_;
  StateOrder order_;
  std::size_t most_along_ = 1;
  bool keeps_sums_ = false;
  std::vector<TableShape> arranged_shapes_;
  UniformGrid grid_;
  InputSpace inputs_;
};

/// The order of the states:
///
/// 1. Rows run along a state that moves by an offset that does not depend on itself, if there is one: the
/// longest, and of equals the last. Then a whole row is one window.
/// 2. What moves with that state comes last, and before it what moves independently, so that minima over the
/// leading dimensions are shared (RowEngine). States that move together stand together.
/// 3. But where motion is coupled and led by what moves independently (SumRows), the leaders come first and
/// the sums behind them, the longest along the rows.
/// 4. But where rows along several states are far more often equal if they run along others, those come last:
/// find_similar_rows().
/// The order of the spec is kept where nothing is gained.
[[nodiscard]] StateOrder choose_order(const ProblemSpec& spec, const std::vector<TableShape>& shapes);

}  // namespace coordreq
