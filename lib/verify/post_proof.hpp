#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/uniform_grid.hpp"
#include "verify/budget.hpp"
#include "verify/next_value.hpp"
#include "verify/post_table.hpp"

namespace coordreq {

/// What could be proven about a claimed range of cells.
enum class PostVerdict : std::uint8_t {
  holds,  ///< it has every value that can come next
  wrong,  ///< some value that does come next is not in it
  open,   ///< neither
};
struct PostProof {
  PostVerdict verdict = PostVerdict::holds;
  std::string why;  ///< where it ends, and from where; or why nothing is proven
};

/// How far to go for one range: pieces of its cell, and the work for each of them.
struct PostEffort {
  int most_boxes = 1;
  Effort effort;
};

/// Proves claimed ranges of the next value of one state. One object a thread.
class PostProver {
 public:
  /// @param shifts the next value is the present one and something that does not depend on it: claims are
  /// about
  ///   the cell with index 0
  /// REQUIRES: `spec` and `target` outlive this object.
  PostProver(const ProblemSpec& spec, const GridDimension& target, std::unique_ptr<NextValue> next,
             bool shifts);

  /// @param box where the present state can be
  [[nodiscard]] PostProof prove(const SpanBox& box, IndexRange claimed, const PostEffort& effort,
                                Budget::Clock::time_point end);

 private:
  [[nodiscard]] PostProof prove_piece(const SpanBox& box, const Effort& effort,
                                      std::optional<std::uint32_t>& cut);
  [[nodiscard]] bool is_claimed(const Arb& lower, const Arb& upper) const;
  [[nodiscard]] IndexRange cells_of(const Arb& lower, const Arb& upper, bool closed) const;
  [[nodiscard]] std::optional<std::string> witness(const Extreme& extreme) const;
  [[nodiscard]] bool misses(const Rational& lower, const Rational& upper) const;
  [[nodiscard]] std::optional<std::uint32_t> widest(const SpanBox& box, const Extremes& extremes) const;
  [[nodiscard]] std::string proven_text(const Extremes& extremes) const;

  const ProblemSpec& spec_;
  const GridDimension& target_;
  std::unique_ptr<NextValue> next_;
  bool shifts_;
  IndexRange claimed_;
};

/// The next value of a state, of a map or a flow, whichever the spec has.
[[nodiscard]] std::unique_ptr<NextValue> next_value_of(const ProblemSpec& spec, const Influences& influences,
                                                       std::size_t state, const GridDimension& target);

}  // namespace coordreq
