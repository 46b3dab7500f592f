#include "results/controller_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "results/scots_format.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// "ETA" of "#VECTOR:ETA".
std::string_view plain(std::string_view name) {
  return name.substr(name.find(':') + 1);
}

/// The lines of a SCOTS file, one after the other. Blank lines and blanks at the ends of lines do not count.
class ScotsText {
 public:
  /// @throws IoError
  explicit ScotsText(const std::string& path);

  /// The next line; a text that ends is an error that names what was `wanted`.
  std::string_view next(std::string_view wanted);
  /// Reads a line that must be `expected`.
  void expect(std::string_view expected);
  /// `name` and its value.
  std::int64_t member(std::string_view name);
  /// `name`, "#BEGIN:n", n numbers, "#END". @throws ControllerError unless n is `count`
  struct Entry {
    double value = 0;
    std::int64_t line = 0;
  };
  std::vector<Entry> vector(std::string_view name, std::size_t count);
  /// The numbers after "#BEGIN:".
  std::vector<std::int64_t> begin();

  /// Natural numbers, blanks between; @throws ControllerError
  [[nodiscard]] std::vector<std::int64_t> naturals(std::string_view text) const;
  [[nodiscard]] std::string location() const { return location(line_number_); }
  [[nodiscard]] std::string location(std::int64_t line) const;

 private:
  std::string path_;
  std::ifstream file_;
  std::string line_;
  std::int64_t line_number_ = 0;
};

ScotsText::ScotsText(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw IoError("cannot read the controller: " + std::generic_category().message(errno), path);
}

std::string ScotsText::location(std::int64_t line) const {
  return fmt::format("{}, line {}", path_, line);
}

std::string_view ScotsText::next(std::string_view wanted) {
  while (std::getline(file_, line_)) {
    ++line_number_;
    const std::string_view text = without_blanks(line_);
    if (!text.empty()) return text;
  }
  if (file_.bad()) throw IoError("cannot read the controller", path_);
  throw ControllerError(fmt::format("the file ends, expected {}", wanted), location());
}

void ScotsText::expect(std::string_view expected) {
  const std::string_view found = next(expected);
  if (found != expected) {
    throw ControllerError(fmt::format("found {}, expected {}", quote_text(found), quote_text(expected)),
                          location());
  }
}

std::int64_t ScotsText::member(std::string_view name) {
  expect(name);
  const std::vector<std::int64_t> value = naturals(next("a number"));
  if (value.size() != 1)
    throw ControllerError(fmt::format("expected one number, found {}", value.size()), location());
  return value.front();
}

std::vector<std::int64_t> ScotsText::begin() {
  const std::string_view text = next("'#BEGIN:'");
  if (text.substr(0, scots::kBegin.size()) != scots::kBegin)
    throw ControllerError(fmt::format("found {}, expected '#BEGIN:'", quote_text(text)), location());
  return naturals(text.substr(scots::kBegin.size()));
}

std::vector<ScotsText::Entry> ScotsText::vector(std::string_view name, std::size_t count) {
  expect(name);
  const std::vector<std::int64_t> size = begin();
  if (size.size() != 1 || size.front() != static_cast<std::int64_t>(count))
    throw ControllerError(
        fmt::format("found {} of {}, expected {}", fmt::join(size, " "), plain(name), count), location());
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view text = next("a number");
    Entry entry{.line = line_number_};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), entry.value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(entry.value))
      throw ControllerError(fmt::format("found {}, expected a number", quote_text(text)), location());
    entries.push_back(entry);
  }
  expect(scots::kEnd);
  return entries;
}

std::vector<std::int64_t> ScotsText::naturals(std::string_view text) const {
  std::vector<std::int64_t> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (kBlanks.find(*at) != std::string_view::npos) {
      ++at;
      continue;
    }
    std::int64_t number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    const bool is_number = rest == end || kBlanks.find(*rest) != std::string_view::npos;
    if (error != std::errc() || !is_number || number < 0)
      throw ControllerError(fmt::format("found {}, expected natural numbers", quote_text(text)), location());
    numbers.push_back(number);
    at = rest;
  }
  return numbers;
}

/// An axis as the spec has it.
struct Axis : scots::Axis {
  /// [number along the grid] index in the spec; values may be listed in any order.
  std::vector<std::int64_t> index;
};

Axis axis_of(const StateSpec& state) {
  Axis axis{{state.name, state.grid.first, state.grid.last(), state.grid.step, state.grid.count}, {}};
  axis.index.resize(static_cast<std::size_t>(axis.count));
  std::iota(axis.index.begin(), axis.index.end(), 0);
  return axis;
}

