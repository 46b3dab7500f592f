#include "verify/post_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "answers/checking/cell_place.hpp"
#include "spec/system_spec.hpp"
#include "verify/check_abstraction.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/map_extremes.hpp"
#include "verify/own_posts.hpp"

namespace coordreq {
namespace {

std::string number_text(const Arb& value) {
  return fmt::format("{:.6g}", value.approximately());
}

const std::string& name_of(const SystemSpec& spec, std::uint32_t slot) {
  if (slot < spec.states.size()) return spec.states[slot].name;
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    if (spec.disturbance_slot(l) == slot) return spec.disturbances[l].name;
  }
  return spec.inputs[slot - spec.states.size()].name;
}

/// The next values of a group, of a map or a flow, whichever the spec has.
std::unique_ptr<NextValue> next_values_of(const SystemSpec& spec, const UniformGrid& grid,
                                          const PostGroup& group) {
  if (spec.dynamics.time == Time::discrete)
    return std::make_unique<MapExtremes>(spec, group.influences, group.states.front());
  double step = grid[group.states.front()].step.get_d();
  for (const std::size_t i : group.states) step = std::min(step, grid[i].step.get_d());
  return std::make_unique<FlowExtremes>(spec, group.influences, step);
}

}  // namespace

PostProver::PostProver(const SystemSpec& spec, const UniformGrid& grid, const PostGroup& group)
    : spec_(spec), grid_(grid), group_(group), next_(next_values_of(spec, grid, group)) {
  const bool is_map = spec.dynamics.time == Time::discrete;
  for (const std::size_t i : group.states)
    values_.push_back(is_map ? 0 : row_of(group.influences, i).value_or(0));
}

/// Pieces are proven one after the other; only those where something does not fit are cut.
std::vector<PostProof> PostProver::prove(const SpanBox& box, const std::vector<PostClaim>& claims,
                                         const PostEffort& effort, Work most) {
  const Work end = work() + most;
  std::vector<PostProof> proofs(claims.size());
  std::vector<Piece> pending = {{box, std::vector<std::size_t>(claims.size())}};
  std::iota(pending.front().claims.begin(), pending.front().claims.end(), std::size_t{0});
  for (int boxes = 1; !pending.empty(); ++boxes) {
    Piece piece = std::move(pending.back());
    pending.pop_back();
    // Claims that are lost already need no more work.
    std::erase_if(piece.claims, [&](std::size_t c) { return proofs[c].verdict != PostVerdict::holds; });
    if (piece.claims.empty()) continue;
    const bool may_cut = boxes + static_cast<int>(pending.size()) < effort.most_boxes && work() < end;
    std::vector<PostProof> own(claims.size());
    const std::optional<std::uint32_t> cut = prove_piece(piece, claims, effort.effort, own);
    std::erase_if(piece.claims, [&](std::size_t c) {
      const bool is_open = own[c].verdict == PostVerdict::open;
      if (own[c].verdict == PostVerdict::wrong || (is_open && !(may_cut && cut))) proofs[c] = own[c];
      return !is_open;
    });
    if (piece.claims.empty() || !may_cut || !cut) continue;
    for (Piece& part : parts_of(piece, *cut)) pending.push_back(std::move(part));
  }
  return proofs;
}

/// Faces of a piece where all extremes are on these, else its halves.
std::vector<PostProver::Piece> PostProver::parts_of(const Piece& piece, std::uint32_t cut) const {
  std::vector<Piece> parts;
  const auto add = [&](std::uint32_t slot, const Arb& lower, const Arb& upper) {
    parts.push_back(piece);
    parts.back().box[slot] = {lower, upper};
  };
  if (next_->has_extremes_on_faces()) {
    for (const std::uint32_t slot : next_->divisible()) {
      add(slot, piece.box[slot].lower, piece.box[slot].lower);
      add(slot, piece.box[slot].upper, piece.box[slot].upper);
    }
  } else {
    const ArbSpan& whole = piece.box[cut];
    add(cut, whole.middle(), whole.upper);
    add(cut, whole.lower, whole.middle());
  }
  return parts;
}

/// @returns what to cut where something is open
std::optional<std::uint32_t> PostProver::prove_piece(Piece& piece, const std::vector<PostClaim>& claims,
                                                     const Effort& effort, std::vector<PostProof>& proofs) {
  const std::vector<std::uint32_t>& slots = next_->divisible();
  if (!next_->enclose(piece.box, effort)) {
    for (const std::size_t c : piece.claims) proofs[c] = {PostVerdict::open, "no bound was found"};
    return widest(piece.box, std::vector<double>(slots.size()));
  }
  std::vector<double> excess(slots.size());
  for (const std::size_t c : piece.claims) {
    const auto enough = [&](const Arb& lower, const Arb& upper) {
      return is_claimed(claims[c], lower, upper);
    };
    const Extremes found = next_->extremes(values_[claims[c].target], enough);
    proofs[c] = prove_claim(claims[c], found);
    if (proofs[c].verdict != PostVerdict::open) continue;
    for (const Extreme* extreme : {&found.least, &found.greatest}) {
      for (std::size_t j = 0; j < extreme->excess.size(); ++j) excess[j] += extreme->excess[j];
    }
  }
  return widest(piece.box, std::move(excess));
}

