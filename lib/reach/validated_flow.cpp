#include "reach/validated_flow.hpp"

#include <utility>

#include "reach/flow_solver.hpp"

namespace coordreq {

ValidatedFlow::ValidatedFlow(FlowSystem system, double tau_lower, double tau_upper)
    : solver_(std::make_unique<Solver>(std::move(system), Interval{tau_lower, tau_upper})) {}

ValidatedFlow::~ValidatedFlow() = default;
ValidatedFlow::ValidatedFlow(ValidatedFlow&&) noexcept = default;
ValidatedFlow& ValidatedFlow::operator=(ValidatedFlow&&) noexcept = default;

ValidatedFlow::ValidatedFlow(const ValidatedFlow& other)
    : solver_(std::make_unique<Solver>(other.solver_->system(), other.solver_->period())) {}

ValidatedFlow& ValidatedFlow::operator=(const ValidatedFlow& other) {
  if (this != &other) *this = ValidatedFlow(other);
  return *this;
}

const FlowEnclosure& ValidatedFlow::flow(std::span<const Interval> slots) {
  return solver_->flow(slots);
}

const FlowEnclosure& ValidatedFlow::flow_of_subbox(std::span<const Interval> slots, bool long_steps) {
  return solver_->flow_of_subbox(slots, long_steps);
}

std::int64_t ValidatedFlow::extra_steps() const {
  return solver_->extra_steps();
}

std::int64_t ValidatedFlow::steps() const {
  return solver_->steps();
}

bool ValidatedFlow::keeps_apart(std::span<const Interval> box) {
  return solver_->keeps_apart(box);
}

}  // namespace coordreq
