#pragma once

#include <cstdint>
#include <vector>

#include "answers/analysis_context.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/row_operations.hpp"

namespace coordreq {

/// The `safe` sides of a problem: for a row of cells at once, from which of them some joint input leads out
/// through one. Most cells are near none.
///
/// Where a side depends on few of the states across rows, that is found once for all rows that agree in
/// these; else when a row is asked about.
///
/// Immutable once built, so safe to share between threads.
class SafeSides {
 public:
  /// @param cells that will be asked about, in the rows owned; @pre unchecked: `context` outlives this object
  SafeSides(const AnalysisContext& context, const CellSet& cells, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const { return sides_.size(); }
  /// Number of choices of the inputs on which a side depends.
  [[nodiscard]] std::size_t parts(std::size_t side) const { return sides_[side].parts.size(); }
  /// The choice that is part of a joint input.
  [[nodiscard]] std::size_t part_of(std::size_t side, std::int64_t u) const;

  /// result = the cells of a row, among the given ones, from which some joint input, in C(x) or not, leads
  /// out through a side.
  void find_near(const RowPlace& place, ConstRow cells, MutableRow result) const;
  /// The same of one side, and of one choice of its inputs.
  void find_leaving(std::size_t side, std::size_t part, const RowPlace& place, ConstRow cells,
                    MutableRow result) const;

 private:
  struct Side {
    std::size_t dimension = 0;
    std::vector<std::int32_t> inputs = {};  ///< on which it depends
    std::vector<std::int64_t> parts = {};   ///< a joint input for each choice of these, the last one fastest
    bool is_along = false;        ///< it depends on a dimension along rows; else a row is near it or not
    std::size_t words = 1;        ///< of a row in `near`
    std::vector<Word> near = {};  ///< [choice(), word]; empty: found when a row is asked about
  };

  void add(std::size_t i);
  void fill(Side& side, const CellSet& cells, ThreadTeam& team) const;
  void fill_row(const Side& side, std::int64_t row, Word* near) const;
  /// The number of the choice of states across rows on which the side depends.
  [[nodiscard]] std::size_t choice(const Side& side, const RowPlace& place) const;
  [[nodiscard]] bool is_near(const Side& side, std::int64_t x) const;
  /// Whether a raw range of a dimension goes beyond a `safe` side of it.
  [[nodiscard]] bool passes(std::size_t dimension, IndexRange raw) const;

  const Abstraction& abstraction_;
  const RowEngine& engine_;
  const UniformGrid& grid_;
  std::vector<Side> sides_;
};

}  // namespace coordreq