PostProof PostProver::prove_claim(const PostClaim& claim, const Extremes& found) const {
  const Arb& lower = found.least.bound;
  const Arb& upper = found.greatest.bound;
  if (is_claimed(claim, lower, upper)) return {};
  for (const Extreme* extreme : {&found.least, &found.greatest}) {
    if (std::optional<std::string> end = witness(claim, *extreme)) return {PostVerdict::wrong, *end};
  }
  if (!lower.is_finite() || !upper.is_finite()) return {PostVerdict::open, "no bound was found"};
  const IndexRange own = cells_of(claim.target, lower, upper);
  return {PostVerdict::open, fmt::format("only {} is proven", range_text(target(claim.target), own))};
}

bool PostProver::is_claimed(const PostClaim& claim, const Arb& lower, const Arb& upper) const {
  if (!lower.is_finite() || !upper.is_finite())
    return claim.range.first == INT32_MIN && claim.range.last == INT32_MAX;
  return holds(target(claim.target), claim.range, cells_of(claim.target, lower, upper));
}

/// The cells met by values in a range, or if it is a difference by those from the cell with index 0.
IndexRange PostProver::cells_of(std::size_t i, const Arb& lower, const Arb& upper) const {
  const GridDimension& own = target(i);
  const Cells cells = spec_.abstraction.cells;
  const Rational least = lower.lower_rational();
  const Rational greatest = upper.upper_rational();
  if (!group_.shifts)
    return cells_met(own, cells, least - own.measurement_error, greatest + own.measurement_error, true);
  const Rational reach = own.radius() + 2 * own.measurement_error;
  return cells_met(own, cells, own.first - reach + least, own.first + reach + greatest, false);
}

/// A value is outside for certain if every closed cell that it may be in is.
bool PostProver::misses(const PostClaim& claim, const Rational& lower, const Rational& upper) const {
  const GridDimension& own = target(claim.target);
  const IndexRange met = cells_met(own, Cells::closed, lower, upper, true);
  if (std::int64_t{met.last} - met.first > 3) return false;
  for (std::int64_t k = met.first; k <= met.last; ++k) {
    const auto cell = static_cast<std::int32_t>(k);
    if (holds(own, claim.range, {cell, cell})) return false;
  }
  return true;
}

std::optional<std::string> PostProver::witness(const PostClaim& claim, const Extreme& extreme) const {
  if (!extreme.attained || !extreme.attained->is_finite()) return std::nullopt;
  const GridDimension& own = target(claim.target);
  const Rational error = own.measurement_error;
  const Rational reach = group_.shifts ? Rational(own.radius() + 2 * error) : error;
  const Rational base = group_.shifts ? own.first : Rational(0);
  const Rational lower = base + extreme.attained->lower_rational();
  const Rational upper = base + extreme.attained->upper_rational();
  if (!misses(claim, lower - reach, upper - reach) && !misses(claim, lower + reach, upper + reach))
    return std::nullopt;
  std::vector<std::uint32_t> named = next_->divisible();
  for (std::size_t l = 0; l < spec_.disturbances.size(); ++l) {
    const std::uint32_t slot = spec_.disturbance_slot(l);
    if (std::find(named.begin(), named.end(), slot) == named.end()) named.push_back(slot);
  }
  std::string from;
  for (const std::uint32_t slot : named) {
    if (group_.shifts && name_of(spec_, slot) == own.name) continue;
    from += fmt::format("{}{} = {}", from.empty() ? "" : ", ", name_of(spec_, slot),
                        number_text(extreme.start[slot]));
  }
  return fmt::format("{}{} {} {}", from.empty() ? "" : "from " + from + " ", own.name,
                     group_.shifts ? "changes by" : "gets to", number_text(*extreme.attained));
}

/// The variable that adds most to the bounds; among equals the widest.
std::optional<std::uint32_t> PostProver::widest(const SpanBox& box, std::vector<double> excess) const {
  std::optional<std::uint32_t> result;
  double most = 0.0;
  for (std::size_t j = 0; j < excess.size(); ++j) {
    const std::uint32_t slot = next_->divisible()[j];
    const double own = excess[j] + 1e-6 * box[slot].width();
    if (own <= most || box[slot].width() <= 0.0) continue;
    most = own;
    result = slot;
  }
  return result;
}

}  // namespace coordreq
