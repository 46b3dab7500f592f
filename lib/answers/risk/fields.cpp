#include "answers/risk/fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/field_parts.hpp"
#include "answers/risk/answer.hpp"
#include "answers/risk/risk_levels.hpp"
#include "base/grouped.hpp"
#include "engine/convert_stretch.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// float32 [modes, cells]
ResultArray risk_array(const Risk& risk, const CellOrder& order) {
  return {ElementType::float32, [&](std::uint64_t begin, std::uint64_t count, void* out) {
            const auto cells = static_cast<std::uint64_t>(order.cells());
            for (auto* target = static_cast<float*>(out); count > 0;) {
              const std::uint64_t first = begin % cells;
              const std::uint64_t here = std::min(count, cells - first);
              convert_stretch(risk.risks[begin / cells], order, first, here, target,
                              [](std::uint32_t level) { return risk_of(level); });
              begin += here;
              count -= here;
              target += here;
            }
          }};
}

}  // namespace

Fields risk_fields(const ProblemSpec& spec) {
  if (!spec.risk) return {};
  return {{.path = paths::kRisk,
           .kind = FieldKind::probability,
           .section = FieldSection::maps,
           .types = {ElementType::float32},
           .axes = cell_axes("/mode", spec),
           .attributes = described("greatest probability to leave the invariance set within the horizon if "
                                   "the network is in this mode") +
                         std::vector<FieldAttribute>{{"horizon", spec.risk->horizon}, {"rate", 0.0, true}},
           .shown = {.column = "risk",
                     .compared = "risk",
                     .less_is_better = true,
                     .asked = {.name = "risk",
                               .words = "risk in",
                               .heading = fmt::format("probability to leave the invariance set within {}",
                                                      count_of(spec.risk->horizon, "step"))},
                     .map = {.kind = "risk", .title = "Risk"}}}};
}

void fill_risk_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const auto* const risk = answers.find<RiskAnswer>();
  if (risk == nullptr) return;
  values.entries[paths::kRisk] = {.array = risk_array(risk->risk, *answers.context.order),
                                  .attributes = {{"rate", risk->risk.rate}}};
}

}  // namespace coordreq
