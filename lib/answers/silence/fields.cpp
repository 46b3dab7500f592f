#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "answers/countdown/fields.hpp"
#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/paths.hpp"
#include "answers/silence/answer.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

Field silence_field(const ProblemSpec& spec) {
  const bool has_then = spec.silence->has_then();
  const std::string outside = has_then ? "not_in_silence_set" : "not_invariant";
  return steps_field(
      "silence", spec, kOutsideSafe,
      described("largest number of steps that are safe while agents do what the spec tells silent ones") +
          std::vector<FieldAttribute>{flags(
              {{kOutsideSafe, "not_safe"}, {kOutsideInvariant, outside}, {kLargestValue, "unbounded"}})},
      {.column = "silence",
       .compared = "silence",
       .query = {.label = "silence",
                 .meanings = {{"not_safe", "none: the cell is not safe"},
                              {"not_invariant", "none: no coordination keeps the system safe from here"},
                              {"not_in_silence_set", "none: the fallback rule does not keep the system safe"},
                              {"unbounded", "unbounded: safe indefinitely"}}},
       .map = {.kind = "silence", .title = "Silence under the communication-loss rule"}},
      "/silence_fixed_point_index");
}

}  // namespace

/// Silence of all partitions, sizes of its layers, F, and K' if there is `then`. None if the spec does not
/// say what silent agents do.
Fields silence_fields(const ProblemSpec& spec) {
  if (!spec.silence) return {};
  Fields fields = {silence_field(spec)};
  if (spec.silence->has_then()) {
    fields.push_back({.path = paths::kSilenceSet,
                      .kind = FieldKind::set,
                      .section = FieldSection::sets,
                      .types = {ElementType::uint8},
                      .axes = cell_axes(spec),
                      .most = 1,
                      .attributes = described("from here what comes after silence is safe for ever") +
                                    std::vector<FieldAttribute>{counted_cells()} +
                                    std::vector<FieldAttribute>{flags({{0, "not_safe"}, {1, "safe"}})},
                      .display = {.column = "silence_set", .compared = "silence set"}});
  }
  add_sizes(fields, kSilenceKind, cell_count(spec), spec);
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_silence_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const auto* const silence = answers.find<Silence>();
  if (silence == nullptr) return;
  const ProblemSpec& spec = answers.context.spec;
  LayersOfPartitions all;
  for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p)
    all.push_back(&silence_of(answers, p).layers);
  fill_steps(answers, all, paths::kSilence, "", values);
  fill_sizes(all, kSilenceKind, values);
  if (!spec.silence->has_then()) return;
  values.entries[paths::kSilenceSet] = {
      .array = invariant_array(silence->lost, *answers.context.order),
      .attributes = {{"cells", static_cast<std::uint64_t>(silence->cells)}}};
}

}  // namespace coordreq
