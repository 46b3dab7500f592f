#include "reach/stopped_row.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "reach/absolute_integral.hpp"
#include "reach/affine_form.hpp"
#include "reach/nilpotent_flow.hpp"

namespace coordreq {
namespace {

using Coefficients = std::vector<Rational>;

/// sum_k polynomial[k] s^k
Rational value_at(const Coefficients& polynomial, const Rational& s) {
  Rational value = 0;
  for (std::size_t k = polynomial.size(); k-- > 0;) value = value * s + polynomial[k];
  return value;
}

/// The integral from 0 to s of rho^power sum_k polynomial[k] rho^k, as a polynomial in s.
Coefficients integral_of(const Coefficients& polynomial, std::size_t power) {
  Coefficients result(polynomial.size() + power + 1);
  for (std::size_t k = 0; k < polynomial.size(); ++k)
    result[k + power + 1] = polynomial[k] / Rational(static_cast<long>(k + power + 1));
  return result;
}

/// An integrator between its limits, and what comes of it in x_i.
class Integrator {
 public:
  /// @param kernel g_v; none for x_i itself, which is v
  Integrator(const GridDimension& dimension, Rational tau, std::optional<Coefficients> kernel)
      : tau_(std::move(tau)), kernel_(std::move(kernel)) {
    if (dimension.below == Outside::stop) bottom_ = dimension.first;
    if (dimension.above == Outside::stop) top_ = dimension.point(dimension.count - 1);
    if (!kernel_) return;
    integral_ = integral_of(*kernel_, 0);
    moment_ = integral_of(*kernel_, 1);
  }

  [[nodiscard]] const std::optional<Rational>& top() const { return top_; }
  /// The value that v0 reaches within the limits, at a rate.
  [[nodiscard]] Rational from(const Rational& v0, const Rational& rate) const {
    const Rational moving = time_of_moving(v0, rate);
    const Rational end = v0 + rate * moving;
    if (!kernel_) return end;
    // v(tau - s) = v0 + rate (tau - s) for s from `still` on, and `end` before.
    const Rational still = tau_ - moving;
    const Rational rest = value_at(integral_, still);
    return (v0 + rate * tau_) * (value_at(integral_, tau_) - rest) -
           rate * (value_at(moment_, tau_) - value_at(moment_, still)) + end * rest;
  }
  /// Whether all states a little below v0 get to the same value as v0.
  [[nodiscard]] bool is_flat_below(const Rational& v0, const Rational& rate) const {
    if (kernel_) return false;
    const Rational end = v0 + rate * tau_;
    return (bottom_ && end <= *bottom_) || (top_ && end > *top_);
  }

 private:
  [[nodiscard]] Rational time_of_moving(const Rational& v0, const Rational& rate) const {
    const std::optional<Rational>& limit = rate < 0 ? bottom_ : top_;
    if (rate == 0 || !limit) return tau_;
    return std::min(tau_, Rational((*limit - v0) / rate));
  }

  Rational tau_;
  std::optional<Coefficients> kernel_;
  Coefficients integral_;
  Coefficients moment_;
  std::optional<Rational> bottom_;
  std::optional<Rational> top_;
};

class RowMaker {
 public:
  RowMaker(const SystemSpec& spec, const UniformGrid& grid, const Dependencies& dependencies,
           std::size_t state, const std::vector<Rational>& slots)
      : spec_(spec),
        grid_(grid),
        moving_(dependencies.moving),
        disturbances_(dependencies.disturbances),
        state_(state),
        flow_(nilpotent_flow(spec, state, dependencies, slots)) {
    if (!flow_ || flow_->lower != flow_->upper) return;
    for (const std::int32_t j : moving_) forms_.push_back(affine_form(spec, at(j), dependencies, slots));
  }

