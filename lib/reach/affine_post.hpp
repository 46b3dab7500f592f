#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "model/odometer.hpp"
#include "model/pieces.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/index_form.hpp"

namespace coordreq {

/// The posts of whole cells, from a SampledRow.
struct AffinePost {
  const UniformGrid& grid;
  const std::vector<std::int32_t>& moving;  ///< states that the row has coefficients of
  std::size_t state;                        ///< whose value the row is
  bool shift = false;                       ///< the table is one of a shift
  /// Says which cells are filled, by the indices of the moving states; all if it is empty.
  std::function<bool(const std::vector<std::int64_t>&)> applies;

  /// Lower or upper end of the values from a cell, widened by the measurement errors of the states it starts
  /// from, plus `more`: in units of the grid step, the first grid point being 0, as a form of the cell's
  /// indices.
  [[nodiscard]] IndexForm end_form(const SampledRow& row, bool upper, const Rational& more) const;

  /// The values from one piece of each moving state.
  [[nodiscard]] Piece from_pieces(const SampledRow& row, const std::vector<Piece>& pieces) const;

  /// Number of indices of a state that are filled in: of its own state a shift has index 0 alone, since raw
  /// indices are relative.
  [[nodiscard]] std::int64_t filled_count(std::size_t source) const {
    return shift && source == state ? 1 : grid[source].count;
  }

  /// A shifted cell need not be cut at its seam: all of it goes round with it.
  [[nodiscard]] std::vector<Piece> pieces_of(std::size_t source, std::int64_t k) const {
    const GridDimension& dimension = grid[source];
    if (!shift || source != state) return pieces(dimension, k);
    const Rational reach = dimension.radius() + dimension.measurement_error;
    return {{dimension.point(k) - reach, dimension.point(k) + reach}};
  }

  /// Calls `visit` for every choice of one piece of each moving state of a cell.
  template <class Visit>
  void for_each_choice_of_pieces(const std::vector<std::int64_t>& cell, const Visit& visit) const {
    std::vector<std::vector<Piece>> pieces_of_states;
    std::vector<std::int64_t> counts;
    for (std::size_t j = 0; j < cell.size(); ++j) {
      pieces_of_states.push_back(pieces_of(static_cast<std::size_t>(moving[j]), cell[j]));
      counts.push_back(static_cast<std::int64_t>(pieces_of_states.back().size()));
    }
    Odometer choice(counts);
    std::vector<Piece> chosen(cell.size());
    do {
      for (std::size_t j = 0; j < cell.size(); ++j) {
        chosen[j] = pieces_of_states[j][static_cast<std::size_t>(choice.indices()[j])];
      }
      visit(chosen);
    } while (choice.advance());
  }

  /// Fills the entries of all cells from position `base` on, as far as they are held; `entry` is called with
  /// the indices of the moving states.
  template <class Entry>
  void fill(TransitionTable& table, std::int64_t base, const Entry& entry) const {
    for_each_entry(table, base, [&](IndexRange* held, const std::vector<std::int64_t>& cell) {
      if (held != nullptr) *held = entry(cell);
    });
  }
  /// Cuts entries at the ends of what `entry` returns for them, if it returns a range, and nothing where no
  /// cell would be left.
  template <class Entry>
  void narrow(TransitionTable& table, std::int64_t base, const Entry& entry) const {
    for_each_entry(table, base, [&](IndexRange* held, const std::vector<std::int64_t>& cell) {
      if (held == nullptr) return;
      const std::optional<IndexRange> range = entry(cell);
      if (!range || range->first > held->last || range->last < held->first) return;
      *held = {std::max(held->first, range->first), std::min(held->last, range->last)};
    });
  }
  /// As fill(), but `entry` is called for cells that are not held too.
  template <class Entry>
  void fill_and_check(TransitionTable& table, std::int64_t base, const Entry& entry) const {
    for_each_entry(table, base, [&](IndexRange* held, const std::vector<std::int64_t>& cell) {
      const IndexRange range = entry(cell);
      if (held != nullptr) *held = range;
    });
  }

 private:
  template <class Visit>
  void for_each_entry(TransitionTable& table, std::int64_t base, const Visit& visit) const {
    std::vector<std::int64_t> counts;
    for (const std::int32_t j : moving) counts.push_back(filled_count(static_cast<std::size_t>(j)));
    Odometer cell(counts);
    do {
      if (applies && !applies(cell.indices())) continue;
      std::int64_t position = base;
      for (std::size_t j = 0; j < counts.size(); ++j) {
        position += cell.indices()[j] * table.state_stride[static_cast<std::size_t>(moving[j])];
      }
      visit(table.held(position), cell.indices());
    } while (cell.advance());
  }
};

}  // namespace coordreq
