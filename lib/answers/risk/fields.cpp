#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "answers/field_parts.hpp"
#include "answers/paths.hpp"
#include "answers/risk/answer.hpp"
#include "answers/risk/risk_levels.hpp"
#include "base/grouped.hpp"
#include "engine/convert_cells.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// float32 [modes, cells]
ResultArray risk_array(std::span<const RiskRows> risks, const CellOrder& order) {
  return {ElementType::float32, [risks, &order](std::uint64_t begin, std::uint64_t count, void* out) {
            const auto cells = static_cast<std::uint64_t>(order.cells());
            for (auto* target = static_cast<float*>(out); count > 0;) {
              const std::uint64_t first = begin % cells;
              const std::uint64_t here = std::min(count, cells - first);
              convert_cells(risks[begin / cells], order, first, here, target,
                            [](std::uint32_t level) { return risk_of(level); });
              begin += here;
              count -= here;
              target += here;
            }
          }};
}

constexpr char kStart[] = "/risk_start";

Field risk_field(const ProblemSpec& spec) {
  return {.path = paths::kRisk,
          .kind = FieldKind::probability,
          .section = FieldSection::maps,
          .types = {ElementType::float32},
          .axes = cell_axes("/mode", spec),
          .attributes = described("greatest probability to leave the invariance set within the horizon if "
                                  "the network is in this mode") +
                        std::vector<FieldAttribute>{{"horizon", spec.risk->horizon}, {"rate", 0.0, true}},
          .display = {.column = "risk",
                      .compared = "risk",
                      .less_is_better = true,
                      .query = {.name = "risk",
                                .label = "risk in",
                                .heading = fmt::format("probability to leave the invariance set within {}",
                                                       count_of(spec.risk->horizon, "step"))},
                      .map = {.kind = "risk", .title = "Risk"}}};
}

/// A leading axis of one entry, so that it is shown as the risks in modes are.
Field drawn_risk_field(const ProblemSpec& spec) {
  Field field = risk_field(spec);
  field.path = paths::kDrawnRisk;
  field.axes = cell_axes(kStart, spec);
  field.attributes = described(
      "greatest probability to leave the invariance set within the horizon, before the network is drawn for "
      "the first step");
  field.display.column = field.display.compared = "risk_drawn";
  field.display.query.name = "risk_drawn";
  field.display.query.label = "risk with the network";
  field.display.map.title = "Risk, first step drawn";
  return field;
}

}  // namespace

/// The probability to leave K from each cell, in each mode of the network; and before the mode of the first
/// step is drawn.
Fields risk_fields(const ProblemSpec& spec) {
  if (!spec.risk) return {};
  Fields fields = {risk_field(spec)};
  if (!spec.risk->is_drawn) return fields;
  fields.push_back(name_scale(kStart, FieldSection::names, {"drawn"}, "network at the first step"));
  fields.push_back(drawn_risk_field(spec));
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_risk_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const auto* const risk = answers.find<RiskAnswer>();
  if (risk == nullptr) return;
  const CellOrder& order = *answers.context.order;
  values.entries[paths::kRisk] = {.array = risk_array(risk->risk.risks, order),
                                  .attributes = {{"rate", risk->risk.rate}}};
  if (risk->drawn)
    values.entries[paths::kDrawnRisk] = {.array = risk_array({&*risk->drawn, 1}, order), .attributes = {}};
}

}  // namespace coordreq