  [[nodiscard]] std::optional<StoppedRow> make() {
    if (forms_.empty()) return std::nullopt;
    for (std::size_t j = 0; j < moving_.size(); ++j) {
      if (stops(j) && !is_integrator(j)) return std::nullopt;
    }
    const auto found = std::find(moving_.begin(), moving_.end(), static_cast<std::int32_t>(state_));
    REQUIRES(found != moving_.end());
    target_ = static_cast<std::size_t>(found - moving_.begin());
    StoppedRow row{.summands = {}, .lower = drift(), .upper = drift(), .is_stopped = stops(target_)};
    if (forms_[target_]->lower == forms_[target_]->upper && !is_moved_by_free_states())
      row.rate.emplace(rate(target_, false), rate(target_, true));
    if (!add_disturbances(row)) return std::nullopt;
    for (std::size_t j = 0; j < moving_.size(); ++j) {
      std::optional<std::vector<StoppedRow::Summand>> summands = stops(j) ? of_stopped(j) : of_free(j);
      if (!summands) return std::nullopt;
      row.summands.push_back(std::move(*summands));
    }
    return row;
  }

 private:
  [[nodiscard]] const GridDimension& dimension(std::size_t j) const { return grid_[at(moving_[j])]; }
  [[nodiscard]] bool stops(std::size_t j) const {
    return dimension(j).below == Outside::stop || dimension(j).above == Outside::stop;
  }
  [[nodiscard]] bool is_moved_by_free_states() const {
    for (std::size_t j = 0; j < moving_.size(); ++j) {
      if (!stops(j) && slope(j) != 0) return true;
    }
    return false;
  }
  /// Of x_i' in a state.
  [[nodiscard]] Rational slope(std::size_t j) const {
    return forms_[target_]->state(static_cast<Eigen::Index>(j));
  }
  [[nodiscard]] bool is_integrator(std::size_t j) const {
    const AffineForm& form = *forms_[j];
    return form.lower == form.upper && (form.state.array() == Rational(0)).all();
  }
  [[nodiscard]] Rational entry(Eigen::Index k, std::size_t j) const {
    return flow_->rows(k, static_cast<Eigen::Index>(j));
  }

  /// The change by constants, without those of stopped states.
  [[nodiscard]] Rational drift() const {
    const Eigen::Index terms = flow_->rows.rows();
    const RationalVector weights = exponential_terms(spec_.dynamics.period, terms + 1);
    Rational sum = 0;
    for (Eigen::Index k = 0; k < terms; ++k) {
      Rational term = flow_->lower(k);
      for (std::size_t j = 0; j < moving_.size(); ++j) {
        if (stops(j)) term -= entry(k, j) * forms_[j]->lower;
      }
      sum += term * weights(k + 1);
    }
    return sum;
  }

  /// @returns false if one acts on a stopped state and on another one, or its effect is not known exactly
  [[nodiscard]] bool add_disturbances(StoppedRow& row) const {
    for (std::size_t l = 0; l < disturbances_.size(); ++l) {
      const auto index = static_cast<Eigen::Index>(l);
      const auto stopped = std::count_if(forms_.begin(), forms_.end(), [&](const auto& form) {
        return form->disturbance(index) != 0 && stops(static_cast<std::size_t>(&form - forms_.data()));
      });
      const auto all = std::count_if(forms_.begin(), forms_.end(),
                                     [&](const auto& form) { return form->disturbance(index) != 0; });
      if (stopped > 0 && all > 1) return false;
      if (stopped > 0) continue;
      const DisturbanceSpec& w = spec_.disturbances[at(disturbances_[l])];
      const Rational radius = (w.upper - w.lower) / 2;
      const std::vector<Rational> kernel = flow_->kernel(l);
      const AbsoluteIntegral absolute = integral_of_absolute(kernel, spec_.dynamics.period);
      if (!absolute.exact && radius != 0) return false;
      const Rational mean = (w.lower + w.upper) / 2 * value_at(integral_of(kernel, 0), spec_.dynamics.period);
      row.lower += mean - radius * absolute.value;
      row.upper += mean + radius * absolute.value;
    }
    return true;
  }

  [[nodiscard]] Rational rate(std::size_t j, bool greatest) const {
    Rational rate = forms_[j]->lower;
    for (std::size_t l = 0; l < disturbances_.size(); ++l) {
      const Rational factor = forms_[j]->disturbance(static_cast<Eigen::Index>(l));
      const DisturbanceSpec& w = spec_.disturbances[at(disturbances_[l])];
      rate += factor * ((factor > 0) == greatest ? w.upper : w.lower);
    }
    return rate;
  }

