#include <memory>
#include <utility>

#include "answers/countdown/delay_layers.hpp"
#include "answers/countdown/fields.hpp"
#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/goal/answer.hpp"
#include "answers/goal/arrival.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "choices/action_bits.hpp"
#include "engine/convert_cells.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

const FieldFlag kNotSafe{kOutsideSafe, "not_safe"};
const FieldFlag kNotInvariant{kOutsideInvariant, "not_invariant"};
const FieldFlag kNotWinning{kOutsideWinning, "goal_cannot_be_forced"};

std::string progress_path(const ProblemSpec& spec, const PartitionSpec& partition, std::size_t c) {
  return "/actions:goal/" + partition.name + "/" + class_name(spec.agents, partition.classes[c]);
}

/// What arrival counts.
struct ArrivalText {
  std::string description, compared, title;
};

ArrivalText arrival_text(GoalThen then) {
  if (then == GoalThen::stay)
    return {"number of samples outside the goal, from this one on, that coordinated agents can bound",
            "samples outside the goal", "Samples outside the goal to come"};
  if (then == GoalThen::come_back)
    return {"steps within which coordinated agents can force the next visit of the goal",
            "time to the next visit", "Time to the next visit of the goal"};
  return {"steps within which coordinated agents can force the goal", "time to the goal", "Time to the goal"};
}

/// Of a goal to return to.
std::vector<FieldAttribute> longest_attributes(const ProblemSpec& spec) {
  if (spec.goal_then != GoalThen::come_back) return {};
  return {{"longest_return", std::int64_t{0}, true}, {"longest_gap", std::int64_t{0}, true}};
}

Field arrival_field(const ProblemSpec& spec) {
  const ArrivalText text = arrival_text(spec.goal_then);
  return {.path = paths::kArrival,
          .kind = FieldKind::steps,
          .section = FieldSection::steps,
          .types = {ElementType::int16, ElementType::int32},
          .axes = cell_axes(spec),
          .least = kOutsideSafe,
          .attributes = described(text.description) +
                        std::vector<FieldAttribute>{
                            flags({kNotSafe, kNotInvariant, {kLargestValue, "goal_cannot_be_forced"}}),
                            {"goal_cells", std::uint64_t{0}, true},
                            {"winning_cells", std::uint64_t{0}, true},
                            {"longest_arrival", std::int64_t{0}, true}} +
                        longest_attributes(spec),
          .display = {.column = "arrival",
                      .compared = text.compared,
                      .less_is_better = true,
                      .query = {.name = "arrival", .label = text.compared},
                      .map = {.kind = "arrival", .title = text.title}}};
}

void add_approach(Fields& fields, const ProblemSpec& spec) {
  fields.push_back(steps_field(
      "approach_delay", spec, kOutsideWinning,
      described("largest number of steps without coordination that is safe and costs no time to the goal") +
          std::vector<FieldAttribute>{
              flags({kNotWinning, kNotSafe, kNotInvariant, {kLargestValue, "unbounded"}})},
      {.column = "approach_delay",
       .compared = "approach delay",
       .query = {.label = "approach delay"},
       .map = {.kind = "approach_delay", .title = "Silence that costs no time to the goal"}},
      "/approach_fixed_point_index"));
  fields.push_back(steps_field(
      "approach_trigger", spec, kOutsideWinning,
      described("steps until the agents must start to connect, so as to lose no time to the goal") +
          std::vector<FieldAttribute>{flags({kNotWinning,
                                             {kMustBeConnected, "connection_must_stand_already"},
                                             kNotSafe,
                                             kNotInvariant,
                                             {kLargestValue, "never"}}),
                                      {"connection_delay", spec.coordination.connection_delay}},
      {.column = "approach_countdown",
       .below_zero = kMustBeConnected,
       .query = {.label = "approach: connect in"}}));
}

template <class Integer>
FillArray fill_arrival(const Goal& goal, const LevelMap& times, const CellOrder& order) {
  return [&goal, &times, &order](std::uint64_t begin, std::uint64_t count, void* out) {
    auto* const steps = static_cast<Integer*>(out);
    goal.nearness.visit([&](const auto& levels) {
      convert_cells(levels, order, begin, count, steps, [](auto level) {
        if (level == 0) return static_cast<Integer>(kOutsideInvariant);
        const std::int32_t arrival = arrival_of(level);
        return arrival == kUnbounded ? std::numeric_limits<Integer>::max() : static_cast<Integer>(arrival);
      });
    });
    mark_unsafe(times, order, begin, count, steps);
  };
}

/// Writes kOutsideWinning for the cells of a segment that are in K but not in W.
template <class Integer>
FillArray with_losing_cells(FillArray fill, const Goal& goal, const CellOrder& order) {
  return [fill = std::move(fill), &goal, &order](std::uint64_t begin, std::uint64_t count, void* out) {
    fill(begin, count, out);
    std::vector<std::uint8_t> is_losing(count);
    goal.nearness.visit([&](const auto& levels) {
      convert_cells(levels, order, begin, count, is_losing.data(),
                    [](auto level) { return static_cast<std::uint8_t>(level == 1 ? 1 : 0); });
    });
    for (std::uint64_t i = 0; i < count; ++i) {
      if (is_losing[i] != 0) static_cast<Integer*>(out)[i] = static_cast<Integer>(kOutsideWinning);
    }
  };
}

