#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reach/validated_flow.hpp"

namespace coordreq {

/// The grid by which enclosures of one state's next value are measured: the cells that they meet.
struct EndCells {
  std::size_t state = 0;  ///< index into the ends of an enclosure
  double first = 0.0;     ///< the middle of a cell
  double step = 1.0;      ///< > 0
  double reach = 0.0;     ///< by which the value is widened before cells are counted
  bool placed = true;     ///< false: the cells are not known, as something is added to the value

  /// The number of cells that the hull of `a` and `b` meets and `b` does not; without places on the grid, the
  /// number of steps by which the hull is longer.
  [[nodiscard]] double more_cells(const Interval& a, const Interval& b) const;
};

/// Divides a box into subboxes where the enclosure of what it leads to meets more cells than need be. In each
/// round the subbox that decides over the end that lies farthest from all that is known to be reached is
/// halved; subboxes without an enclosure come first. What ends it is the number of subboxes that were
/// enclosed, each as many as its work is worth, so that the result is the same on every machine; and it is
/// given up where that number would be far too large.
///
/// Scratch memory for one thread.
class BoxDivision {
 public:
  /// The enclosure of what a subbox of the box leads to: `status`, `end`, `reached` and `loosest` count.
  using Enclose = std::function<const FlowEnclosure&(std::span<const Interval> box)>;
  struct Subbox {
    std::vector<Interval> box;
    FlowEnclosure found;
    int depth = 0;  ///< how often it was halved
  };

  /// @param targets what the result has to be tight for
  /// @param steps of the grid, one a dimension of the box: where nothing else tells the widest one is halved
  /// @param effort so many subboxes are enclosed at most, fewer where subboxes are costly
  BoxDivision(std::vector<EndCells> targets, std::vector<double> steps, std::int64_t effort);

  [[nodiscard]] std::int64_t effort() const { return effort_; }

  /// Whether the whole meets more cells than `limit` beyond those that are known to be reached, or is none.
  [[nodiscard]] bool is_loose(const FlowEnclosure& whole, double limit) const;

  /// No subboxes yet. @param reached from subboxes of the box that are not looked at again; empty: nothing is
  /// known
  void begin(std::vector<Interval> reached);
  /// Work that a subbox costs besides: what is more than usual takes the place of other subboxes.
  /// @param steps see ValidatedFlow::extra_steps()
  void charge(std::int64_t steps);
  /// A subbox with its enclosure.
  void add(std::vector<Interval> box, const FlowEnclosure& found, int depth = 0);
  /// Whether a subbox has no enclosure and nothing of the effort is left.
  [[nodiscard]] bool is_lost() const;
  /// Whether a subbox took long steps, and one has no enclosure or an end lies too far from what is reached.
  [[nodiscard]] bool may_gain_by_short_steps() const;
  /// Halves subboxes for as long as it pays. @returns whether all of them have enclosures
  bool refine(const Enclose& enclose);

  [[nodiscard]] const std::vector<Subbox>& subboxes() const { return subboxes_; }
  /// How many were enclosed, of all boxes so far.
  [[nodiscard]] std::int64_t enclosed() const { return enclosed_; }
  /// The hull of what all of them have reached.
  [[nodiscard]] const std::vector<Interval>& reached() const { return reached_; }

 private:
  bool halve(std::size_t subbox, const Enclose& enclose);
  [[nodiscard]] std::size_t direction(const Subbox& subbox) const;
  [[nodiscard]] std::size_t deepest_failure() const;
  [[nodiscard]] double missing(std::size_t side) const;
  [[nodiscard]] std::size_t farthest() const;
  [[nodiscard]] std::size_t owner(std::size_t side) const;
  [[nodiscard]] bool still_pays();
  [[nodiscard]] bool has_hope(std::size_t first_subboxes) const;
  [[nodiscard]] std::int64_t subboxes_worth() const;
  [[nodiscard]] bool is_spent() const;

  std::vector<EndCells> targets_;
  std::vector<double> steps_;
  std::int64_t effort_;  ///< the most usual subboxes

  std::vector<Subbox> subboxes_;
  std::vector<Interval> reached_;
  std::int64_t work_ = 0;  ///< of the subboxes that have been enclosed, in sub-steps along a solution
  std::int64_t enclosed_ = 0;
  std::vector<bool> given_up_;  ///< lower and upper end of every target
  std::size_t next_check_ = 0;  ///< number of subboxes at which it is checked whether it still pays
  double missed_ = 0.0;         ///< at the last check
};

}  // namespace coordreq