  [[nodiscard]] std::optional<std::vector<StoppedRow::Summand>> of_free(std::size_t j) const {
    const Eigen::Index terms = flow_->rows.rows();
    const RationalVector weights = exponential_terms(spec_.dynamics.period, terms);
    Rational factor = 0;
    for (Eigen::Index k = 0; k < terms; ++k) factor += entry(k, j) * weights(k);
    const Rational reach = dimension(j).radius() + dimension(j).measurement_error;
    std::vector<StoppedRow::Summand> summands;
    for (std::int64_t k = 0; k < dimension(j).count; ++k) {
      const Rational middle = factor * dimension(j).point(k);
      const Rational spread = abs(factor) * reach;
      summands.push_back({.lower = middle - spread,
                          .upper = middle + spread,
                          .attained = !(factor > 0) || dimension(j).discrete});
    }
    return summands;
  }

  [[nodiscard]] std::optional<std::vector<StoppedRow::Summand>> of_stopped(std::size_t j) const {
    const Rational& tau = spec_.dynamics.period;
    std::optional<Coefficients> kernel;
    bool rises = true;
    if (at(moving_[j]) != state_) {
      kernel.emplace();
      const RationalVector inverse_factorials = exponential_terms(1, flow_->rows.rows());
      for (Eigen::Index k = 0; k + 1 < flow_->rows.rows(); ++k)
        kernel->push_back(entry(k + 1, j) * inverse_factorials(k));
      const AbsoluteIntegral absolute = integral_of_absolute(*kernel, tau);
      const Rational plain = value_at(integral_of(*kernel, 0), tau);
      if (!absolute.exact || absolute.value != abs(plain)) return std::nullopt;
      rises = plain > 0;
    }
    const Integrator integrator(dimension(j), tau, std::move(kernel));
    const Integrator itself(dimension(j), tau, std::nullopt);
    const Rational factor = slope(j), down = rate(j, false), up = rate(j, true);
    const Rational fastest = rate(j, rises);
    const Rational slowest = rate(j, !rises);
    const Rational reach = dimension(j).radius() + dimension(j).measurement_error;
    std::vector<StoppedRow::Summand> summands;
    for (std::int64_t k = 0; k < dimension(j).count; ++k) {
      const Piece start = pieces(dimension(j), k).front();
      const Rational& high = rises ? start.upper : start.lower;
      const Rational& low = rises ? start.lower : start.upper;
      // A cell that is cut at a limit has that end, as a cell without its upper end has not.
      const bool is_cut = integrator.top() && dimension(j).point(k) + reach > *integrator.top();
      StoppedRow::Summand& summand = summands.emplace_back(
          StoppedRow::Summand{.lower = integrator.from(low, slowest),
                              .upper = integrator.from(high, fastest),
                              .attained = !rises || is_cut || integrator.is_flat_below(high, fastest)});
      if (factor == 0) continue;
      const Rational least = factor * std::min(start.lower, itself.from(start.lower, down));
      const Rational most = factor * std::max(start.upper, itself.from(start.upper, up));
      summand.slowest = std::min(least, most);
      summand.fastest = std::max(least, most);
    }
    return summands;
  }

  const SystemSpec& spec_;
  const UniformGrid& grid_;
  const std::vector<std::int32_t>& moving_;
  const std::vector<std::int32_t>& disturbances_;
  std::size_t state_;
  std::size_t target_ = 0;  ///< its position among the moving states
  std::optional<NilpotentFlow> flow_;
  std::vector<std::optional<AffineForm>> forms_;  ///< [moving state]
};

}  // namespace

std::optional<StoppedRow> stopped_row(const SystemSpec& spec, const UniformGrid& grid,
                                      const Dependencies& dependencies, std::size_t state,
                                      const std::vector<Rational>& slots) {
  REQUIRES(spec.dynamics.time == Time::continuous);
  return RowMaker(spec, grid, dependencies, state, slots).make();
}

}  // namespace coordreq
