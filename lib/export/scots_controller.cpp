#include "export/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "answers/paths.hpp"
#include "base/error.hpp"
#include "base/requires.hpp"
#include "cell/cell_controller.hpp"
#include "results/scots_format.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using scots::Axis;

Axis axis_of_state(const GridDimension& dimension) {
  return {dimension.name, dimension.first, dimension.point(dimension.count - 1), dimension.step,
          dimension.count};
}

Axis axis_of_input(const InputSpec& input, const ResultsReader& results) {
  const std::vector<Rational>& values = input.values;
  Axis axis{input.name, values.front(), values.back(), 1, static_cast<std::int64_t>(values.size())};
  if (input.grid && is_integer(axis.first / input.grid->step)) {
    axis.step = input.grid->step;
  } else if (values.size() > 1) {
    axis.step = values[1] - values[0];
  } else if (values.front() != 0) {
    axis.step = abs(values.front());
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (axis.step > 0 && values[k] == axis.first + axis.step * Rational(static_cast<unsigned long>(k)))
      continue;
    throw ResultsError(
        fmt::format("SCOTS knows no such list of values as that of '{}': expected evenly spaced and "
                    "ascending ones",
                    input.name),
        results.path());
  }
  return axis;
}

void check_multiples(const Axis& axis, const ResultsReader& results) {
  if (is_integer(axis.first / axis.step)) return;
  throw ResultsError(
      fmt::format("SCOTS knows no such grid as that of '{}': expected multiples of the step {}, found {}",
                  axis.name, to_text(axis.step), to_text(axis.first)),
      results.path());
}

std::string vector_text(std::string_view name, const std::vector<Axis>& axes, Rational Axis::*member) {
  std::string text = fmt::format("{}\n{}{}\n", name, scots::kBegin, axes.size());
  for (const Axis& axis : axes) text += fmt::format("{:.17g}\n", nearest_double(axis.*member));
  return text + fmt::format("{}\n", scots::kEnd);
}

std::string grid_text(std::string_view head, const std::vector<Axis>& axes) {
  return fmt::format("{}\n{}\n{}\n{}\n", head, scots::kGrid, scots::kDimensions, axes.size()) +
         vector_text(scots::kSteps, axes, &Axis::step) + vector_text(scots::kFirsts, axes, &Axis::first) +
         vector_text(scots::kLasts, axes, &Axis::last);
}

/// The joint inputs of the cells that have any, by one controller or the other.
class Listed {
 public:
  Listed(const ResultsReader& results, ControllerKind kind, ThreadTeam& team)
      : results_(results), controller_(results, team) {
    controller_.prepare_all();
    const CellBlock all = all_cells(results.grid());
    members_ = results.members(paths::kInvariant, all);
    if (kind == ControllerKind::safety) return;
    const auto& policies = controller_.policies();
    policy_ = &*std::find_if(policies.begin(), policies.end(),
                             [](const AnswerPolicy& policy) { return policy.aim.path == paths::kArrival; });
    const std::vector<std::int32_t> arrival =
        results.values(results.field(paths::kArrival), std::nullopt, all);
    for (std::size_t x = 0; x < members_.size(); ++x)
      members_[x] = arrival[x] >= 0 && arrival[x] != std::numeric_limits<std::int32_t>::max() ? 1 : 0;
  }

  [[nodiscard]] bool contains(std::int64_t cell) const {
    return members_[static_cast<std::size_t>(cell)] != 0;
  }
  [[nodiscard]] std::vector<bool> joint_inputs(std::int64_t cell) {
    if (policy_ == nullptr) return controller_.joint_inputs(cell);
    if (!results_.has(paths::kProgress)) return controller_.joint_inputs(*policy_, cell);
    return unpacked(results_.bits(paths::kProgress, one_cell(results_.grid(), cell)),
                    results_.inputs().count());
  }

 private:
  const ResultsReader& results_;
  CellController controller_;
  const AnswerPolicy* policy_ = nullptr;  ///< none: all of C
  std::vector<std::uint8_t> members_;
};

}  // namespace

MemoryDemand scots_demand(const ResultsReader& results) {
  MemoryDemand demand = controller_demand(results, true);
  demand.once += static_cast<double>(results.grid().cells());
  return demand;
}

void export_scots(const ResultsReader& results, ControllerKind kind, ThreadTeam& team, const TextSink& sink) {
  REQUIRES(kind != ControllerKind::progress || results.spec().goal);
  std::vector<Axis> states, inputs;
  for (const GridDimension& dimension : results.grid().dimensions())
    states.push_back(axis_of_state(dimension));
  for (const InputSpec& input : results.spec().inputs) inputs.push_back(axis_of_input(input, results));
  for (const std::vector<Axis>* axes : {&states, &inputs}) {
    for (const Axis& axis : *axes) check_multiples(axis, results);
  }
  for (const std::string_view line : scots::kHead) sink(fmt::format("{}\n", line));
  sink(grid_text(scots::kStates, states) + grid_text(scots::kInputs, inputs));
  sink(fmt::format("{}\n{}\n{}\n{}{} {}\n", scots::kDomain, scots::kColumns, scots::kMatrix, scots::kBegin,
                   results.grid().cells(), results.inputs().count()));
  Listed listed(results, kind, team);
  const ReversedNumbers state_numbers = scots::numbers(states);
  const ReversedNumbers input_numbers = scots::numbers(inputs);
  // Both ascend as SCOTS counts.
  std::vector<std::size_t> input_positions;
  for (std::int64_t number = 0; number < results.inputs().count(); ++number) {
    input_positions.push_back(static_cast<std::size_t>(input_numbers.position_of(number)));
  }
  std::string line;
  for (std::int64_t number = 0; number < results.grid().cells(); ++number) {
    const std::int64_t cell = state_numbers.position_of(number);
    if (!listed.contains(cell)) continue;
    const std::vector<bool> admissible = listed.joint_inputs(cell);
    line = std::to_string(number) + " ";
    for (std::size_t j = 0; j < input_positions.size(); ++j) {
      if (admissible[input_positions[j]]) line += std::to_string(j) + " ";
    }
    sink(line + "\n");
  }
  sink(fmt::format("{}\n", scots::kEnd));
}

}  // namespace coordreq
