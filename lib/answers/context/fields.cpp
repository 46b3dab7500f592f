#include "answers/context/answer.hpp"

#include <algorithm>
#include <memory>

#include "answers/field_parts.hpp"
#include "answers/last_value_cache.hpp"
#include "base/thread_team.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"
#include "spec/units.hpp"

namespace coordreq {
namespace {

Field axis(const std::string& name, const std::string& unit, const std::string& role,
           const std::optional<Rational>& step, std::uint64_t count,
           std::function<double(std::uint64_t)> point) {
  Field field{.path = "/" + name,
              .section = FieldSection::grid,
              .types = {ElementType::float64},
              .axes = {},
              .scale = FieldScale{.coordinates = GridPoints{std::move(point)}, .least = count, .most = count},
              .attributes = {{"long_name", role + " " + name}, {"units", udunits_spelling(unit)}}};
  if (step) field.attributes.push_back({"step", nearest_double(*step)});
  field.attributes.push_back({"role", role});
  return field;
}

Field state_axis(const StateSpec& state) {
  return axis(state.name, state.unit, "state", state.grid.step, static_cast<std::uint64_t>(state.grid.count),
              [grid = state.grid](std::uint64_t k) {
                return nearest_double(Rational(grid.first + grid.step * Rational(k)));
              });
}

Field input_axis(const InputSpec& input) {
  return axis(input.name, input.unit, "input",
              input.grid ? std::optional(input.grid->step) : std::optional<Rational>(), input.values.size(),
              [values = input.values](std::uint64_t k) { return nearest_double(values[k]); });
}

/// Fields of the finite abstraction: each table is over the states and inputs that its state depends on.
void add_abstraction(Fields& fields, const ProblemSpec& spec) {
  const std::vector<TableShape> shapes = table_shapes(spec);
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const std::string& state = spec.states[i].name;
    std::vector<std::string> axes;
    for (const std::int32_t j : shapes[i].states)
      axes.push_back("/" + spec.states[static_cast<std::size_t>(j)].name);
    for (const std::int32_t j : shapes[i].inputs)
      axes.push_back("/" + spec.inputs[static_cast<std::size_t>(j)].name);
    const auto add = [&](const std::string& end, const std::string& which) {
      fields.push_back({.path = "/abstraction/" + state + "/" + end,
                        .section = FieldSection::abstraction,
                        .types = {ElementType::int32},
                        .axes = axes,
                        .least = std::numeric_limits<std::int32_t>::min(),
                        .attributes = described(which + " grid index that " + state + " can have next")});
    };
    add("first", "smallest");
    add("last", "largest");
  }
}

using TableCache = LastValueCache<std::size_t, TransitionTable>;

/// One end of all ranges of the table of a state. The table is written out on request, unless it is
/// full: full tables have the order of the spec, and each process is asked for its own cells.
ResultArray ends_array(const Answers& answers, std::size_t state, std::int32_t IndexRange::*end,
                       const std::shared_ptr<TableCache>& tables) {
  return {ElementType::int32,
          [&answers, state, end, tables](std::uint64_t begin, std::uint64_t count, void* out) {
            const TransitionTable& post_table = answers.context.abstraction->tables[state];
            const bool is_in_full = !post_table.shift && !post_table.is_sum();
            std::shared_ptr<const TransitionTable> written;
            if (!is_in_full)
              written = tables->get(state, [&] { return written_out(*answers.context.abstraction, state); });
            const TransitionTable& table = is_in_full ? post_table : *written;
            const auto first = table.entries.begin() + (static_cast<std::int64_t>(begin) - table.before);
            std::transform(first, first + static_cast<std::ptrdiff_t>(count), static_cast<std::int32_t*>(out),
                           [end](const IndexRange& range) { return range.*end; });
          }};
}

}  // namespace

/// The axes of states, inputs and partitions; on request the finite abstraction.
Fields context_fields(const ProblemSpec& spec) {
  Fields fields;
  for (const StateSpec& state : spec.states) fields.push_back(state_axis(state));
  for (const InputSpec& input : spec.inputs) fields.push_back(input_axis(input));
  std::vector<std::string> names;
  for (const PartitionSpec& partition : spec.coordination.partitions) names.push_back(partition.name);
  fields.push_back(name_scale("/partition", FieldSection::grid, std::move(names),
                              "partition of the agents into classes that coordinate"));
  if (spec.output.abstraction) add_abstraction(fields, spec);
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_context_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const ProblemSpec& spec = answers.context.spec;
  const auto table = std::make_shared<TableCache>();
  for (std::size_t i = 0; spec.output.abstraction && i < spec.states.size(); ++i) {
    const std::string group = "/abstraction/" + spec.states[i].name;
    values.entries[group + "/first"].array = ends_array(answers, i, &IndexRange::first, table);
    values.entries[group + "/last"].array = ends_array(answers, i, &IndexRange::last, table);
  }
}

}  // namespace coordreq
