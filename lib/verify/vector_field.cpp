#include "verify/vector_field.hpp"

#include <algorithm>

#include "spec/system_spec.hpp"

namespace coordreq {

SeriesField::SeriesField(const SystemSpec& spec, const Influences& influences,
                         const std::vector<std::size_t>& equations)
    : slots_(spec.slot_count()) {
  for (const std::size_t j : influences.moving) variables_.push_back(spec.state_slot(j));
  for (const std::size_t l : influences.disturbances) variables_.push_back(spec.disturbance_slot(l));
  for (const std::size_t i : equations) {
    const Program& program = spec.dynamics.equations[i];
    equations_.emplace_back(program);
    const std::vector<std::uint32_t> mentioned = program.variables();
    auto& row = mentions_.emplace_back();
    for (const std::uint32_t slot : variables_)
      row.push_back(std::binary_search(mentioned.begin(), mentioned.end(), slot));
  }
}

void SeriesField::put(const ArbBox& box) {
  for (std::size_t s = 0; s < box.size(); ++s) slots_[s].assign(box[s]);
}

/// A product of series takes as many operations as the square of their length.
const ArbSeries& SeriesField::run(std::size_t equation, slong length) {
  work_ += static_cast<Work>(equations_[equation].operations()) * length * (length + 1) / 2;
  return equations_[equation](slots_, length);
}

Arb SeriesField::value(std::size_t equation, const ArbBox& box) {
  put(box);
  return run(equation, 1)[0];
}

std::optional<std::vector<Arb>> SeriesField::slopes(std::size_t equation, const ArbBox& box) {
  put(box);
  std::vector<Arb> result;
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    const std::uint32_t slot = variables_[j];
    if (!mentions_[equation][j]) {
      result.emplace_back();
      continue;
    }
    slots_[slot].set(1, Arb(1.0));
    const Arb slope = run(equation, 2)[1];
    slots_[slot].assign(box[slot]);
    if (equations_[equation].smoothness() == Smoothness::jumps || !slope.is_finite()) return std::nullopt;
    result.push_back(slope);
  }
  return result;
}

std::optional<ArbMatrix> SeriesField::jacobian(const ArbBox& box) {
  ArbMatrix result(equations_.size(), variables_.size());
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    const std::optional<std::vector<Arb>> row = slopes(i, box);
    if (!row) return std::nullopt;
    for (std::size_t j = 0; j < row->size(); ++j) result.set(i, j, (*row)[j]);
  }
  return result;
}

std::optional<std::vector<ArbSeries>> SeriesField::taylor(const ArbBox& box, slong length) {
  put(box);
  for (slong known = 1; known < length; ++known) {
    std::vector<Arb> next;
    for (std::size_t i = 0; i < equations_.size(); ++i) {
      const Arb slope = run(i, known)[known - 1];
      if (equations_[i].smoothness() != Smoothness::analytic || !slope.is_finite()) return std::nullopt;
      next.push_back(slope / Arb(static_cast<double>(known)));
    }
    for (std::size_t i = 0; i < next.size(); ++i) slots_[variables_[i]].set(known, next[i]);
  }
  std::vector<ArbSeries> result;
  for (std::size_t i = 0; i < equations_.size(); ++i) result.push_back(slots_[variables_[i]]);
  return result;
}

}  // namespace coordreq
