#include "answers/row_cut.hpp"

#include <algorithm>

#include "engine/row_box.hpp"
#include "expression/evaluate.hpp"
#include "ranks/cut_rows.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Bins of rows for each rank; rows are cut between bins, so that shares differ by a hundredth or so.
constexpr std::int64_t kBinsOfRank = 64;
/// Rows of a bin that are looked at.
constexpr std::int64_t kLooksAtBin = 8;
/// If a rank has at least so many units, no unit is cut: equal units are found among whole ones alone.
constexpr std::int64_t kUnitsOfRank = 8;

std::int64_t bin_rows_of(std::int64_t rows, std::int64_t unit, int ranks) {
  const std::int64_t most = kBinsOfRank * ranks;
  const std::int64_t bin = (rows + most - 1) / most;
  return unit * kUnitsOfRank * ranks <= rows ? (bin + unit - 1) / unit * unit : bin;
}

/// Finds rows in which S has no cell, by intervals around the centres of a row; may miss some.
class SafeRows {
 public:
  SafeRows(const ProblemSpec& spec, const UniformGrid& grid)
      : grid_(grid), safe_(spec.safe), box_(spec.slot_count()) {
    for (std::size_t i = grid.across(); i < grid.size(); ++i)
      box_[grid.state(i)] = enclose(grid[i].point(0), grid[i].point(grid[i].count - 1));
  }

  [[nodiscard]] bool may_hold(std::int64_t row) {
    const RowPosition position(grid_, row);
    for (std::size_t i = 0; i < grid_.across(); ++i)
      box_[grid_.state(i)] = enclose(grid_[i].point(position.index[i]));
    return safe_.condition(box_) != Truth::no;
  }

 private:
  const UniformGrid& grid_;
  Evaluator<Interval> safe_;
  std::vector<Interval> box_;  ///< [slot]
};

/// Rows of the smallest unit that an engine may choose (RowEngine::outer()); larger units consist of such
/// units.
std::int64_t least_unit(const Model& model) {
  const UniformGrid& grid = model.grid();
  const std::vector<TableShape>& shapes = model.arranged_shapes();
  std::size_t closed = 0, depends_up_to = 0;
  for (std::size_t i = 0; i < grid.across(); ++i) {
    for (const std::int32_t j : shapes[i].states)
      depends_up_to = std::max(depends_up_to, static_cast<std::size_t>(j));
    if (depends_up_to <= i) closed = i + 1;
  }
  return closed == 0 ? grid.rows() : grid.row_stride(closed - 1);
}

/// @param unit_rows rows of a unit, which is not cut if there are enough units
std::vector<std::int64_t> cut_by_safe_rows(const ProblemSpec& spec, const UniformGrid& grid,
                                           std::int64_t unit_rows, int ranks) {
  const std::int64_t rows = grid.rows(), bin = bin_rows_of(rows, unit_rows, ranks);
  SafeRows safe_rows(spec, grid);
  std::vector<std::int64_t> weights;
  for (std::int64_t begin = 0; begin < rows; begin += bin) {
    const std::int64_t bin_rows = std::min(bin, rows - begin), looks = std::min(bin_rows, kLooksAtBin);
    std::int64_t safe = 0;
    for (std::int64_t look = 0; look < looks; ++look) {
      const std::int64_t row = (2 * look + 1) * bin_rows / (2 * looks) + begin;
      safe += safe_rows.may_hold(row) ? 1 : 0;
    }
    weights.push_back(safe * bin_rows / looks);
  }
  return cut_rows(weights, bin, rows, ranks);
}

}  // namespace

bool is_cut_before_tables(const Model& model) {
  return std::ranges::any_of(
      model.shapes(), [&](const TableShape& shape) { return shape.is_by_cells(model.shapes().size()); });
}

std::vector<std::int64_t> cut_into_shares(const Model& model, const RowEngine* engine, int ranks) {
  return is_cut_before_tables(model)
             ? cut_by_safe_rows(model.spec(), model.grid(), least_unit(model), ranks)
             : cut_by_safe_rows(model.spec(), engine->grid(), engine->unit_rows(), ranks);
}

}  // namespace coordreq
