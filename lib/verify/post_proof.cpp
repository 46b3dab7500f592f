#include "verify/post_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "verify/cell_place.hpp"
#include "verify/check_abstraction.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/map_extremes.hpp"

namespace coordreq {
namespace {

std::string number_text(const Arb& value) {
  return fmt::format("{:.6g}", value.approximately());
}

const std::string& name_of(const ProblemSpec& spec, std::uint32_t slot) {
  if (slot < spec.states.size()) return spec.states[slot].name;
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    if (spec.disturbance_slot(l) == slot) return spec.disturbances[l].name;
  }
  return spec.inputs[slot - spec.states.size()].name;
}

}  // namespace

PostProver::PostProver(const ProblemSpec& spec, const GridDimension& target, std::unique_ptr<NextValue> next,
                       bool shifts)
    : spec_(spec), target_(target), next_(std::move(next)), shifts_(shifts) {}

/// Pieces are proven one after the other; only those that do not fit are cut.
PostProof PostProver::prove(const SpanBox& box, IndexRange claimed, const PostEffort& effort,
                            Budget::Clock::time_point end) {
  claimed_ = claimed;
  std::vector<SpanBox> pending = {box};
  for (int boxes = 1; !pending.empty(); ++boxes) {
    SpanBox piece = std::move(pending.back());
    pending.pop_back();
    std::optional<std::uint32_t> cut;
    PostProof proof = prove_piece(piece, effort.effort, cut);
    if (proof.verdict == PostVerdict::holds) continue;
    if (proof.verdict == PostVerdict::wrong || !cut) return proof;
    if (boxes + static_cast<int>(pending.size()) >= effort.most_boxes || Budget::Clock::now() >= end)
      return proof;
    SpanBox half = piece;
    half[*cut].upper = piece[*cut].middle();
    piece[*cut].lower = half[*cut].upper;
    pending.push_back(std::move(piece));
    pending.push_back(std::move(half));
  }
  return {};
}

PostProof PostProver::prove_piece(const SpanBox& box, const Effort& effort,
                                  std::optional<std::uint32_t>& cut) {
  const auto enough = [this](const Arb& lower, const Arb& upper) { return is_claimed(lower, upper); };
  const std::optional<Extremes> found = next_->extremes(box, effort, enough);
  if (!found) {
    cut = widest(box, {});
    return {PostVerdict::open, "no bound was found"};
  }
  if (is_claimed(found->least.bound, found->greatest.bound)) return {};
  for (const Extreme* extreme : {&found->least, &found->greatest}) {
    if (std::optional<std::string> end = witness(*extreme)) return {PostVerdict::wrong, *end};
  }
  cut = widest(box, *found);
  return {PostVerdict::open, proven_text(*found)};
}

bool PostProver::is_claimed(const Arb& lower, const Arb& upper) const {
  if (!lower.is_finite() || !upper.is_finite())
    return claimed_.first == INT32_MIN && claimed_.last == INT32_MAX;
  return holds(target_, claimed_, cells_of(lower, upper, false));
}

/// The cells met by values in a range, or if it is a difference by those from the cell with index 0.
IndexRange PostProver::cells_of(const Arb& lower, const Arb& upper, bool closed) const {
  const Rational& error = target_.measurement_error;
  const Cells cells = closed ? Cells::closed : spec_.abstraction.cells;
  if (!shifts_)
    return cells_met(target_, cells, lower.lower_rational() - error, upper.upper_rational() + error, true);
  const Rational reach = target_.radius() + 2 * error;
  return cells_met(target_, cells, target_.first - reach + lower.lower_rational(),
                   target_.first + reach + upper.upper_rational(), false);
}

/// A value is outside for certain if every closed cell that it may be in is.
bool PostProver::misses(const Rational& lower, const Rational& upper) const {
  const IndexRange met = cells_met(target_, Cells::closed, lower, upper, true);
  if (std::int64_t{met.last} - met.first > 3) return false;
  for (std::int64_t k = met.first; k <= met.last; ++k) {
    const auto cell = static_cast<std::int32_t>(k);
    if (holds(target_, claimed_, {cell, cell})) return false;
  }
  return true;
}

std::optional<std::string> PostProver::witness(const Extreme& extreme) const {
  if (!extreme.attained || !extreme.attained->is_finite()) return std::nullopt;
  const Rational lower = extreme.attained->lower_rational();
  const Rational upper = extreme.attained->upper_rational();
  const Rational reach =
      shifts_ ? Rational(target_.radius() + 2 * target_.measurement_error) : target_.measurement_error;
  const Rational base = shifts_ ? target_.first : Rational(0);
  if (!misses(base + lower - reach, base + upper - reach) &&
      !misses(base + lower + reach, base + upper + reach))
    return std::nullopt;
  std::string from;
  for (const std::uint32_t slot : next_->divisible()) {
    if (shifts_ && name_of(spec_, slot) == target_.name) continue;
    from += fmt::format("{}{} = {}", from.empty() ? "" : ", ", name_of(spec_, slot),
                        number_text(extreme.start[slot]));
  }
  for (std::size_t l = 0; l < spec_.disturbances.size(); ++l) {
    const std::uint32_t slot = spec_.disturbance_slot(l);
    const std::vector<std::uint32_t>& named = next_->divisible();
    if (std::find(named.begin(), named.end(), slot) != named.end()) continue;
    from += fmt::format("{}{} = {}", from.empty() ? "" : ", ", spec_.disturbances[l].name,
                        number_text(extreme.start[slot]));
  }
  return fmt::format("{}{} {} {}", from.empty() ? "" : "from " + from + " ", target_.name,
                     shifts_ ? "changes by" : "gets to", number_text(*extreme.attained));
}

std::optional<std::uint32_t> PostProver::widest(const SpanBox& box, const Extremes& extremes) const {
  std::optional<std::uint32_t> result;
  double most = 0.0;
  const std::vector<std::uint32_t>& slots = next_->divisible();
  for (std::size_t j = 0; j < slots.size(); ++j) {
    double excess = 1e-6 * box[slots[j]].width();
    for (const Extreme* extreme : {&extremes.least, &extremes.greatest}) {
      if (j < extreme->excess.size()) excess += extreme->excess[j];
    }
    if (excess <= most || box[slots[j]].width() <= 0.0) continue;
    most = excess;
    result = slots[j];
  }
  return result;
}

std::string PostProver::proven_text(const Extremes& extremes) const {
  if (!extremes.least.bound.is_finite() || !extremes.greatest.bound.is_finite()) return "no bound was found";
  const IndexRange own = cells_of(extremes.least.bound, extremes.greatest.bound, false);
  return fmt::format("only {} is proven", range_text(target_, own));
}

std::unique_ptr<NextValue> next_value_of(const ProblemSpec& spec, const Influences& influences,
                                         std::size_t state, const GridDimension& target) {
  if (spec.dynamics.time == Time::discrete) return std::make_unique<MapExtremes>(spec, influences, state);
  return std::make_unique<FlowExtremes>(spec, influences, state, target.step.get_d());
}

}  // namespace coordreq
