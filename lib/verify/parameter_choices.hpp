#pragma once

#include <cstdint>
#include <vector>

#include "model/input_space.hpp"
#include "model/odometer.hpp"
#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"
#include "verify/own_posts.hpp"

namespace coordreq {

/// All choices of values of the parameters and inputs that a state depends on. Immutable.
class ParameterChoices {
 public:
  /// @param table laid out as the state's own
  /// REQUIRES: all outlive this object.
  ParameterChoices(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
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
  const ProblemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const Influences& influences_;
  const PostTable& table_;
  std::vector<std::int64_t> counts_;
  std::int64_t size_ = 1;
};

}  // namespace coordreq
