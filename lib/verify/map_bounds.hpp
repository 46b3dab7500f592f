#pragma once

#include <optional>
#include <vector>

#include "expression/evaluate.hpp"
#include "expression/program.hpp"
#include "verify/sloped.hpp"

namespace coordreq {

/// The range of an expression over a box: variables in which it is proven to be monotone at the ends where
/// the extreme is, natural evaluation of the rest, halved again and again where it is not monotone.
///
/// Over-approximates. Not thread-safe: one object a thread.
class MapBounds {
 public:
  /// @param variables slots that may be more than points
  /// REQUIRES: `equation` outlives this object.
  MapBounds(const Program& equation, std::vector<std::uint32_t> variables);

  /// @param halvings of the box in variables without sign, at most
  /// @returns nothing where the expression is not defined or has no bound
  [[nodiscard]] std::optional<Interval> over(const std::vector<Interval>& slots, int halvings);
  /// True if the derivative by `slot` is 1 all over the box.
  [[nodiscard]] bool follows(const std::vector<Interval>& slots, std::uint32_t slot);

 private:
  using Box = std::vector<Interval>;

  [[nodiscard]] const Sloped<Interval>& evaluate(const Box& box);
  [[nodiscard]] Interval end_of(Box box, bool upper, int rounds);
  [[nodiscard]] std::optional<Interval> bounds(Box& box, int halvings_left);

  std::vector<std::uint32_t> variables_;
  Evaluator<Interval> natural_;
  Evaluator<Sloped<Interval>> sloped_;
};

}  // namespace coordreq
