#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/cell_block.hpp"
#include "model/uniform_grid.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The cells of a table: slices of it, and projections.
struct TableSelection {
  struct Slice {
    std::size_t dimension = 0;
    std::int64_t index = 0;
  };
  struct Projection {
    std::size_t dimension = 0;
    bool largest = false;  ///< else the smallest value along the dimension
  };
  std::vector<Slice> slices;
  std::vector<Projection> projections;   ///< carried out in this order
  std::optional<std::size_t> partition;  ///< none: all
};

/// A column of numbers by cell: of each field that is displayed as one, and for each entry where it has a
/// leading axis.
struct CellColumn {
  std::string name;
  const Field* field = nullptr;
  std::optional<std::size_t> leading;  ///< position along the axis before those of the cells
  /// Rank of a value where numbers are compared: codes of what is no number of steps have theirs.
  [[nodiscard]] double rank(std::int32_t value) const;
  /// A value as a number: infinity for kUnbounded, a probability for its bits.
  [[nodiscard]] double number(std::int32_t value) const;
};
[[nodiscard]] std::vector<CellColumn> cell_columns(const ResultsReader& results,
                                                   std::optional<std::size_t> partition);

/// The columns of the cells that a selection leaves, in the row-major order of the dimensions that
/// remain.
///
/// Blocks of about a million cells, fewer if memory is limited, are read at a time. Without projections each
/// is handed on at once; with projections memory is 4 bytes for each column and each cell that is left after
/// the first projections of one kind.
class CellTable {
 public:
  /// Memory of reading the rows of a table, in bytes.
  [[nodiscard]] static double bytes(const ResultsReader& results, const TableSelection& selection);

  /// @pre every dimension at most once in the selection. @pre unchecked: `results` outlives this object
  CellTable(const ResultsReader& results, TableSelection selection);

  [[nodiscard]] const std::vector<CellColumn>& columns() const { return columns_; }
  /// Dimensions that are not projected, ascending; a sliced one has one index.
  [[nodiscard]] const std::vector<std::size_t>& dimensions() const { return kept_; }

  /// Called for one row after the other: grid indices of `dimensions()`, and one value a column.
  using Row =
      std::function<void(const std::vector<std::int64_t>& index, const std::vector<std::int32_t>& values)>;
  void for_each_row(const Row& row) const;

 private:
  using Values = std::vector<std::vector<std::int32_t>>;  // by column

  void for_each_block(CellBlock block, std::size_t dimension,
                      const std::function<void(const CellBlock&)>& visit) const;
  [[nodiscard]] Values read(const CellBlock& block) const;
  void visit_rows(const CellBlock& block, const Values& values, const Row& row) const;
  [[nodiscard]] Values projected(CellBlock& block) const;
  void merge(std::size_t column, std::int32_t value, bool largest, std::int32_t& into, bool first) const;

  const ResultsReader& results_;
  TableSelection selection_;
  std::vector<CellColumn> columns_;
  std::vector<std::size_t> kept_;
  CellBlock block_;  ///< after slices
  std::int64_t block_cells_;
};

/// Reads "v2=2.8" (the cells in which v2 has this value) and "p2:min" or "p2:max", one or several with commas
/// between. @throws UsageError naming what is unknown, repeated or outside of the domain
[[nodiscard]] TableSelection parse_selection(const std::vector<std::string>& slices,
                                             const std::vector<std::string>& projections,
                                             const UniformGrid& grid);

}  // namespace coordreq
