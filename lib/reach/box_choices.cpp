#include "reach/box_choices.hpp"

#include <fmt/format.h>

#include "model/pieces.hpp"

namespace coordreq {
namespace {

/// A point as it was typed, or rounded: a fraction of many digits says little.
std::string point_text(const Rational& point) {
  const std::string exactly = to_text(point);
  return exactly.find('/') == std::string::npos ? exactly : fmt::format("{:.6g}", point.get_d());
}

}  // namespace

void BoxChoices::add_state(const GridDimension& dimension, std::uint32_t slot, std::int64_t count,
                           std::int64_t first) {
  Variable& variable = variables_.emplace_back();
  variable.slot = slot;
  variable.name = dimension.name;
  for (std::int64_t k = first; k < first + count; ++k) {
    variable.points.push_back(dimension.point(k));
    std::vector<Interval>& boxes = variable.pieces.emplace_back();
    for (const Piece& piece : pieces(dimension, k)) boxes.push_back(enclose(piece.lower, piece.upper));
  }
}

void BoxChoices::add_input(const InputSpace::Dimension& input, std::uint32_t slot) {
  Variable& variable = variables_.emplace_back();
  variable.slot = slot;
  variable.name = input.name;
  for (const Rational& value : input.values) {
    variable.points.push_back(value);
    variable.pieces.push_back({enclose(value)});
  }
}

Odometer BoxChoices::odometer() const {
  std::vector<std::int64_t> counts;
  for (const Variable& variable : variables_) {
    counts.push_back(static_cast<std::int64_t>(variable.pieces.size()));
  }
  return Odometer(counts);
}

std::string BoxChoices::location(const std::vector<std::int64_t>& choice) const {
  std::string text;
  for (std::size_t v = 0; v < choice.size(); ++v) {
    text += fmt::format("{}{} = {}", text.empty() ? " near " : ", ", variables_[v].name,
                        point_text(variables_[v].points[static_cast<std::size_t>(choice[v])]));
  }
  return text;
}

}  // namespace coordreq
