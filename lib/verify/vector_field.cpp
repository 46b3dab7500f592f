#include "verify/vector_field.hpp"

#include <algorithm>

#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// Putting variables in and taking a result out, in units of work.
constexpr Work kOfCall = 4;

/// States that turn more often count as anywhere.
constexpr long kMostTurnsSeen = 4;

/// No number at all.
Arb unknown() {
  Arb result;
  arb_indeterminate(result.get());
  return result;
}

/// Where a state is that goes round, in parts: a point on its upper end is at the lower one.
std::vector<Arb> ranges_on_ring(const Seam& seam, const Arb& range) {
  const Rational period = seam.upper - seam.lower;
  const std::vector<Arb> anywhere = {hull(Arb(seam.lower), Arb(seam.upper))};
  if (!range.is_finite()) return anywhere;
  const Rational low = range.lower_rational();
  const Rational high = range.upper_rational();
  const Rational far = period * kMostTurnsSeen;
  if (low < seam.lower - far || high > seam.upper + far) return anywhere;
  std::vector<Arb> result;
  for (long turn = -kMostTurnsSeen; turn <= kMostTurnsSeen + 1; ++turn) {
    const Rational by = period * turn;
    if (high < seam.lower + by || low >= seam.upper + by) continue;
    if (turn == 0 && low >= seam.lower && high < seam.upper) return {range};
    result.push_back(hull(Arb(Rational(std::max(low, Rational(seam.lower + by)) - by)),
                          Arb(Rational(std::min(high, Rational(seam.upper + by)) - by))));
  }
  return result;
}

}  // namespace

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
    mentioned_.push_back(mentioned);
  }
}

void SeriesField::put(const ArbBox& box) {
  for (std::size_t s = 0; s < box.size(); ++s) slots_[s].assign(box[s]);
}

/// What one equation needs of it.
void SeriesField::put(std::size_t equation, const ArbBox& box) {
  for (const std::uint32_t slot : mentioned_[equation]) slots_[slot].assign(box[slot]);
}

/// A product of series takes as many operations as the square of their length.
const ArbSeries& SeriesField::run(std::size_t equation, slong length) {
  work_ += kOfCall + static_cast<Work>(equations_[equation].operations()) * length * (length + 1) / 2;
  return equations_[equation](slots_, length);
}

const ArbSeries& SeriesField::extend(std::size_t equation, slong length) {
  if (length == 1) return run(equation, length);
  ExpressionSeries& series = equations_[equation];
  const auto repeated = static_cast<Work>(series.repeated_operations());
  work_ +=
      repeated * length * (length + 1) / 2 + (static_cast<Work>(series.operations()) - repeated) * length;
  return series.extend(slots_, length);
}

/// The box in parts, as an equation sees it; none: as all of them do.
std::vector<ArbBox> SeriesField::seen(const ArbBox& box, std::optional<std::size_t> equation) const {
  std::vector<ArbBox> subboxes = {box};
  for (const Seam& seam : seams_) {
    if (equation && !mentions_[*equation][seam.state]) continue;
    const std::uint32_t slot = variables_[seam.state];
    const std::vector<Arb> ranges = ranges_on_ring(seam, box[slot]);
    const std::vector<ArbBox> before = std::move(subboxes);
    subboxes.clear();
    for (const ArbBox& subbox : before) {
      for (const Arb& range : ranges) {
        subboxes.push_back(subbox);
        subboxes.back()[slot] = range;
      }
    }
  }
  return subboxes;
}

/// @returns null if the box is seen in parts
const ArbBox* SeriesField::seen_whole(const ArbBox& box, std::optional<std::size_t> equation) {
  if (seams_.empty()) return &box;
  std::vector<ArbBox> subboxes = seen(box, equation);
  if (subboxes.size() > 1) return nullptr;
  seen_ = std::move(subboxes.front());
  return &seen_;
}

Arb SeriesField::value(std::size_t equation, const ArbBox& box) {
  if (is_spent()) return unknown();
  if (seams_.empty()) {
    put(equation, box);
    return run(equation, 1)[0];
  }
  std::optional<Arb> all;
  for (const ArbBox& subbox : seen(box, equation)) {
    put(equation, subbox);
    const Arb value = run(equation, 1)[0];
    all = all ? hull(*all, value) : value;
  }
  return *all;
}

std::optional<std::vector<Arb>> SeriesField::slopes(std::size_t equation, const ArbBox& box) {
  if (is_spent()) return std::nullopt;
  const ArbBox* const whole = seen_whole(box, equation);
  if (whole == nullptr) return std::nullopt;
  put(equation, *whole);
  std::vector<Arb> result;
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    const std::uint32_t slot = variables_[j];
    if (!mentions_[equation][j]) {
      result.emplace_back();
      continue;
    }
    slots_[slot].set(1, Arb(1.0));
    const Arb slope = run(equation, 2)[1];
    slots_[slot].assign((*whole)[slot]);
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
  const ArbBox* const whole = seen_whole(box, std::nullopt);
  if (whole == nullptr) return std::nullopt;
  put(*whole);
  for (slong known = 1; known < length; ++known) {
    if (is_spent()) return std::nullopt;
    std::vector<Arb> next;
    for (std::size_t i = 0; i < equations_.size(); ++i) {
      const Arb slope = extend(i, known)[known - 1];
      if (equations_[i].smoothness() != Smoothness::analytic || !slope.is_finite()) return std::nullopt;
      next.push_back(slope / Arb(static_cast<double>(known)));
    }
    for (std::size_t i = 0; i < next.size(); ++i) slots_[variables_[i]].set(known, next[i]);
  }
  std::vector<ArbSeries> result;
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    result.push_back(slots_[variables_[i]]);
    result.back().set(0, box[variables_[i]]);
  }
  return result;
}

}  // namespace coordreq
