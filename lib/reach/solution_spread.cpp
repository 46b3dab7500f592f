#include "reach/solution_spread.hpp"

#include <algorithm>
#include <cmath>

#include "base/requires.hpp"
#include "expression/dual.hpp"

namespace coordreq {
namespace {

/// The times at which solutions are compared, evenly over the period.
constexpr Eigen::Index kSpreadLooks = 64;
/// The error of a sub-step, in steps of the grid.
constexpr double kSpreadError = 1e-3;
/// Solutions that take more sub-steps are not followed.
constexpr int kSpreadTries = 4000;

}  // namespace

SolutionSpread::SolutionSpread(const FlowSystem& system, double period)
    : period_(period),
      state_slots_(system.state_slots),
      steps_(system.steps),
      pair_(system.equations.size()) {
  REQUIRES(!system.steps.empty());
  for (const Program* equation : system.equations) equations_.emplace_back(*equation);
}

std::optional<std::size_t> SolutionSpread::widest(std::span<const Interval> slots,
                                                  std::span<const Interval> box, double limit) {
  slots_.clear();
  for (const Interval& slot : slots) slots_.push_back(midpoint(slot));
  const auto n = static_cast<Eigen::Index>(box.size());
  Values middle(n);
  for (Eigen::Index i = 0; i < n; ++i) middle(i) = midpoint(box[static_cast<std::size_t>(i)]);
  Path path(n, kSpreadLooks);
  Path other(n, kSpreadLooks);
  if (!follow(middle, path)) return std::nullopt;
  std::optional<std::size_t> result;
  double most = limit;
  for (std::size_t j = 0; j < box.size(); ++j) {
    if (box[j].is_point()) continue;
    for (const double end : {box[j].lower, box[j].upper}) {
      Values side = middle;
      side(static_cast<Eigen::Index>(j)) = end;
      if (!follow(std::move(side), other)) return std::nullopt;
      for (Eigen::Index i = 0; i < n; ++i) {
        const double apart = (path.row(i) - other.row(i)).cwiseAbs().maxCoeff();
        // Seen from the middle: half of what the box leads to.
        const double spread = 2.0 * apart / steps_[static_cast<std::size_t>(i)];
        if (!(spread > most)) continue;
        most = spread;
        result = j;
      }
    }
  }
  return result;
}

bool SolutionSpread::follow(Values x, Path& path) {
  step_ = period_ / static_cast<double>(kSpreadLooks);
  tries_ = 0;
  for (Eigen::Index look = 0; look < kSpreadLooks; ++look) {
    if (!advance(x, period_ / static_cast<double>(kSpreadLooks))) return false;
    path.col(look) = x;
  }
  return true;
}

/// Sub-steps that are halved where the error is too large.
bool SolutionSpread::advance(Values& x, double duration) {
  double left = duration;
  while (left > 0.0) {
    ++all_tries_;
    if (++tries_ > kSpreadTries) return false;
    const double h = std::min(step_, left);
    pair_.step([this](const Values& at, Values& result) { derivative(at, result); }, x, h);
    const double error = error_in_steps();
    if (!(error <= kSpreadError)) {
      step_ = h / 2;
      continue;
    }
    x = pair_.end();
    left = h < left ? left - h : 0.0;
    if (error < kSpreadError / 64) step_ = 2 * h;
  }
  return true;
}

void SolutionSpread::derivative(const Values& x, Values& result) {
  for (std::size_t i = 0; i < state_slots_.size(); ++i)
    slots_[state_slots_[i]] = x(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < equations_.size(); ++i)
    result(static_cast<Eigen::Index>(i)) = equations_[i].number(slots_);
}

/// NaN where something is not defined.
double SolutionSpread::error_in_steps() const {
  const Values error = pair_.error();
  double worst = 0.0;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double in_steps = std::fabs(error(i)) / steps_[static_cast<std::size_t>(i)];
    if (!std::isfinite(pair_.end()(i)) || !std::isfinite(in_steps)) return std::nan("");
    worst = std::max(worst, in_steps);
  }
  return worst;
}

}  // namespace coordreq
