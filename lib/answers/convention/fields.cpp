#include "answers/convention/answer.hpp"
#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/paths.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Fills bits part by part; each cell is in one part.
void fill_bits_of_pieces(const ConventionAnswer& convention, std::size_t agent, std::uint64_t begin,
                         std::uint64_t count, std::uint8_t* out) {
  std::vector<std::uint8_t> bits(count);
  for (std::size_t k = 0; k < convention.agents.size(); ++k) {
    const PartialController& piece = convention.controller->pieces[k];
    fill_convention_bits(piece.controller, convention.agents[k], agent, begin, count, bits.data());
    for (std::uint64_t i = 0; i < count; ++i)
      out[i] = static_cast<std::uint8_t>(k == 0 ? bits[i] : out[i] | bits[i]);
  }
}

}  // namespace

std::string paths::convention(const AgentSpec& agent) {
  return "/actions:convention/" + agent.name;
}

/// The freedom of each agent under the convention; on request its actions.
Fields convention_fields(const ProblemSpec& spec) {
  if (!spec.coordination.convention) return {};
  Fields fields;
  std::vector<std::string> names;
  for (const AgentSpec& agent : spec.agents) names.push_back(agent.name);
  fields.push_back(name_scale("/agent", FieldSection::names, std::move(names), "agent"));
  fields.push_back(
      {.path = paths::kConventionFreedom,
       .kind = FieldKind::share,
       .section = FieldSection::maps,
       .types = {ElementType::float32},
       .axes = cell_axes("/agent", spec),
       .attributes = described("part of its admissible actions that an agent keeps under the convention"),
       .display = {.map = {.kind = "freedom"}}});
  for (const AgentSpec& agent : spec.agents) {
    if (!spec.output.actions) break;
    add_bits(fields, paths::convention(agent), FieldSection::convention, spec, agent.inputs,
             "actions that the agent may take by convention, whatever the others do of theirs, one bit each");
  }
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_convention_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const auto* const convention = answers.find<ConventionAnswer>();
  if (convention == nullptr) return;
  const ProblemSpec& spec = answers.context.spec;
  values.entries[paths::kConventionFreedom].array =
      freedom_array(convention->freedom, *answers.context.order);
  for (std::size_t i = 0; spec.output.actions && i < spec.agents.size(); ++i) {
    values.entries[paths::convention(spec.agents[i])].array = {
        ElementType::uint8, [convention, i](std::uint64_t begin, std::uint64_t count, void* out) {
          fill_bits_of_pieces(*convention, i, begin, count, static_cast<std::uint8_t*>(out));
        }};
  }
}

}  // namespace coordreq
