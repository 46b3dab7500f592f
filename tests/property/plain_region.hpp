#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "model/odometer.hpp"
#include "model/pieces.hpp"
#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The cells of a region lie between these: those with a point in it, and those that natural interval
/// evaluation does not tell from it.
struct PlainRegion {
  std::vector<bool> sampled, natural;

  PlainRegion(const ProblemSpec& spec, const Program& where, const UniformGrid& grid)
      : condition_(where), variables_(where.variables()), box_(spec.slot_count()) {
    std::vector<std::vector<std::vector<Piece>>> parts;  // [state][index]
    for (const GridDimension& dimension : grid.dimensions()) {
      auto& indices = parts.emplace_back();
      for (std::int64_t k = 0; k < dimension.count; ++k) indices.push_back(pieces(dimension, k));
    }
    for (std::int64_t x = 0; x < grid.cells(); ++x) {
      std::vector<std::int64_t> counts;
      for (const std::uint32_t i : variables_)
        counts.push_back(static_cast<std::int64_t>(parts[i][at(grid.index(x, i))].size()));
      sampled.push_back(false);
      natural.push_back(false);
      Odometer choice(counts);
      do {
        for (std::size_t v = 0; v < variables_.size(); ++v) {
          const Piece& piece =
              parts[variables_[v]][at(grid.index(x, variables_[v]))][at(choice.indices()[v])];
          box_[variables_[v]] = {.lower = piece.lower, .upper = piece.upper};
        }
        look_at_box();
      } while (choice.advance());
    }
  }

 private:
  void look_at_box() {
    const Truth truth = condition_.condition(box_);
    if (truth == Truth::no) return;
    natural.back() = true;
    sampled.back() = sampled.back() || truth == Truth::yes || holds_at_a_point();
  }

  /// Corners and middles.
  bool holds_at_a_point() {
    Odometer choice(std::vector<std::int64_t>(variables_.size(), 3));
    std::vector<RationalInterval> point = box_;
    do {
      for (std::size_t v = 0; v < variables_.size(); ++v) {
        const RationalInterval& range = box_[variables_[v]];
        const Rational value =
            range.lower + (range.upper - range.lower) * static_cast<long>(choice.indices()[v]) / 2;
        point[variables_[v]] = {.lower = value, .upper = value};
      }
      if (condition_.condition(point) == Truth::yes) return true;
    } while (choice.advance());
    return false;
  }

  Evaluator<RationalInterval> condition_;
  std::vector<std::uint32_t> variables_;
  std::vector<RationalInterval> box_;
};

}  // namespace coordreq
