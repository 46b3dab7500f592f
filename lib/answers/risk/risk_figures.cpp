#include "answers/risk/risk_figures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "answers/risk/risk_levels.hpp"
#include "base/requires.hpp"
#include "engine/row_operations.hpp"

namespace coordreq {
namespace {

constexpr std::array<double, RiskFigures::kThresholds> kWithin = {0,    1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7,
                                                                  1e-6, 1e-5,  1e-4,  1e-3,  1e-2, 1e-1};

/// The sum is kept in digits of so many bits, each with room for the sum of as many cells as there are, so
/// that it does not depend on the order.
constexpr int kDigits = 4;
constexpr int kDigitBits = 24;

using Digits = std::array<std::int64_t, kDigits>;  ///< the most significant first

struct Partial {
  std::int64_t cells = 0;
  std::array<std::int64_t, RiskFigures::kThresholds> within = {};
  Digits sum = {};
};

/// Calls `body(risk, part)` for the cells of K.
template <class Body>
void for_each_risk(const RiskRows& risks, const CellSet& invariant, const RowShare* share, ThreadTeam& team,
                   std::vector<Partial>& partials, const Body& body) {
  for_each_local_row(team, share, risks.rows(), 256, [&](ThreadTeam::Range range, int worker) {
    Partial& partial = partials[static_cast<std::size_t>(worker)];
    for (std::int64_t row = range.begin; row < range.end; ++row) {
      const std::uint32_t* const levels = risks.row(row);
      for_each_bit(invariant.row(row), [&](std::int64_t x) { body(risk_of(levels[x]), partial); });
    }
  });
}

std::int64_t greatest_of_all(const RowShare* share, std::int64_t local) {
  return share == nullptr ? local : share->ranks().greatest(local);
}

/// The greatest risk in K, of all processes.
float worst_risk(const RiskRows& risks, const CellSet& invariant, const RowShare* share) {
  std::uint32_t lowest = RiskRows::kTop;
  const RowShare::Range local = local_rows(share, risks.rows());
  for (std::int64_t row = local.begin; row < local.end; ++row) {
    const std::uint32_t* const levels = risks.row(row);
    for_each_bit(invariant.row(row), [&](std::int64_t x) { lowest = std::min(lowest, levels[x]); });
  }
  const std::int64_t all = greatest_of_all(share, std::int64_t{RiskRows::kTop} - lowest);
  return risk_of(static_cast<std::uint32_t>(std::int64_t{RiskRows::kTop} - all));
}

/// Adds risk / unit, cut off after the last digit. @pre risk / unit is below 2^kDigitBits
void add(double risk, double unit, Digits& sum) {
  double rest = risk / unit;
  REQUIRES(rest >= 0 && rest < std::ldexp(1, kDigitBits));
  for (std::int64_t& digit : sum) {
    const double whole = std::floor(rest);
    digit += static_cast<std::int64_t>(whole);
    rest = std::ldexp(rest - whole, kDigitBits);
  }
}

}  // namespace

RiskFigures risk_figures(const RiskRows& risks, const CellSet& invariant, const RowShare* share,
                         ThreadTeam& team) {
  const float worst = worst_risk(risks, invariant, share);
  // A power of two, so that only the digits that are cut off are lost; the worst risk fills the first digit.
  const double unit = worst == 0 ? 1 : std::ldexp(1, std::ilogb(worst) - kDigitBits + 1);
  std::vector<Partial> partials(static_cast<std::size_t>(team.size()));
  for_each_risk(risks, invariant, share, team, partials, [&](float risk, Partial& partial) {
    ++partial.cells;
    const auto first = std::lower_bound(kWithin.begin(), kWithin.end(), double{risk});
    if (first != kWithin.end()) ++partial.within[static_cast<std::size_t>(first - kWithin.begin())];
    add(risk, unit, partial.sum);
  });
  Partial all;
  for (const Partial& partial : partials) {
    all.cells += partial.cells;
    for (std::size_t i = 0; i < kWithin.size(); ++i) all.within[i] += partial.within[i];
    for (std::size_t i = 0; i < kDigits; ++i) all.sum[i] += partial.sum[i];
  }
  RiskFigures figures;
  for (std::size_t i = 0; i < kWithin.size(); ++i) {
    const std::int64_t cells = sum_of_all(share, all.within[i]);
    figures.within[i] = cells + (i == 0 ? 0 : figures.within[i - 1]);
  }
  const std::int64_t cells = sum_of_all(share, all.cells);
  double sum = 0;
  for (std::size_t i = kDigits; i-- > 0;)
    sum = std::ldexp(sum, -kDigitBits) + static_cast<double>(sum_of_all(share, all.sum[i]));
  if (cells == 0) return figures;
  figures.worst = worst;
  figures.mean = sum * unit / static_cast<double>(cells);
  return figures;
}

}  // namespace coordreq
