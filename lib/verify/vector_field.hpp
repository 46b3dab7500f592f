#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "spec/spec_types.hpp"
#include "verify/budget.hpp"
#include "verify/expression_series.hpp"
#include "verify/sampled_map.hpp"

namespace coordreq {

/// A value for each variable of a spec, by slot.
using ArbBox = std::vector<Arb>;

/// The range of a state that goes round. At its end equations may jump.
struct Seam {
  std::size_t state = 0;  ///< its place among the moving ones
  Rational lower;
  Rational upper;
};

/// Several equations of a spec as functions of what varies: some states x, then disturbances w. Encloses
/// their ranges, slopes and, as right-hand sides of x' = f(x, w), Taylor series in time. Scratch inside: one
/// object a thread.
class SeriesField {
 public:
  /// @param equations indices of states; for taylor() those of all of x
  /// @pre unchecked: `spec` outlives this object.
  SeriesField(const SystemSpec& spec, const Influences& influences,
              const std::vector<std::size_t>& equations);

  [[nodiscard]] std::size_t size() const { return equations_.size(); }
  /// Done so far.
  [[nodiscard]] Work work() const { return std::min(work_, end_); }
  /// Counts operations of others that go with what it does.
  void add_work(Work of_others) { work_ += of_others; }
  /// From now on no more than so much is done: then nothing has a value, slopes, or a series.
  void limit_work(Work most) {
    work_ = work();
    end_ = most < kNoEnd - work_ ? work_ + most : kNoEnd;
  }
  [[nodiscard]] bool is_spent() const { return work_ > end_; }
  /// Slots of x, then of w.
  [[nodiscard]] const std::vector<std::uint32_t>& variables() const { return variables_; }

  /// From now on equations see what lies beyond these seams from the other side, in all of what follows;
  /// where a box meets a seam they jump. None: they go on as if there was no seam.
  void mind(std::vector<Seam> seams) { seams_ = std::move(seams); }

  /// The range of one equation over a box; not finite where it is not defined or has no bound.
  [[nodiscard]] Arb value(std::size_t equation, const ArbBox& box);
  /// Slopes of one equation by all variables, over the box. @returns nothing where it jumps, or they have no
  /// bound
  [[nodiscard]] std::optional<std::vector<Arb>> slopes(std::size_t equation, const ArbBox& box);
  /// A row of slopes() an equation.
  [[nodiscard]] std::optional<ArbMatrix> jacobian(const ArbBox& box);
  /// Series in time of all solutions that begin in the box, w constant: one an equation, `length` terms.
  /// @returns nothing if some equation is not analytic or not bounded over the box
  [[nodiscard]] std::optional<std::vector<ArbSeries>> taylor(const ArbBox& box, slong length);

 private:
  void put(const ArbBox& box);
  void put(std::size_t equation, const ArbBox& box);
  [[nodiscard]] std::vector<ArbBox> seen(const ArbBox& box, std::optional<std::size_t> equation) const;
  [[nodiscard]] const ArbBox* seen_whole(const ArbBox& box, std::optional<std::size_t> equation);
  const ArbSeries& run(std::size_t equation, slong length);
  const ArbSeries& extend(std::size_t equation, slong length);

  std::vector<ExpressionSeries> equations_;
  std::vector<std::vector<bool>> mentions_;            ///< [equation][variable]
  std::vector<std::vector<std::uint32_t>> mentioned_;  ///< [equation]: slots
  std::vector<std::uint32_t> variables_;
  std::vector<Seam> seams_;
  std::vector<ArbSeries> slots_;
  ArbBox seen_;  ///< a box as it is seen at a seam
  static constexpr Work kNoEnd = std::numeric_limits<Work>::max();
  Work work_ = 0;
  Work end_ = kNoEnd;
};

}  // namespace coordreq
