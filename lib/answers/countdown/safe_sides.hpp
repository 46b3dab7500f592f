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
/// these; else when a row is queried.
///
/// Safe to share between threads but during make_ready().
class SafeSides {
 public:
  /// @pre unchecked: `context` outlives this object
  explicit SafeSides(const AnalysisContext& context);

  /// Whether find_ahead() may be called.
  [[nodiscard]] bool knows_ahead() const;
  /// result = of these cells of a row those that are *ahead*: every joint input, in C(x) or not, leads out
  /// through a side or to a cell that is further outward, by the sum of the indices in the dimensions of the
  /// sides. Some such cells may be missing.
  void find_ahead(const RowPosition& position, ConstRow cells, MutableRow result) const;
  /// Whether the outward joint input leads out or to a cell that is further outward, from all of these cells.
  [[nodiscard]] bool outward_leads_ahead(const RowPosition& position, ConstRow cells) const;

  /// Gets ready for the questions below.
  void make_ready(ThreadTeam& team);

  [[nodiscard]] std::size_t size() const { return sides_.size(); }
  /// Number of choices of the inputs on which a side depends.
  [[nodiscard]] std::size_t input_choices(std::size_t side) const {
    return sides_[side].input_choices.size();
  }
  /// Calls `visit(u)` for the joint inputs that such a choice is part of, while it returns true.
  template <class Visit>
  void for_each_input(std::size_t side, std::size_t input_choice, const Visit& visit) const {
    for (const std::int64_t rest : sides_[side].rests) {
      if (!visit(sides_[side].input_choices[input_choice] + rest)) return;
    }
  }
  [[nodiscard]] std::int64_t outward() const { return outward_; }
  /// Whether leaving in a dimension is `safe` below, and not above.
  [[nodiscard]] bool is_below(std::size_t dimension) const;

  /// result = the cells of a row, among the given ones, from which some joint input, in C(x) or not, leads
  /// out through a side.
  void find_near(const RowPosition& position, ConstRow cells, MutableRow result) const;
  /// The same of the outward joint input.
  void find_leaving_outward(const RowPosition& position, ConstRow cells, MutableRow result) const;
  /// The same of one side, and of one choice of its inputs.
  void find_leaving(std::size_t side, std::size_t input_choice, const RowPosition& position, ConstRow cells,
                    MutableRow result) const;

 private:
  struct Side {
    std::size_t dimension = 0;
    std::vector<std::int32_t> inputs = {};  ///< on which it depends
    std::vector<std::int64_t> input_choices =
        {};                                ///< a joint input for each choice of these, the last one fastest
    std::vector<std::int64_t> rests = {};  ///< what each choice of all other inputs adds to its number
    /// If its table is a sum what choices of inputs add to positions: [choice of the inputs of terms][base,
    /// then each term], and [choice of all other inputs] of the base.
    std::vector<std::int64_t> of_terms = {}, of_base = {};
    bool is_along = false;           ///< it depends on a dimension along rows; else a row is near it or not
    std::size_t words = 1;           ///< of a row in `near` and `outward`
    std::vector<Word> near = {};     ///< [choice(), word]; empty: found when a row is queried
    std::vector<Word> outward = {};  ///< likewise, the cells from which outward_ leaves
    /// [choice(), word] the cells from which every joint input leads at least one index outward in the
    /// dimension, and those from which some leads back; empty: not known.
    std::vector<Word> ahead = {}, back = {};
  };

  void add(std::size_t i);
  void choose_outward();
  void add_choices(Side& side) const;
  void fill(Side& side, ThreadTeam& team) const;
  void fill_ahead(Side& side) const;
  /// Number of choices of states across rows on which a side depends; 0 if to look at each would take more
  /// than a look for each cell.
  [[nodiscard]] std::int64_t choices(const Side& side) const;
  /// The first cell of a row that has a choice of states across rows.
  [[nodiscard]] std::int64_t first_cell(const Side& side, std::int64_t choice) const;
  /// Sets the bits of the row for which `test(cell)` is true. @param first cell of the row
  template <class Test>
  void fill_row(const Side& side, std::int64_t first, Word* row, const Test& test) const;
  /// Adds what a row has in `near` or `outward`.
  void add_row(const Side& side, const std::vector<Word>& kept, const RowPosition& position,
               MutableRow result) const;
  /// The number of the choice of states across rows on which the side depends.
  [[nodiscard]] std::size_t choice(const Side& side, const RowPosition& position) const;
  [[nodiscard]] bool is_near(const Side& side, std::int64_t x) const;
  [[nodiscard]] bool leaves(const Side& side, std::int64_t x, std::int64_t u) const {
    return passes(side.dimension, abstraction_.raw(side.dimension, x, u));
  }
  /// The least range around those of all joint inputs, of a side whose table is a sum.
  [[nodiscard]] IndexRange around_sums(const Side& side, std::int64_t x) const;
  /// By how many indices the end of each range, of any joint input, is further outward than a cell, at least.
  /// @pre its table is no sum
  [[nodiscard]] std::int64_t least_gain(const Side& side, std::int64_t x) const;
  /// How far outward the end of a range is from a cell.
  [[nodiscard]] std::int64_t gain(const Side& side, std::int64_t x, IndexRange range) const {
    const std::int64_t index = grid_.index(x, side.dimension);
    return is_below(side.dimension) ? index - range.first : range.last - index;
  }
  /// Whether a raw range of a dimension goes beyond a `safe` side of it.
  [[nodiscard]] bool passes(std::size_t dimension, IndexRange raw) const;

  const Abstraction& abstraction_;
  const RowEngine& engine_;
  const UniformGrid& grid_;
  std::vector<Side> sides_;
  std::int64_t outward_ = 0;
};

/// Takes cells out from which the outward joint input leads to a cell that is out: in rounds, each of which
/// sees what the one before has taken out, until a round takes out few. What is left may still lead out.
///
/// Why: most runs that leave through a safe side do so by going on outward. Of the box that a row then leads
/// to one row is looked at, and in that one cell for each, by words. Nothing is done where rows are added up
/// or run along several dimensions.
/// @param all cells that may be out, in the rows held
/// @param outward those in whose C(x) the outward joint input is, in the rows owned
/// @param left of `all` the cells that are not out; in ghost rows these may be too many
/// @returns how many cells of the rows owned were taken out; the same for any number of threads
std::int64_t take_out_runs(const AnalysisContext& context, const SafeSides& sides, const CellSet& all,
                           const CellSet& outward, ThreadTeam& team, CellSet& left);

}  // namespace coordreq
