#include "export/scots_controller.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/error.hpp"
#include "cell/cell_controller.hpp"
#include "model/reversed_numbers.hpp"

namespace coordreq {
namespace {

struct Axis {
  std::string name;
  Rational first;
  Rational step;
  std::int64_t count = 0;
};

Axis axis_of_state(const GridDimension& dimension) {
  return {dimension.name, dimension.first, dimension.step, dimension.count};
}

Axis axis_of_input(const InputSpec& input, const ResultsReader& results) {
  const std::vector<Rational>& values = input.values;
  Axis axis{input.name, values.front(), 1, static_cast<std::int64_t>(values.size())};
  if (input.grid) {
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

std::string vector_text(const char* name, const std::vector<Rational>& values) {
  std::string text = fmt::format("#VECTOR:{}\n#BEGIN:{}\n", name, values.size());
  for (const Rational& value : values) text += fmt::format("{:.17g}\n", nearest_double(value));
  return text + "#END\n";
}

std::string grid_text(const std::vector<Axis>& axes) {
  std::vector<Rational> step, first, last;
  for (const Axis& axis : axes) {
    step.push_back(axis.step);
    first.push_back(axis.first);
    last.push_back(axis.first + axis.step * Rational(static_cast<long>(axis.count - 1)));
  }
  return fmt::format("#TYPE:UNIFORMGRID\n#MEMBER:DIM\n{}\n", axes.size()) + vector_text("ETA", step) +
         vector_text("LOWER_LEFT", first) + vector_text("UPPER_RIGHT", last);
}

ReversedNumbers numbers(const std::vector<Axis>& axes) {
  std::vector<std::int64_t> counts;
  for (const Axis& axis : axes) counts.push_back(axis.count);
  return ReversedNumbers(counts);
}

}  // namespace

void export_scots(const ResultsReader& results, ThreadTeam& team, const TextSink& sink) {
  std::vector<Axis> states, inputs;
  for (const GridDimension& dimension : results.grid().dimensions())
    states.push_back(axis_of_state(dimension));
  for (const InputSpec& input : results.spec().inputs) inputs.push_back(axis_of_input(input, results));
  for (const std::vector<Axis>* axes : {&states, &inputs}) {
    for (const Axis& axis : *axes) check_multiples(axis, results);
  }
  sink("#SCOTS:v0.2\n#TYPE:STATICCONTROLLER\n#SCOTS:STATE_SPACE\n" + grid_text(states) +
       "#SCOTS:INPUT_SPACE\n" + grid_text(inputs));
  sink(fmt::format(
      "#TYPE:WINNINGDOMAIN\n#SCOTS:i (state) j_0 ... j_n (valid inputs)\n#MATRIX:DATA\n#BEGIN:{} {}\n",
      results.grid().cells(), results.inputs().count()));
  CellController controller(results, team);
  controller.prepare_all();
  const ReversedNumbers state_numbers = numbers(states);
  const ReversedNumbers input_numbers = numbers(inputs);
  // Both ascend as SCOTS counts.
  std::vector<std::size_t> input_positions;
  for (std::int64_t number = 0; number < results.inputs().count(); ++number) {
    input_positions.push_back(static_cast<std::size_t>(input_numbers.position_of(number)));
  }
  const std::vector<std::uint8_t> invariant = results.invariant(all_cells(results.grid()));
  std::string line;
  for (std::int64_t number = 0; number < results.grid().cells(); ++number) {
    const std::int64_t cell = state_numbers.position_of(number);
    if (invariant[static_cast<std::size_t>(cell)] == 0) continue;
    const std::vector<bool>& admissible = controller.joint_inputs(cell);
    line = std::to_string(number) + " ";
    for (std::size_t j = 0; j < input_positions.size(); ++j) {
      if (admissible[input_positions[j]]) line += std::to_string(j) + " ";
    }
    sink(line + "\n");
  }
  sink("#END\n");
}

}  // namespace coordreq
