#include "results/scots_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/error.hpp"
#include "model/reversed_numbers.hpp"
#include "results/same_grid.hpp"
#include "results/scots_text.hpp"

namespace coordreq {
namespace {

/// One dimension of a grid as the spec has it.
struct Axis {
  std::string name;
  Rational first;
  Rational last;
  Rational step;
  std::int64_t count = 0;
  /// [number along the grid] index in the spec; values may be listed in any order.
  std::vector<std::int64_t> index;
};

Axis axis_of(const StateSpec& state) {
  const Rational length = state.grid.step * Rational(static_cast<long>(state.grid.count - 1));
  Axis axis{state.name, state.grid.first, state.grid.first + length, state.grid.step, state.grid.count, {}};
  axis.index.resize(static_cast<std::size_t>(axis.count));
  std::iota(axis.index.begin(), axis.index.end(), 0);
  return axis;
}

Axis axis_of(const InputSpec& input, const std::string& path) {
  const std::vector<Rational>& values = input.values;
  Axis axis{input.name, 0, 0, 0, static_cast<std::int64_t>(values.size()), {}};
  axis.index.resize(values.size());
  std::iota(axis.index.begin(), axis.index.end(), 0);
  const auto value = [&](std::size_t k) -> const Rational& {
    return values[static_cast<std::size_t>(axis.index[k])];
  };
  std::sort(axis.index.begin(), axis.index.end(), [&](std::int64_t a, std::int64_t b) {
    return values[static_cast<std::size_t>(a)] < values[static_cast<std::size_t>(b)];
  });
  axis.first = value(0);
  axis.last = value(values.size() - 1);
  if (values.size() > 1) axis.step = value(1) - value(0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (value(k) == axis.first + axis.step * Rational(static_cast<unsigned long>(k))) continue;
    throw ControllerError(
        fmt::format("SCOTS knows no such list of values as that of '{}' in the spec: expected "
                    "evenly spaced ones",
                    input.name),
        path);
  }
  return axis;
}

class Reader {
 public:
  Reader(const std::string& path, const ProblemSpec& spec) : text_(path) {
    for (const StateSpec& state : spec.states) states_.push_back(axis_of(state));
    for (const InputSpec& input : spec.inputs) inputs_.push_back(axis_of(input, path));
  }

  void read_head() {
    text_.expect("#SCOTS:v0.2");
    text_.expect("#TYPE:STATICCONTROLLER");
    check_grid("STATE_SPACE", states_);
    check_grid("INPUT_SPACE", inputs_);
    text_.expect("#TYPE:WINNINGDOMAIN");
    std::string_view line = text_.next("'#MATRIX:DATA'");
    if (line.substr(0, 7) == "#SCOTS:") line = text_.next("'#MATRIX:DATA'");  // a comment
    if (line != "#MATRIX:DATA")
      throw ControllerError(fmt::format("found '{}', expected '#MATRIX:DATA'", line), text_.place());
    const std::vector<std::int64_t> size = text_.begin();
    if (size != std::vector{size_of(states_), size_of(inputs_)}) {
      throw ControllerError(fmt::format("found a matrix of {} states and inputs, expected {} {}",
                                        fmt::join(size, " "), size_of(states_), size_of(inputs_)),
                            text_.place());
    }
  }

  PackedPairs read_pairs() {
    PackedPairs pairs{.inputs = size_of(inputs_), .bytes = {}};
    const auto cells = static_cast<std::size_t>(size_of(states_));
    pairs.bytes.assign(cells * static_cast<std::size_t>(pairs.bytes_per_cell()), 0);
    std::vector<bool> seen(cells, false);
    const ReversedNumbers cell_of = numbers(states_);
    const std::vector<std::int64_t> input_of = joint_inputs();
    for (std::string_view line = text_.next("#END"); line != "#END"; line = text_.next("#END")) {
      const std::vector<std::int64_t> row = text_.naturals(line);
      check_row(row, seen);
      const std::int64_t cell = cell_of.position_of(row.front());
      for (std::size_t j = 1; j < row.size(); ++j)
        pairs.set(cell, input_of[static_cast<std::size_t>(row[j])]);
    }
    return pairs;
  }

