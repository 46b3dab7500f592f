#include "reach/nilpotent_flow.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "reach/affine_form.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// A, B and c.
struct AffineSystem {
  RationalMatrix state;
  RationalMatrix disturbance;
  RationalVector lower;
  RationalVector upper;
};

/// An equation that uses a periodic state as a number is affine only until that passes its seam.
bool jumps_at_a_seam(const SystemSpec& spec, const Dependencies& dependencies, const AffineForm& form) {
  for (std::size_t j = 0; j < dependencies.moving.size(); ++j) {
    const StateSpec& used = spec.states[static_cast<std::size_t>(dependencies.moving[j])];
    if (form.state(static_cast<Eigen::Index>(j)) != 0 && used.above == Outside::periodic) return true;
  }
  return false;
}

std::optional<AffineSystem> affine_system(const SystemSpec& spec, const Dependencies& dependencies,
                                          const std::vector<Rational>& slots) {
  const auto n = static_cast<Eigen::Index>(dependencies.moving.size());
  const auto m = static_cast<Eigen::Index>(dependencies.disturbances.size());
  AffineSystem system{RationalMatrix(n, n), RationalMatrix(n, m), RationalVector(n), RationalVector(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto j = static_cast<std::size_t>(dependencies.moving[static_cast<std::size_t>(i)]);
    const std::optional<AffineForm> form = affine_form(spec, j, dependencies, slots);
    if (!form || jumps_at_a_seam(spec, dependencies, *form)) return std::nullopt;
    system.state.row(i) = form->state;
    system.disturbance.row(i) = form->disturbance;
    system.lower(i) = form->lower;
    system.upper(i) = form->upper;
  }
  return system;
}

/// r_0, r_1, ... up to the last that is not zero; none if r_n is not zero (not nilpotent).
RationalMatrix krylov_rows(const RationalMatrix& a, Eigen::Index start) {
  RationalMatrix rows = RationalMatrix::Zero(a.rows() + 1, a.cols());
  rows(0, start) = 1;
  for (Eigen::Index k = 1; k <= a.rows(); ++k) {
    rows.row(k) = product(rows.row(k - 1), a);
    if ((rows.row(k).array() == Rational(0)).all()) return rows.topRows(k);
  }
  return {};
}

}  // namespace

RationalVector exponential_terms(const Rational& t, Eigen::Index count) {
  RationalVector terms = RationalVector::Ones(count);
  for (Eigen::Index k = 1; k < count; ++k) terms(k) = terms(k - 1) * t / Rational(k);
  return terms;
}

std::optional<NilpotentFlow> nilpotent_flow(const SystemSpec& spec, std::size_t state,
                                            const Dependencies& dependencies,
                                            const std::vector<Rational>& slots) {
  REQUIRES(contains(dependencies.moving, state));
  const std::optional<AffineSystem> system = affine_system(spec, dependencies, slots);
  if (!system) return std::nullopt;
  const std::vector<std::int32_t>& moving = dependencies.moving;
  const auto found = std::find(moving.begin(), moving.end(), static_cast<std::int32_t>(state));
  NilpotentFlow flow;
  flow.rows = krylov_rows(system->state, found - moving.begin());
  if (flow.rows.rows() == 0) return std::nullopt;
  const RationalMatrix positive = flow.rows.cwiseMax(Rational(0));
  const RationalMatrix negative = flow.rows.cwiseMin(Rational(0));
  flow.lower = product(positive, system->lower) + product(negative, system->upper);
  flow.upper = product(positive, system->upper) + product(negative, system->lower);
  const RationalVector inverse_factorials = exponential_terms(1, flow.rows.rows());
  flow.kernels = inverse_factorials.asDiagonal() * product(flow.rows, system->disturbance);
  return flow;
}

}  // namespace coordreq
