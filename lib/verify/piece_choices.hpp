#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "expression/program.hpp"
#include "model/odometer.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"
#include "verify/next_value.hpp"
#include "verify/reference_posts.hpp"

namespace coordreq {

/// Whether an equation jumps where a periodic state passes its seam: it uses the state other than within sin,
/// cos and tan of c x + (what does not depend on x), where c times the period of x is whole periods of these,
/// but for 1e-9, as pi is a rounded constant.
[[nodiscard]] bool jumps_at_seam(const Program& equation, std::uint32_t slot, const Rational& period);

[[nodiscard]] inline ArbSpan span_of(const Rational& lower, const Rational& upper) {
  return {Arb(lower), Arb(upper)};
}

/// The periodic ones of the moving states at whose seams, in continuous time, some equation of these jumps
/// (see jumps_at_seam()).
[[nodiscard]] std::vector<std::size_t> seams_that_jump(const SystemSpec& spec, const Influences& influences);

/// True if a `stop` limit holds one of the moving states.
[[nodiscard]] bool has_stops(const SystemSpec& spec, const Influences& influences);

/// In continuous time: x(t) - x(0) of the state does not depend on x(0): no equation mentions the
/// state, and no limit stops it.
[[nodiscard]] bool flows_alike(const SystemSpec& spec, const Influences& influences, std::size_t state);

/// All choices of one index for each state and input that a table ranges over, with their boxes. Immutable.
class PieceChoices {
 public:
  /// @param left_out a state that is not chosen: its entries follow from those of index 0
  PieceChoices(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
               const PostTable& table, std::optional<std::size_t> left_out);

  [[nodiscard]] const std::vector<std::int64_t>& counts() const { return counts_; }
  [[nodiscard]] std::int64_t size() const { return size_; }
  /// Row-major numbers of the choices that some of the cells make, with all inputs, ascending; all if `cells`
  /// is empty.
  [[nodiscard]] std::vector<std::int64_t> made_by(const std::vector<std::int64_t>& cells) const;
  /// Position of a choice in the table.
  [[nodiscard]] std::int64_t position(const Odometer& choice) const;
  /// Among the variables. @pre `slot` is one of them
  [[nodiscard]] std::size_t variable(std::uint32_t slot) const;

  /// Calls `visit(piece)` for every choice of one box a variable, which it has put into `slots`, until it
  /// returns false: mostly one box, two on a seam.
  template <class Visit>
  bool for_each_piece(const Odometer& choice, SpanBox& slots, const Visit& visit) const {
    std::vector<std::int64_t> pieces;
    for (std::size_t v = 0; v < variables_.size(); ++v)
      pieces.push_back(static_cast<std::int64_t>(boxes_of(choice, v).size()));
    Odometer piece(pieces);
    do {
      for (std::size_t v = 0; v < variables_.size(); ++v)
        slots[variables_[v].slot] = boxes_of(choice, v)[static_cast<std::size_t>(piece[v])];
      if (!visit(piece)) return false;
    } while (piece.advance());
    return true;
  }

 private:
  struct Variable {
    std::uint32_t slot = 0;
    std::int64_t stride = 0;
    std::vector<std::vector<ArbSpan>> boxes;  ///< [index][piece]
  };

  void add(std::uint32_t slot, std::int64_t stride, std::vector<std::vector<ArbSpan>> boxes);
  [[nodiscard]] const std::vector<ArbSpan>& boxes_of(const Odometer& choice, std::size_t v) const {
    return variables_[v].boxes[static_cast<std::size_t>(choice[v])];
  }

  const UniformGrid& grid_;
  std::vector<std::size_t> states_;  ///< of the first variables
  std::vector<Variable> variables_;
  std::vector<std::int64_t> counts_;
  std::int64_t size_ = 1;
};

}  // namespace coordreq
