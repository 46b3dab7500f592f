#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "model/input_space.hpp"
#include "model/odometer.hpp"
#include "model/uniform_grid.hpp"
#include "spec/system_spec.hpp"
#include "verify/reference_posts.hpp"

namespace coordreq {

/// All choices of values of the parameters and inputs that a state depends on. Immutable.
class ParameterChoices {
 public:
  /// @param table laid out as the state's own
  /// @pre unchecked: all outlive this object.
  ParameterChoices(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                   const Influences& influences, const PostTable& table)
      : spec_(spec), grid_(grid), inputs_(inputs), influences_(influences), table_(table) {
    for (const std::size_t j : influences.parameters) counts_.push_back(grid[j].count);
    for (const std::size_t j : influences.inputs) counts_.push_back(inputs[j].count());
    for (const std::int64_t count : counts_) size_ *= count;
  }

  [[nodiscard]] const std::vector<std::int64_t>& counts() const { return counts_; }
  [[nodiscard]] std::int64_t size() const { return size_; }

  /// Their values, by slot.
  [[nodiscard]] std::vector<Rational> slots(const Odometer& choice) const {
    std::vector<Rational> slots(spec_.slot_count());
    std::size_t digit = 0;
    for (const std::size_t j : influences_.parameters)
      slots[spec_.state_slot(j)] = grid_[j].point(choice[digit++]);
    for (const std::size_t j : influences_.inputs)
      slots[spec_.input_slot(j)] = inputs_[j].values[static_cast<std::size_t>(choice[digit++])];
    return slots;
  }

  /// Position in the table of the entry with index 0 of all moving states.
  [[nodiscard]] std::int64_t position(const Odometer& choice) const {
    std::int64_t position = 0;
    std::size_t digit = 0;
    for (const std::size_t j : influences_.parameters) position += choice[digit++] * table_.state_stride[j];
    for (const std::size_t j : influences_.inputs) position += choice[digit++] * table_.input_stride[j];
    return position;
  }

 private:
  const SystemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const Influences& influences_;
  const PostTable& table_;
  std::vector<std::int64_t> counts_;
  std::int64_t size_ = 1;
};

/// The cells that a table has entries of, for one choice of parameters and inputs after the other. Immutable.
class CellsOfTable {
 public:
  /// @pre unchecked: all outlive this object.
  CellsOfTable(const UniformGrid& grid, const Influences& influences, const PostTable& table)
      : grid_(grid), influences_(influences), table_(table) {
    for (const std::int64_t position : table.positions) {
      std::int64_t base = position;
      for (const std::size_t j : influences.moving) base -= index_of(position, j) * table.state_stride[j];
      positions_[base].push_back(position);
    }
  }

  /// Calls `visit(indices of the moving states, place)` for each.
  /// @param base as ParameterChoices::position()
  /// @param left_out a state whose index is not passed, but 0: one visit for all of them
  template <class Visit>
  void for_each(std::int64_t base, std::optional<std::size_t> left_out, const Visit& visit) const {
    if (table_.positions.empty()) return for_all(base, left_out, visit);
    const auto positions = positions_.find(base);
    if (positions == positions_.end()) return;
    std::set<std::int64_t> visited;
    for (std::int64_t position : positions->second) {
      std::vector<std::int64_t> indices;
      for (const std::size_t j : influences_.moving)
        indices.push_back(j == left_out ? 0 : index_of(position, j));
      if (left_out) position -= index_of(position, *left_out) * table_.state_stride[*left_out];
      if (visited.insert(position).second) visit(indices, position);
    }
  }

 private:
  [[nodiscard]] std::int64_t index_of(std::int64_t position, std::size_t state) const {
    return position / table_.state_stride[state] % grid_[state].count;
  }

  template <class Visit>
  void for_all(std::int64_t base, std::optional<std::size_t> left_out, const Visit& visit) const {
    std::vector<std::int64_t> counts;
    for (const std::size_t j : influences_.moving) counts.push_back(j == left_out ? 1 : grid_[j].count);
    Odometer cell(counts);
    do {
      std::int64_t position = base;
      for (std::size_t j = 0; j < counts.size(); ++j)
        position += cell[j] * table_.state_stride[influences_.moving[j]];
      visit(cell.indices(), position);
    } while (cell.advance());
  }

  const UniformGrid& grid_;
  const Influences& influences_;
  const PostTable& table_;
  std::map<std::int64_t, std::vector<std::int64_t>> positions_;  ///< [base], if some are left out
};

}  // namespace coordreq
