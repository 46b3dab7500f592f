#include "verify/piece_choices.hpp"

#include <algorithm>
#include <utility>

#include "grid/pieces.hpp"

namespace coordreq {
namespace {

std::vector<std::vector<Interval>> boxes_in(const GridDimension& dimension) {
  std::vector<std::vector<Interval>> result;
  for (std::int64_t k = 0; k < dimension.count; ++k) {
    auto& boxes = result.emplace_back();
    for (const Piece& piece : pieces(dimension, k)) boxes.push_back(box_of(piece.lower, piece.upper));
  }
  return result;
}

std::vector<std::vector<Interval>> boxes_in(const InputSpace::Dimension& input) {
  std::vector<std::vector<Interval>> result;
  for (const Rational& value : input.values) result.push_back({box_of(value, value)});
  return result;
}

}  // namespace

bool has_stops(const ProblemSpec& spec, const Influences& influences) {
  return std::any_of(influences.moving.begin(), influences.moving.end(), [&](std::size_t j) {
    return spec.states[j].below == Outside::stop || spec.states[j].above == Outside::stop;
  });
}

bool flows_alike(const ProblemSpec& spec, const Influences& influences, std::size_t state) {
  const std::uint32_t own = spec.state_slot(state);
  return std::none_of(influences.moving.begin(), influences.moving.end(), [&](std::size_t j) {
    const std::vector<std::uint32_t> used = spec.dynamics.equations[j].variables();
    return std::find(used.begin(), used.end(), own) != used.end();
  });
}

PieceChoices::PieceChoices(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                           const PostTable& table, std::optional<std::size_t> left_out) {
  for (const std::size_t j : table.states) {
    if (left_out != j) add(spec.state_slot(j), table.state_stride[j], boxes_in(grid[j]));
  }
  for (const std::size_t j : table.inputs)
    add(spec.input_slot(j), table.input_stride[j], boxes_in(inputs[j]));
}

void PieceChoices::add(std::uint32_t slot, std::int64_t stride, std::vector<std::vector<Interval>> boxes) {
  counts_.push_back(static_cast<std::int64_t>(boxes.size()));
  size_ *= counts_.back();
  variables_.push_back({slot, stride, std::move(boxes)});
}

std::int64_t PieceChoices::position(const Odometer& choice) const {
  std::int64_t position = 0;
  for (std::size_t v = 0; v < variables_.size(); ++v) position += choice[v] * variables_[v].stride;
  return position;
}

std::size_t PieceChoices::variable(std::uint32_t slot) const {
  const auto found = std::find_if(variables_.begin(), variables_.end(),
                                  [slot](const Variable& variable) { return variable.slot == slot; });
  return static_cast<std::size_t>(found - variables_.begin());
}

}  // namespace coordreq
