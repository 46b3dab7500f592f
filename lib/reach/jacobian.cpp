#include "reach/jacobian.hpp"

#include <algorithm>

namespace coordreq {

Jacobian::Jacobian(const FlowSystem& system, const FlowTape& tape)
    : system_(&system),
      tape_(&tape),
      directions_(system.state_slots),
      values_(tape),
      slots_(system.slot_count) {
  directions_.insert(directions_.end(), system.disturbance_slots.begin(), system.disturbance_slots.end());
  const auto states = static_cast<Eigen::Index>(system.state_slots.size());
  gradient_.resize(states, static_cast<Eigen::Index>(directions_.size()));
  jump_.resize(states);
}

void Jacobian::begin(std::span<const Interval> slots) {
  for (std::size_t i = 0; i < slots.size(); ++i) slots_[i] = Dual::constant(slots[i]);
  values_.run_fixed(slots_);
}

void Jacobian::evaluate(std::span<const Interval> box) {
  for (std::size_t i = 0; i < box.size(); ++i) slots_[system_->state_slots[i]] = Dual::constant(box[i]);
  for (std::size_t first = 0; first < directions_.size(); first += Dual::kDirections) {
    const std::size_t count = std::min(Dual::kDirections, directions_.size() - first);
    for (std::size_t j = 0; j < count; ++j) {
      Dual& slot = slots_[directions_[first + j]];
      slot = Dual::variable(slot.value, j);
    }
    values_.run_moving(slots_);
    collect(first, count);
    for (std::size_t j = 0; j < count; ++j) {
      Dual& slot = slots_[directions_[first + j]];
      slot = Dual::constant(slot.value);
    }
  }
  state_ = gradient_.leftCols(gradient_.rows());
  disturbance_ = gradient_.rightCols(gradient_.cols() - gradient_.rows());
}

/// Takes directions first, ..., first + count - 1 from the values.
void Jacobian::collect(std::size_t first, std::size_t count) {
  for (Eigen::Index i = 0; i < gradient_.rows(); ++i) {
    const Dual& value = values_[tape_->outputs[static_cast<std::size_t>(i)]];
    jump_(i) = value.jump.upper;
    for (std::size_t j = 0; j < count; ++j) {
      gradient_(i, static_cast<Eigen::Index>(first + j)) =
          j < value.directions ? value.gradient[j] : Interval{0.0, 0.0};
    }
  }
}

}  // namespace coordreq
