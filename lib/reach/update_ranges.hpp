#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "expression/cell_truth.hpp"
#include "expression/domains.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "spec/past_operator.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Where an update leads from one cell after the other (contract, section 6): the hull of the indices of all
/// values that its branches give, where a condition that the cell leaves undecided takes both. Exact:
/// discrete states and inputs are points, and nothing else is read outside of conditions. Conditions are
/// asked of the closed cell, widened by the measurement error, and of all values of disturbances; several of
/// them branch independently.
///
/// The next value of a memory is one value: it follows from the truth of its conditions at the cell, which
/// has three values. Conditions are decided as `safe` is.
///
/// Scratch inside: one object a thread.
class UpdateRanges {
 public:
  /// @pre the state has an update. @pre unchecked: all outlive this object
  UpdateRanges(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs, std::size_t state);

  /// Raw indices.
  /// @param indices by slot, of states and inputs; @param is_new whether one has changed that is read outside
  ///   of conditions since the last call
  /// @throws SpecError if a branch that counts gives no grid value
  [[nodiscard]] IndexRange at(std::span<const std::int64_t> indices, bool is_new);
  /// All that at() is the hull of, ascending; not cut to the range of 32 bits.
  [[nodiscard]] std::vector<std::int64_t> all_at(std::span<const std::int64_t> indices);

 private:
  using Values = std::vector<RationalInterval>;  ///< all different; points, as they should be

  [[nodiscard]] IndexRange kept(std::span<const std::int64_t> indices) const;
  [[nodiscard]] std::vector<std::int64_t> indices_of(std::span<const std::int64_t> indices);
  void find_values(std::size_t node, std::span<const std::int64_t> indices);
  void add_value(std::size_t node, const RationalInterval& value);
  [[nodiscard]] Rational value_at(std::uint32_t slot, std::span<const std::int64_t> indices) const;
  [[noreturn]] void fail(const RationalInterval& value, std::span<const std::int64_t> indices) const;

  const SystemSpec& spec_;
  std::size_t state_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const GridDimension& target_;
  const Program& program_;
  const PastOperator* past_ = nullptr;
  std::vector<bool> needed_;               ///< number nodes outside of conditions
  std::vector<std::size_t> condition_of_;  ///< [node]: of an `if` its number among the conditions
  std::deque<CellTruth> conditions_;
  std::vector<Truth> truths_;
  std::vector<Values> values_;                      ///< [node]
  std::map<std::vector<Truth>, IndexRange> known_;  ///< for the present discrete states and inputs
};

}  // namespace coordreq
