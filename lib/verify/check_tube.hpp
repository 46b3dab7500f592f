#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "base/thread_team.hpp"
#include "model/input_space.hpp"
#include "spec/problem_spec.hpp"
#include "verify/post_table.hpp"
#include "verify/tally.hpp"

namespace coordreq {

/// Raw indices of the fewest cells, each closed and widened by the measurement error, that together cover
/// [lower, upper]. @pre lower <= upper
[[nodiscard]] IndexRange cells_covered(const GridDimension& dimension, const Rational& lower,
                                       const Rational& upper);

/// What the verifier knows of the cells that cover all states between the samples, from one piece of a cell.
struct OwnTube {
  IndexRange outer;  ///< these are enough
  IndexRange inner;  ///< these are needed
};

/// What became of the tubes of one state.
struct TubeFinding {
  Finding finding;
  bool exact = false;  ///< no tube could be smaller
};

/// Compares tubes of the analysis with the verifier's own: one that leaves out a cell that is needed is
/// wrong; one that does not hold all that is enough for the verifier is left open. Safe to use from several
/// threads.
class TubeTally {
 public:
  /// REQUIRES: `dimension` and `claimed` outlive this object.
  TubeTally(const GridDimension& dimension, const PostTable& claimed)
      : dimension_(dimension), claimed_(claimed), tally_("tubes " + dimension.name) {}

  /// True if the entry holds all that is enough.
  [[nodiscard]] bool is_enough(std::int64_t entry, std::int64_t by, const std::vector<OwnTube>& own) const;
  /// @param by how far up the own tubes have to be moved
  /// @param own one for each piece of the cell
  void add(std::int64_t entry, std::int64_t by, const std::vector<OwnTube>& own);
  /// The entry says that nothing is known, which blocks the pair: no tube need be computed.
  void add_unbounded() { tally_.add_checked(1); }
  [[nodiscard]] bool is_unbounded(std::int64_t entry) const;

  [[nodiscard]] TubeFinding finding(bool may_be_exact);

 private:
  [[nodiscard]] bool is_exact(IndexRange claimed, std::int64_t by, const std::vector<OwnTube>& own) const;

  const GridDimension& dimension_;
  const PostTable& claimed_;
  Tally tally_;
  std::atomic<bool> exact_{true};
};

/// Checks the tubes of a state whose flow is a polynomial in time, from corners of the cells: their extremes
/// in time in rational arithmetic.
/// @returns nothing if the flow is not of this kind for some inputs or parameters
[[nodiscard]] std::optional<TubeFinding> check_corner_tubes(const ProblemSpec& spec, const UniformGrid& grid,
                                                            const InputSpace& inputs, std::size_t state,
                                                            const PostTable& claimed, ThreadTeam& team);

/// Checks the tubes of any other state by bounds of its derivative over parts of the period and of its value
/// in between (TubeBounds); the parts get finer until the tube of the analysis holds what they enclose.
/// @returns nothing if there are no such bounds
[[nodiscard]] std::optional<TubeFinding> check_outward_tubes(const ProblemSpec& spec, const UniformGrid& grid,
                                                             const InputSpace& inputs, std::size_t state,
                                                             const PostTable& claimed, ThreadTeam& team);

}  // namespace coordreq