Axis axis_of(const InputSpec& input, const std::string& path) {
  const std::vector<Rational>& values = input.values;
  Axis axis{{input.name, 0, 0, 0, static_cast<std::int64_t>(values.size())}, {}};
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
    for (const std::string_view line : scots::kHead) text_.expect(line);
    check_grid(scots::kStates, states_);
    check_grid(scots::kInputs, inputs_);
    text_.expect(scots::kDomain);
    std::string_view line = text_.next("'#MATRIX:DATA'");
    if (line.starts_with(scots::kComment)) line = text_.next("'#MATRIX:DATA'");  // a comment
    if (line != scots::kMatrix)
      throw ControllerError(fmt::format("found '{}', expected '#MATRIX:DATA'", line), text_.location());
    const std::vector<std::int64_t> size = text_.begin();
    has_one_input_ = size.size() == 2 && size.back() == 1;
    if (size != std::vector{size_of(states_), has_one_input_ ? 1 : size_of(inputs_)}) {
      throw ControllerError(
          fmt::format("found a matrix of {} states and inputs, expected {} {} (or {} 1: one input a state)",
                      fmt::join(size, " "), size_of(states_), size_of(inputs_), size_of(states_)),
          text_.location());
    }
  }

  PackedPairs read_pairs() {
    PackedPairs pairs{.inputs = size_of(inputs_), .bytes = {}};
    const auto cells = static_cast<std::size_t>(size_of(states_));
    pairs.bytes.assign(cells * static_cast<std::size_t>(pairs.bytes_per_cell()), 0);
    std::vector<bool> seen(cells, false);
    const ReversedNumbers cell_of = scots::numbers(states_);
    const std::vector<std::int64_t> input_of = joint_inputs();
    for (std::string_view line = text_.next(scots::kEnd); line != scots::kEnd;
         line = text_.next(scots::kEnd)) {
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

  void check_grid(std::string_view head, const std::vector<Axis>& axes) {
    text_.expect(head);
    text_.expect(scots::kGrid);
    const std::int64_t dimensions = text_.member(scots::kDimensions);
    const std::string_view section = plain(head);
    if (dimensions != static_cast<std::int64_t>(axes.size())) {
      throw ControllerError(
          fmt::format("{}: found {} dimensions, expected {}", section, dimensions, axes.size()),
          text_.location());
    }
    check_entries(section, scots::kSteps, axes, &Axis::step);
    check_entries(section, scots::kFirsts, axes, &Axis::first);
    check_entries(section, scots::kLasts, axes, &Axis::last);
  }

  void check_entries(std::string_view section, std::string_view name, const std::vector<Axis>& axes,
                     Rational scots::Axis::*expected) {
    const std::vector<ScotsText::Entry> found = text_.vector(name, axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
      // A single value has no step; SCOTS writes one all the same.
      if (axes[i].step == 0 && expected == &Axis::step) continue;
      const double wanted = nearest_double(axes[i].*expected);
      const double step = nearest_double(axes[i].step);
      if (same_point(found[i].value, wanted, step == 0 ? std::nullopt : std::optional(step))) continue;
      throw ControllerError(fmt::format("{}: {} of {} is {}, expected {}", section, plain(name), axes[i].name,
                                        found[i].value, wanted),
                            text_.location(found[i].line));
    }
  }

  void check_row(const std::vector<std::int64_t>& row, std::vector<bool>& seen) const {
    const auto check = [&](const char* what, std::int64_t number, std::int64_t count) {
      if (number < count) return;
      throw ControllerError(
          fmt::format("WINNINGDOMAIN: found {} {}, expected one below {}", what, number, count),
          text_.location());
    };
    check("state", row.front(), static_cast<std::int64_t>(seen.size()));
    for (std::size_t j = 1; j < row.size(); ++j) check("input", row[j], size_of(inputs_));
    if (has_one_input_ && row.size() != 2) {
      throw ControllerError(fmt::format("WINNINGDOMAIN: found {} inputs of state {}, expected one, as the "
                                        "matrix has one column",
                                        row.size() - 1, row.front()),
                            text_.location());
    }
    const auto state = static_cast<std::size_t>(row.front());
    if (seen[state])
      throw ControllerError(fmt::format("WINNINGDOMAIN: state {} is listed twice", state), text_.location());
    seen[state] = true;
  }

  ScotsText text_;
  std::vector<Axis> states_;
  std::vector<Axis> inputs_;
  bool has_one_input_ = false;  ///< each line names one
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
