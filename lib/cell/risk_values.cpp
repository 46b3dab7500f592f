#include "cell/risk_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "answers/paths.hpp"
#include "answers/risk/expected_risk.hpp"
#include "answers/risk/policy.hpp"
#include "answers/risk/risk_levels.hpp"
#include "numeric/outward.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"

namespace coordreq {
namespace {

float lower_float(double value) {
  const auto nearest = static_cast<float>(value);
  return double{nearest} <= value ? nearest : std::nextafter(nearest, 0.0F);
}

}  // namespace

RiskValues read_risk_values(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  RiskValues values;
  if (!spec.risk || !spec.risk->is_safest) return values;
  const Field& field = results.field(paths::kRisk);
  const double rate = results.number(paths::kRisk, "rate");
  std::vector<std::vector<std::uint32_t>> levels;
  for (std::size_t mode = 0; mode < spec.network->modes.size(); ++mode) {
    std::vector<std::int32_t>& most = values.emplace_back()[paths::kRiskMost];
    auto& mode_levels = levels.emplace_back();
    for (const float risk : results.reals(field, mode, all_cells(results.grid()))) {
      if (!(risk >= 0 && risk <= 1)) results.fail("a risk is no probability", field.path);
      mode_levels.push_back(risk_level<std::uint32_t>(risk));
      most.push_back(std::bit_cast<std::int32_t>(lower_float(outward::add_down(double{risk}, rate))));
    }
  }
  const ExpectedRisks expected(*spec.network);
  for (std::size_t mode = 0; mode < values.size(); ++mode) {
    const ExpectedRisk& expected_risk = expected.different[expected.of_mode[mode]];
    std::vector<const std::uint32_t*> rows;
    for (const std::size_t next : expected_risk.successors()) rows.push_back(levels[next].data());
    std::vector<std::uint32_t> after(levels[mode].size());
    expected_risk.find(rows, after.size(), after.data());
    for (const std::uint32_t level : after)
      values[mode][paths::kRiskAfter].push_back(std::bit_cast<std::int32_t>(risk_of(level)));
  }
  return values;
}

double risk_of_runs(const ResultsReader& results, std::int64_t cell, std::int64_t steps) {
  const RiskSpec& risk = *results.spec().risk;
  const RequirementDataset start = dataset_of(RequirementKind::max_risk, results.spec());
  const float start_risk =
      results.reals(results.field(start.path), start.entry, one_cell(results.grid(), cell)).front();
  const std::int64_t added = risk.is_safest ? steps : std::max<std::int64_t>(0, steps - risk.horizon);
  const double more = outward::multiply_up(results.number(paths::kRisk, "rate"), static_cast<double>(added));
  return std::min(1.0, outward::add_up(double{start_risk}, more));
}

double bytes_of_risk_values(const ProblemSpec& spec) {
  if (!spec.risk || !spec.risk->is_safest) return 0;
  constexpr double kArrays = 3, kWork = 3;  // levels too; and of one mode while it is computed
  return (kArrays * static_cast<double>(spec.network->modes.size()) + kWork) * sizeof(float);
}

}  // namespace coordreq