ResultArray with_losing_cells(ResultArray array, const Goal& goal, const CellOrder& order) {
  array.fill = array.type == ElementType::int16
                   ? with_losing_cells<std::int16_t>(std::move(array.fill), goal, order)
                   : with_losing_cells<std::int32_t>(std::move(array.fill), goal, order);
  return array;
}

/// P of one class of actions, with C in G.
ResultArray progress_bits(std::shared_ptr<const PiecewiseController> pieces, std::vector<InputClass> classes,
                          std::size_t c, ThreadTeam& team) {
  std::vector<std::shared_ptr<const ActionGrouping>> groupings;
  for (const PartialController& piece : pieces->pieces)
    groupings.push_back(std::make_shared<const ActionGrouping>(*piece.controller.engine, classes, team));
  return {ElementType::uint8, [pieces = std::move(pieces), groupings = std::move(groupings), c](
                                  std::uint64_t begin, std::uint64_t count, void* out) {
            fill_action_bits(pieces->pieces[0].controller, *groupings[0], c, begin, count, out);
            std::vector<std::uint8_t> more(count);
            fill_action_bits(pieces->pieces[1].controller, *groupings[1], c, begin, count, more.data());
            auto* const bits = static_cast<std::uint8_t*>(out);
            for (std::uint64_t i = 0; i < count; ++i) bits[i] = static_cast<std::uint8_t>(bits[i] | more[i]);
          }};
}

}  // namespace

/// Arrival, approach delays and triggers, sizes of approach layers, F; on request the progress controller and
/// its projections on the classes. None without a goal.
Fields goal_fields(const ProblemSpec& spec) {
  if (!spec.goal) return {};
  Fields fields = {arrival_field(spec)};
  add_approach(fields, spec);
  // Layers of approach can be constant while each layer of safety loses a cell, and then lose a cell each.
  add_sizes(fields, kApproachKind, 2 * cell_count(spec), spec);
  if (spec.output.controller) {
    add_bits(fields, paths::kProgress, FieldSection::controller, spec, all_inputs(spec),
             spec.is_goal_lasting()
                 ? "joint inputs that come nearer to the goal, or stay in it as it asks, one bit each"
                 : "joint inputs that come nearer to the goal, one bit each; in the goal those of the "
                   "controller");
  }
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    for (std::size_t c = 0; spec.output.actions && c < partition.classes.size(); ++c) {
      add_bits(
          fields, progress_path(spec, partition, c), FieldSection::actions, spec,
          inputs_of(spec, partition.classes[c]),
          "joint actions of the class that come nearer to the goal with some of the others, one bit each");
    }
  }
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_goal_fields(const Answers& answers, ThreadTeam& team, FieldValues& values) {
  const Goal* const goal = answers.find<Goal>();
  if (goal == nullptr) return;
  const ProblemSpec& spec = answers.context.spec;
  const LevelMap& times = answers.get<Invariance>().collision_time;
  const CellOrder& order = *answers.context.order;
  const ElementType type = level_type(goal->longest.value_or(0));
  values.entries[paths::kArrival] = {
      .array = {type, type == ElementType::int16 ? fill_arrival<std::int16_t>(*goal, times, order)
                                                 : fill_arrival<std::int32_t>(*goal, times, order)},
      .attributes = {{"goal_cells", static_cast<std::uint64_t>(goal->sizes.cells)},
                     {"winning_cells", static_cast<std::uint64_t>(goal->sizes.winning)},
                     {"longest_arrival", std::int64_t{goal->longest.value_or(-1)}}}};
  if (spec.goal_then == GoalThen::come_back) {
    std::map<std::string, AttributeValue>& attributes = values.entries[paths::kArrival].attributes;
    attributes["longest_return"] = std::int64_t{goal->returns.forced.value_or(-1)};
    attributes["longest_gap"] = std::int64_t{goal->returns.any_choice.value_or(-1)};
  }
  const LayersOfPartitions layers = pointers_to(goal->approach);
  fill_steps(answers, layers, paths::kApproachDelay, paths::kApproachTrigger, values,
             [goal, &order](ResultArray array) { return with_losing_cells(std::move(array), *goal, order); });
  fill_sizes(layers, kApproachKind, values);
  if (!spec.output.controller && !spec.output.actions) return;
  const std::shared_ptr<const PiecewiseController> pieces = piecewise_controller(answers, true);
  const InputSpace& inputs = answers.context.abstraction->inputs;
  if (spec.output.controller)
    values.entries[paths::kProgress].array = progress_bits(pieces, {whole_class(inputs)}, 0, team);
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    for (std::size_t c = 0; spec.output.actions && c < partition.classes.size(); ++c)
      values.entries[progress_path(spec, partition, c)].array =
          progress_bits(pieces, input_classes(spec, inputs, partition), c, team);
  }
}

}  // namespace coordreq
