#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/alive_rows.hpp"
#include "engine/row_units.hpp"

namespace coordreq {

/// The order in which a wave looks at units: by *fronts*, as in the hyperplane method for Gauss-Seidel
/// iterations (Lamport, "The Parallel Execution of DO Loops", 1974).
///
/// In ascending order of their numbers each unit would see what the units before it have just found. The
/// front of a unit is one more than the greatest front of those among them that its posts can meet. So units
/// of one front do not meet each other but for such as come later, and front after front each of them sees
/// all that it would have seen in that order: as few visits, but a whole front can be computed at once. On
/// three vehicles a front has 70 units in the mean where a run of neighbours that do not meet has one.
///
/// Batches are fronts; small ones are joined, so that some of their units see a little less, and those that
/// are large are divided. They follow from the tables and from which rows are alive, never from the number of
/// threads.
class SweepOrder {
 public:
  struct Batch {
    std::span<const std::uint32_t> units;  ///< by their numbers less first_unit, none that has no row alive
    std::int64_t rows = 0;                 ///< of these, alive
  };

  /// @param first_unit, count the units to be looked at
  /// @param backwards in descending order of numbers instead
  /// @param symmetry may be null
  /// @param most_rows of a batch, but for a single unit
  SweepOrder(const RowUnits& units, const RowHull& hull, const AliveRows& alive, std::int64_t first_unit,
             std::int64_t count, bool backwards, const RowSymmetry* symmetry, std::int64_t most_rows);

  SweepOrder() = default;
  SweepOrder(SweepOrder&&) = default;
  SweepOrder& operator=(SweepOrder&&) = default;
  SweepOrder(const SweepOrder&) = delete;
  SweepOrder& operator=(const SweepOrder&) = delete;
  ~SweepOrder() = default;

  [[nodiscard]] std::size_t size() const { return batches_.size(); }
  [[nodiscard]] const Batch& operator[](std::size_t batch) const { return batches_[batch]; }

 private:
  std::vector<std::uint32_t> units_;  ///< batch after batch
  std::vector<Batch> batches_;
};

}  // namespace coordreq
