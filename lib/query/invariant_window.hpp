#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grid/cell_block.hpp"
#include "grid/outside.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The part of K that a question needs, read from the file; answers whether boxes lie in it, each in a time
/// that does not depend on its size, from prefix sums.
class InvariantWindow {
 public:
  /// REQUIRES: `results` outlives this object.
  explicit InvariantWindow(const ResultsReader& results) : results_(results) {}

  /// Reads the box unless it is there already. Ranges as ResolvedRange::inside has them: an index beyond the
  /// last one of a periodic dimension wraps.
  void cover(std::span<const IndexRange> box);
  /// Whether all cells of the box are in K. REQUIRES: a box that cover() was called for, or part of one.
  [[nodiscard]] bool contains(std::span<const IndexRange> box) const;

 private:
  void add_up();
  [[nodiscard]] std::int64_t members(std::span<const IndexRange> box, std::size_t i,
                                     std::int64_t corner) const;

  const ResultsReader& results_;
  CellBlock block_;
  std::vector<std::int64_t> stride_;  ///< of `sums_`
  /// Members of K among the cells of the block before an index in every dimension; one entry more a
  /// dimension.
  std::vector<std::int32_t> sums_;
};

}  // namespace coordreq
