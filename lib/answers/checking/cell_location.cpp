#include "answers/checking/cell_location.hpp"

#include <fmt/format.h>

namespace coordreq {
namespace {

/// A number as text for people: exact unless that is long.
std::string short_text(const Rational& value) {
  constexpr std::size_t kLongest = 12;
  std::string exact = to_text(value);
  return exact.size() <= kLongest ? exact : fmt::format("{:.9g}", value.get_d());
}

}  // namespace

std::string location_of(const UniformGrid& grid, std::int64_t cell) {
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid[i].name,
                        short_text(grid[i].point(grid.index(cell, i))));
  }
  return text;
}

std::string entry_text(const UniformGrid& grid, const InputSpace& inputs, const PostTable& table,
                       std::int64_t entry) {
  std::string text;
  const auto add = [&text](const std::string& name, const Rational& value) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, short_text(value));
  };
  for (const std::size_t j : table.states)
    add(grid[j].name, grid[j].point(entry / table.state_stride[j] % grid[j].count));
  for (const std::size_t j : table.inputs) {
    const std::int64_t value = entry / table.input_stride[j] % inputs[j].count();
    add(inputs[j].name, inputs[j].values[static_cast<std::size_t>(value)]);
  }
  return text.empty() ? "everywhere" : text;
}

std::string range_text(const GridDimension& dimension, IndexRange range) {
  if (range.first == INT32_MIN && range.last == INT32_MAX) return "anything";
  if (range.first > range.last) return "nothing";
  const auto centre = [&dimension](std::int32_t k) { return dimension.point(k).get_d(); };
  if (range.first == range.last) return fmt::format("{:.9g}", centre(range.first));
  return fmt::format("{:.9g} to {:.9g}", centre(range.first), centre(range.last));
}

}  // namespace coordreq
