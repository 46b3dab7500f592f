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
/// Of joint inputs one is *outward*: each input is at its end that leads further towards the sides, as seen
/// from a cell in the middle. From most cells near a side it leads out, so that it is looked at first.
///
/// Where a side depends on few of the states across rows, all that is found once for all rows that agree in
/// these; else when a row is asked about.
///
/// Immutable once built, so safe to share between threads.
class SafeSides {
 public:
  /// @pre unchecked: `context` outlives this object
  SafeSides(const AnalysisContext& context, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const { return sides_.size(); }
  /// Number of choices of the inputs on which a side depends.
  [[nodiscard]] std::size_t parts(std::size_t side) const { return sides_[side].parts.size(); }
  /// Calls `visit(u)` for the joint inputs that such a choice is part of, while it returns true.
  template <class Visit>
  void for_each_input(std::size_t side, std::size_t part, const Visit& visit) const {
    for (const std::int64_t rest : sides_[side].rests) {
      if (!visit(sides_[side].parts[part] + rest)) return;
    }
  }
  [[nodiscard]] std::int64_t outward() const { return outward_; }
  /// Whether leaving in a dimension is `safe` below, and not above.
  [[nodiscard]] bool is_below(std::size_t dimension) const;

  /// result = the cells of a row, among the given ones, from which some joint input, in C(x) or not, leads
  /// out through a side.
  void find_near(const RowPlace& place, ConstRow cells, MutableRow result) const;
  /// The same of the outward joint input.
  void find_leaving_outward(const RowPlace& place, ConstRow cells, MutableRow result) const;
  /// The same of one side, and of one choice of its inputs.
  void find_leaving(std::size_t side, std::size_t part, const RowPlace& place, ConstRow cells,
                    MutableRow result) const;

 private:
  struct Side {
    std::size_t dimension = 0;
    std::vector<std::int32_t> inputs = {};  ///< on which it depends
    std::vector<std::int64_t> parts = {};   ///< a joint input for each choice of these, the last one fastest
    std::vector<std::int64_t> rests = {};   ///< what each choice of all other inputs adds to its number
    bool is_along = false;           ///< it depends on a dimension along rows; else a row is near it or not
    std::size_t words = 1;           ///< of a row in `near` and `outward`
    std::vector<Word> near = {};     ///< [choice(), word]; empty: found when a row is asked about
    std::vector<Word> outward = {};  ///< likewise, the cells from which outward_ leaves
  };

  void add(std::size_t i);
  void choose_outward();
  void fill(Side& side, ThreadTeam& team) const;
  /// The first cell of a row that has a choice of states across rows.
  [[nodiscard]] std::int64_t first_cell(const Side& side, std::int64_t choice) const;
  /// Sets the bits of the row for which `test(cell)` is true. @param first cell of the row
  template <class Test>
  void fill_row(const Side& side, std::int64_t first, Word* row, const Test& test) const;
  /// Adds what a row has in `near` or `outward`.
  void add_row(const Side& side, const std::vector<Word>& kept, const RowPlace& place,
               MutableRow result) const;
  /// The number of the choice of states across rows on which the side depends.
  [[nodiscard]] std::size_t choice(const Side& side, const RowPlace& place) const;
  [[nodiscard]] bool is_near(const Side& side, std::int64_t x) const;
  [[nodiscard]] bool leaves(const Side& side, std::int64_t x, std::int64_t u) const {
    return passes(side.dimension, abstraction_.raw(side.dimension, x, u));
  }
  /// Whether a raw range of a dimension goes beyond a `safe` side of it.
  [[nodiscard]] bool passes(std::size_t dimension, IndexRange raw) const;

  const Abstraction& abstraction_;
  const RowEngine& engine_;
  const UniformGrid& grid_;
  std::vector<Side> sides_;
  std::int64_t outward_ = 0;
};

}  // namespace coordreq