 private:
  static std::int64_t size_of(const std::vector<Axis>& axes) {
    std::int64_t size = 1;
    for (const Axis& axis : axes) size *= axis.count;
    return size;
  }

  static ReversedNumbers numbers(const std::vector<Axis>& axes) {
    std::vector<std::int64_t> counts;
    counts.reserve(axes.size());
    for (const Axis& axis : axes) counts.push_back(axis.count);
    return ReversedNumbers(counts);
  }

  /// [number in the file] the joint input of the spec.
  [[nodiscard]] std::vector<std::int64_t> joint_inputs() const {
    std::vector<std::int64_t> result;
    for (std::int64_t number = 0; number < size_of(inputs_); ++number) {
      std::int64_t rest = number;
      std::int64_t joint = 0;
      std::int64_t stride = size_of(inputs_);
      for (const Axis& axis : inputs_) {
        stride /= axis.count;
        joint += axis.index[static_cast<std::size_t>(rest % axis.count)] * stride;
        rest /= axis.count;
      }
      result.push_back(joint);
    }
    return result;
  }

  void check_grid(const std::string& section, const std::vector<Axis>& axes) {
    text_.expect("#SCOTS:" + section);
    text_.expect("#TYPE:UNIFORMGRID");
    const std::int64_t dimensions = text_.member("DIM");
    if (dimensions != static_cast<std::int64_t>(axes.size())) {
      throw ControllerError(
          fmt::format("{}: found {} dimensions, expected {}", section, dimensions, axes.size()),
          text_.place());
    }
    check_entries(section, "ETA", axes, &Axis::step);
    check_entries(section, "LOWER_LEFT", axes, &Axis::first);
    check_entries(section, "UPPER_RIGHT", axes, &Axis::last);
  }

  void check_entries(const std::string& section, const std::string& name, const std::vector<Axis>& axes,
                     Rational Axis::*expected) {
    const std::vector<ScotsText::Entry> found = text_.vector(name, axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
      // A single value has no step; SCOTS writes one all the same.
      if (axes[i].step == 0 && expected == &Axis::step) continue;
      const double wanted = nearest_double(axes[i].*expected);
      const double step = nearest_double(axes[i].step);
      if (same_point(found[i].value, wanted, step == 0 ? std::nullopt : std::optional(step))) continue;
      throw ControllerError(
          fmt::format("{}: {} of {} is {}, expected {}", section, name, axes[i].name, found[i].value, wanted),
          text_.place(found[i].line));
    }
  }

  void check_row(const std::vector<std::int64_t>& row, std::vector<bool>& seen) const {
    const auto check = [&](const char* what, std::int64_t number, std::int64_t count) {
      if (number < count) return;
      throw ControllerError(
          fmt::format("WINNINGDOMAIN: found {} {}, expected one below {}", what, number, count),
          text_.place());
    };
    check("state", row.front(), static_cast<std::int64_t>(seen.size()));
    for (std::size_t j = 1; j < row.size(); ++j) check("input", row[j], size_of(inputs_));
    const auto state = static_cast<std::size_t>(row.front());
    if (seen[state])
      throw ControllerError(fmt::format("WINNINGDOMAIN: state {} is listed twice", state), text_.place());
    seen[state] = true;
  }

  ScotsText text_;
  std::vector<Axis> states_;
  std::vector<Axis> inputs_;
};

}  // namespace

PackedPairs read_scots_controller(const std::string& path, const ProblemSpec& spec) {
  Reader reader(path, spec);
  reader.read_head();
  return reader.read_pairs();
}

void check_scots_controller(const std::string& path, const ProblemSpec& spec) {
  Reader(path, spec).read_head();
}

}  // namespace coordreq
