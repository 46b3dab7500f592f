#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/input_space.hpp"
#include "model/odometer.hpp"
#include "model/uniform_grid.hpp"
#include "reach/state_enclosure.hpp"

namespace coordreq {

/// All choices of one index for each of some states and inputs, with the boxes of values that they mean; a
/// cell on the seam of a periodic state has two.
class BoxChoices {
 public:
  /// @param count so many indices, from `first` on
  void add_state(const GridDimension& dimension, std::uint32_t slot, std::int64_t count,
                 std::int64_t first = 0);
  void add_input(const InputSpace::Dimension& input, std::uint32_t slot);

  /// Counts through the indices, in the order in which they were added.
  [[nodiscard]] Odometer odometer() const;

  /// Puts the boxes into `enclosure` and calls `visit(piece)`, once for every choice of pieces; `piece`
  /// numbers that of each variable as in pieces().
  template <class Visit>
  void for_each_piece(const std::vector<std::int64_t>& choice, StateEnclosure& enclosure,
                      const Visit& visit) const {
    std::vector<std::int64_t> counts;
    for (std::size_t v = 0; v < choice.size(); ++v) {
      counts.push_back(static_cast<std::int64_t>(boxes(choice, v).size()));
    }
    Odometer piece(counts);
    do {
      for (std::size_t v = 0; v < choice.size(); ++v) {
        enclosure.set(variables_[v].slot, boxes(choice, v)[static_cast<std::size_t>(piece.indices()[v])]);
      }
      visit(piece.indices());
    } while (piece.advance());
  }

  /// " near x = 1, u = 0.5", for messages; empty without variables.
  [[nodiscard]] std::string location(const std::vector<std::int64_t>& choice) const;

 private:
  struct Variable {
    std::uint32_t slot = 0;
    std::string name;
    std::vector<Rational> points;               ///< [index], for messages
    std::vector<std::vector<Interval>> pieces;  ///< [index][piece]
  };

  [[nodiscard]] const std::vector<Interval>& boxes(const std::vector<std::int64_t>& choice,
                                                   std::size_t v) const {
    return variables_[v].pieces[static_cast<std::size_t>(choice[v])];
  }

  std::vector<Variable> variables_;
};

}  // namespace coordreq
