#include <memory>

#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/paths.hpp"
#include "choices/action_bits.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

Field set_of_cells(const std::string& name, const std::string& compared, const ProblemSpec& spec,
                   const std::string& long_name) {
  return {.path = "/" + name,
          .kind = FieldKind::set,
          .section = FieldSection::sets,
          .types = {ElementType::uint8},
          .axes = cell_axes(spec),
          .most = 1,
          .attributes = described(long_name) +
                        std::vector<FieldAttribute>{flags({{0, "not_" + name}, {1, name}}), counted_cells()},
          .display = {.column = name, .compared = compared}};
}

}  // namespace

/// S, K and collision times; on request C(x), and the pairs that `controller.file` lists.
Fields invariance_fields(const ProblemSpec& spec) {
  Fields fields = {set_of_cells("safe", "safe set", spec, "cell is in the safe set S"),
                   set_of_cells("invariant", "invariance set", spec, "cell is in the invariance set K")};
  fields.push_back(
      {.path = paths::kCollisionTime,
       .kind = FieldKind::steps,
       .section = FieldSection::sets,
       .types = {ElementType::int16, ElementType::int32},
       .axes = cell_axes(spec),
       .attributes =
           described("steps within which the worst case leaves the safe set, whatever is coordinated") +
           std::vector<FieldAttribute>{flags({{0, "not_safe"}, {kLargestValue, "never"}}),
                                       {"iterations", std::int64_t{0}, true}},
       .display = {.column = "collision_time", .map = {.kind = "collision_time"}}});
  if (spec.output.controller) {
    add_bits(fields, paths::kController, FieldSection::controller, spec, all_inputs(spec),
             "joint inputs that the controller admits, one bit each");
  }
  if (spec.controller.file) {
    add_bits(fields, paths::kListed, FieldSection::controller, spec, all_inputs(spec),
             "joint inputs that the controller file lists, one bit each");
    fields.back().attributes.push_back({"sha256", std::string(), true});
  }
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_invariance_fields(const Answers& answers, ThreadTeam& team, FieldValues& values) {
  const AnalysisContext& context = answers.context;
  const auto& invariance = answers.get<Invariance>();
  const LevelMap& times = invariance.collision_time;
  values.entries[paths::kSafe] = {.array = safe_array(times, *context.order),
                                  .attributes = {{"cells", static_cast<std::uint64_t>(context.safe_cells)}}};
  values.entries[paths::kInvariant] = {
      .array = invariant_array(times, *context.order),
      .attributes = {{"cells", static_cast<std::uint64_t>(invariance.cells)}}};
  // K is in S.
  if (invariance.cells == context.safe_cells) values.entries[paths::kInvariant].equals = paths::kSafe;
  values.entries[paths::kCollisionTime] = {
      .array = collision_array(times, *context.order, level_type(invariance.iterations - 1)),
      .attributes = {{"iterations", invariance.iterations}}};
  if (context.spec.output.controller) {
    const auto everything = std::make_shared<const ActionGrouping>(
        *context.engine, std::vector<InputClass>{whole_class(context.abstraction->inputs)}, team);
    values.entries[paths::kController].array = {
        ElementType::uint8, [controller = answers.get<Controller>(), everything](
                                std::uint64_t begin, std::uint64_t count, void* out) {
          fill_action_bits(controller, *everything, 0, begin, count, out);
        }};
  }
  if (!context.listed) return;
  values.entries[paths::kListed] = {
      .array = {ElementType::uint8,
                [&pairs = context.listed->pairs](std::uint64_t begin, std::uint64_t count, void* out) {
                  std::copy_n(pairs.bytes.begin() + static_cast<std::ptrdiff_t>(begin), count,
                              static_cast<std::uint8_t*>(out));
                }},
      .attributes = {{"sha256", context.listed->sha256}}};
}

}  // namespace coordreq
