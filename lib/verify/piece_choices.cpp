#include "verify/piece_choices.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "answers/checking/cell_pieces.hpp"
#include "base/requires.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

std::vector<std::vector<ArbSpan>> boxes_in(const GridDimension& dimension) {
  std::vector<std::vector<ArbSpan>> result;
  for (std::int64_t k = 0; k < dimension.count; ++k) {
    auto& boxes = result.emplace_back();
    for (const RationalInterval& piece : pieces_of(dimension, k))
      boxes.push_back(span_of(piece.lower, piece.upper));
  }
  return result;
}

std::vector<std::vector<ArbSpan>> boxes_in(const InputSpace::Dimension& input) {
  std::vector<std::vector<ArbSpan>> result;
  for (const Rational& value : input.values) result.push_back({span_of(value, value)});
  return result;
}

}  // namespace

std::vector<std::size_t> seams_that_jump(const SystemSpec& spec, const Influences& influences) {
  std::vector<std::size_t> result;
  if (spec.dynamics.time == Time::discrete) return result;
  for (const std::size_t j : influences.moving) {
    const StateSpec& state = spec.states[j];
    if (state.below != Outside::periodic) continue;
    const bool jumps = std::any_of(influences.moving.begin(), influences.moving.end(), [&](std::size_t i) {
      return jumps_at_seam(spec.dynamics.equations[i], spec.state_slot(j), state.upper - state.lower);
    });
    if (jumps) result.push_back(j);
  }
  return result;
}

bool has_stops(const SystemSpec& spec, const Influences& influences) {
  return std::any_of(influences.moving.begin(), influences.moving.end(),
                     [&](std::size_t j) { return spec.states[j].has(Outside::stop); });
}

bool flows_alike(const SystemSpec& spec, const Influences& influences, std::size_t state) {
  const std::uint32_t slot = spec.state_slot(state);
  if (spec.states[state].has(Outside::stop)) return false;
  return std::none_of(influences.moving.begin(), influences.moving.end(), [&](std::size_t j) {
    const std::vector<std::uint32_t> used = spec.dynamics.equations[j].variables();
    return std::find(used.begin(), used.end(), slot) != used.end();
  });
}

PieceChoices::PieceChoices(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                           const PostTable& table, std::optional<std::size_t> left_out)
    : grid_(grid) {
  for (const std::size_t j : table.states) {
    if (left_out == j) continue;
    states_.push_back(j);
    add(spec.state_slot(j), table.state_stride[j], boxes_in(grid[j]));
  }
  for (const std::size_t j : table.inputs)
    add(spec.input_slot(j), table.input_stride[j], boxes_in(inputs[j]));
}

void PieceChoices::add(std::uint32_t slot, std::int64_t stride, std::vector<std::vector<ArbSpan>> boxes) {
  counts_.push_back(static_cast<std::int64_t>(boxes.size()));
  size_ *= counts_.back();
  variables_.push_back({slot, stride, std::move(boxes)});
}

std::vector<std::int64_t> PieceChoices::made_by(const std::vector<std::int64_t>& cells) const {
  std::vector<std::int64_t> result;
  if (cells.empty()) {
    result.resize(static_cast<std::size_t>(size_));
    std::iota(result.begin(), result.end(), 0);
    return result;
  }
  std::int64_t inputs = 1;
  for (std::size_t v = states_.size(); v < counts_.size(); ++v) inputs *= counts_[v];
  std::set<std::int64_t> numbers;
  for (const std::int64_t cell : cells) {
    std::int64_t number = 0;
    for (std::size_t v = 0; v < states_.size(); ++v)
      number = number * counts_[v] + grid_.index(cell, states_[v]);
    numbers.insert(number);
  }
  for (const std::int64_t number : numbers) {
    for (std::int64_t u = 0; u < inputs; ++u) result.push_back(number * inputs + u);
  }
  return result;
}

std::int64_t PieceChoices::position(const Odometer& choice) const {
  std::int64_t position = 0;
  for (std::size_t v = 0; v < variables_.size(); ++v) position += choice[v] * variables_[v].stride;
  return position;
}

std::size_t PieceChoices::variable(std::uint32_t slot) const {
  const auto found = std::find_if(variables_.begin(), variables_.end(),
                                  [slot](const Variable& variable) { return variable.slot == slot; });
  REQUIRES(found != variables_.end());
  return static_cast<std::size_t>(found - variables_.begin());
}

}  // namespace coordreq
