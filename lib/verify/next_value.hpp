#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "verify/vector_field.hpp"

namespace coordreq {

/// A closed interval by its ends, which are all but points.
struct ArbSpan {
  Arb lower;
  Arb upper;
  [[nodiscard]] Arb all() const { return hull(lower, upper); }
  [[nodiscard]] Arb middle() const { return all().middle(); }
  [[nodiscard]] double width() const { return upper.approximately() - lower.approximately(); }
};
/// One for each variable of a spec, by slot.
using SpanBox = std::vector<ArbSpan>;
[[nodiscard]] ArbBox all_of(const SpanBox& box);

/// How hard to try.
struct Effort {
  int steps = 2;            ///< that a period is cut into
  double tolerance = 1e-3;  ///< of a solution, in cells
};

/// Bounds of the least or the greatest value that a state can have next.
struct Extreme {
  Arb bound;                    ///< a point: no value is beyond it
  std::optional<Arb> attained;  ///< a value that is taken, by `start`
  ArbBox start;                 ///< where from; of disturbances that change their value at the beginning
  std::vector<double> excess;   ///< what each variable adds to the bound beyond `attained`, roughly
};
struct Extremes {
  Extreme least;
  Extreme greatest;
};

/// Encloses the next values of states from boxes of present ones. Scratch inside: one object a thread.
class NextValue {
 public:
  NextValue() = default;
  NextValue(const NextValue&) = delete;
  NextValue& operator=(const NextValue&) = delete;
  virtual ~NextValue() = default;

  /// @param box constant but for states and disturbances
  /// @returns false where no bound is found
  [[nodiscard]] virtual bool enclose(const SpanBox& box, const Effort& effort) = 0;
  /// The extremes of the value over the box enclosed last.
  /// @param value which of several
  /// @param enough says whether a range that is found first, with less effort, will do
  using Enough = std::function<bool(const Arb& lower, const Arb& upper)>;
  [[nodiscard]] virtual Extremes extremes(std::size_t value, const Enough& enough) = 0;
  /// Whether values from the box enclosed last are nowhere farther than those from its faces.
  [[nodiscard]] virtual bool has_extremes_on_faces() const { return false; }
  /// Slots of what may be cut into pieces: for each piece a bound holds by itself.
  [[nodiscard]] virtual const std::vector<std::uint32_t>& divisible() const = 0;
  /// Done so far: the same for the same questions, whatever is remembered.
  [[nodiscard]] virtual Work work() const = 0;
  /// From now on no more than so much is done; what is begun then ends without a bound.
  virtual void limit_work(Work most) = 0;
  /// Whether that ended the last query.
  [[nodiscard]] virtual bool is_spent() const = 0;
};

/// The place that is taken for the extreme along a variable, and the excess of other places.
struct EndChoice {
  Arb point;   ///< a point of the span
  Arb excess;  ///< not negative: how far values for other places are beyond
};
/// @param slope of the value by the variable, all over the span
[[nodiscard]] EndChoice choose_for_extreme(const ArbSpan& span, const Arb& slope, bool greatest);

}  // namespace coordreq
