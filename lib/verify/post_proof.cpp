#include "verify/post_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "answers/checking/cell_location.hpp"
#include "spec/system_spec.hpp"
#include "verify/checks.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/map_extremes.hpp"
#include "verify/reference_posts.hpp"

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

constexpr std::size_t kCuts = 4;  ///< of each variable
/// A piece that has been cut so often and still does not fit is next to a point: more cuts are of no use to
/// it, only more steps, and without it the whole is not proven.
constexpr std::size_t kMostCuts = 40;

constexpr const char* kNoWorkLeft = "its share of the budget ended";

/// Moves the claims that are not proven elsewhere to what is left: those that are open there.
void leave(OpenSubbox& subbox, const std::vector<PostProof>& proofs, std::vector<OpenSubbox>& left) {
  OpenSubbox rest{.cuts = subbox.cuts, .claims = {}};
  std::erase_if(subbox.claims, [&](std::uint32_t c) {
    if (proofs[c].verdict == PostVerdict::open) rest.claims.push_back(c);
    return proofs[c].verdict != PostVerdict::holds;
  });
  if (!rest.claims.empty()) left.push_back(std::move(rest));
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

/// Proves pieces one after the other, and cuts those where something does not fit. One that may not be cut is
/// left, with all others for the claims that are open on it: these are not proven this time. The next time it
/// comes first, so that what has no chance costs one enclosure.
std::vector<PostProof> PostProver::prove(const SpanBox& box, const std::vector<PostClaim>& claims,
                                         std::vector<OpenSubbox>& subboxes, const PostEffort& effort,
                                         Work most, Work beyond) {
  const Work end = work() + most;
  const Work last = end + beyond;
  std::vector<PostProof> proofs(claims.size());
  std::vector<Piece> pending;
  for (auto subbox = subboxes.rbegin(); subbox != subboxes.rend(); ++subbox)
    pending.push_back(piece_of(box, std::move(*subbox)));
  subboxes.clear();
  for (int boxes = 1; !pending.empty(); ++boxes) {
    Piece piece = std::move(pending.back());
    pending.pop_back();
    leave(piece.subbox, proofs, subboxes);
    if (piece.subbox.claims.empty()) continue;
    if (work() >= last) {
      for (const std::uint32_t c : piece.subbox.claims) proofs[c] = {PostVerdict::open, kNoWorkLeft, true};
      leave(piece.subbox, proofs, subboxes);
      continue;
    }
    const bool has_cuts =
        boxes + static_cast<int>(pending.size()) < effort.most_boxes && piece.subbox.cuts.size() < kMostCuts;
    const bool may_cut = has_cuts && work() < end;
    std::vector<PostProof> results(claims.size());
    next_->limit_work(last - work());
    const std::optional<std::uint32_t> cut = prove_piece(piece, claims, effort.effort, results);
    std::erase_if(piece.subbox.claims, [&](std::uint32_t c) {
      const bool is_open = results[c].verdict == PostVerdict::open;
      if (is_open && next_->is_spent()) results[c].why = kNoWorkLeft;
      results[c].is_cut_off = is_open && (next_->is_spent() || (cut && has_cuts && !may_cut));
      if (results[c].verdict == PostVerdict::wrong || (is_open && !(may_cut && cut))) proofs[c] = results[c];
      return !is_open;
    });
    leave(piece.subbox, proofs, subboxes);
    if (piece.subbox.claims.empty()) continue;
    for (Piece& next : cut_pieces(piece, *cut)) pending.push_back(std::move(next));
  }
  return proofs;
}

void PostProver::cut_off(Piece& piece, std::uint32_t slot, Cut cut) const {
  const auto& slots = next_->divisible();
  const auto number = static_cast<std::size_t>(std::find(slots.begin(), slots.end(), slot) - slots.begin());
  ArbSpan& span = piece.box[slot];
  if (cut == Cut::lower_face) {
    span.upper = span.lower;
  } else if (cut == Cut::upper_face) {
    span.lower = span.upper;
  } else {
    const Arb middle = span.middle();
    (cut == Cut::lower_half ? span.upper : span.lower) = middle;
  }
  piece.subbox.cuts.push_back(static_cast<std::uint16_t>(kCuts * number + static_cast<std::size_t>(cut)));
}

PostProver::Piece PostProver::piece_of(const SpanBox& box, OpenSubbox subbox) const {
  Piece piece{box, {.cuts = {}, .claims = std::move(subbox.claims)}};
  for (const std::uint16_t code : subbox.cuts)
    cut_off(piece, next_->divisible()[code / kCuts], static_cast<Cut>(code % kCuts));
  return piece;
}

/// Faces of a piece where all extremes are on these, else its halves.
std::vector<PostProver::Piece> PostProver::cut_pieces(const Piece& piece, std::uint32_t cut) const {
  std::vector<Piece> subboxes;
  const auto add = [&](std::uint32_t slot, Cut kind) {
    subboxes.push_back(piece);
    cut_off(subboxes.back(), slot, kind);
  };
  if (next_->has_extremes_on_faces()) {
    for (const std::uint32_t slot : next_->divisible()) {
      add(slot, Cut::lower_face);
      add(slot, Cut::upper_face);
    }
  } else {
    add(cut, Cut::upper_half);
    add(cut, Cut::lower_half);
  }
  return subboxes;
}

/// @returns what to cut where something is open
std::optional<std::uint32_t> PostProver::prove_piece(Piece& piece, const std::vector<PostClaim>& claims,
                                                     const Effort& effort, std::vector<PostProof>& proofs) {
  const std::vector<std::uint32_t>& slots = next_->divisible();
  if (!next_->enclose(piece.box, effort)) {
    for (const std::uint32_t c : piece.subbox.claims) proofs[c] = {PostVerdict::open, "no bound was found"};
    return widest(piece.box, std::vector<double>(slots.size()));
  }
  std::vector<double> excess(slots.size());
  for (const std::uint32_t c : piece.subbox.claims) {
    const auto enough = [&](const Arb& lower, const Arb& upper) {
      return is_claimed(claims[c], lower, upper);
    };
    const Extremes extremes = next_->extremes(values_[claims[c].target], enough);
    proofs[c] = prove_claim(claims[c], extremes);
    if (proofs[c].verdict != PostVerdict::open) continue;
    for (const Extreme* extreme : {&extremes.least, &extremes.greatest}) {
      for (std::size_t j = 0; j < extreme->excess.size(); ++j) excess[j] += extreme->excess[j];
    }
  }
  return widest(piece.box, std::move(excess));
}

PostProof PostProver::prove_claim(const PostClaim& claim, const Extremes& extremes) const {
  const Arb& lower = extremes.least.bound;
  const Arb& upper = extremes.greatest.bound;
  if (is_claimed(claim, lower, upper)) return {};
  for (const Extreme* extreme : {&extremes.least, &extremes.greatest}) {
    if (std::optional<std::string> end = witness(claim, *extreme)) return {PostVerdict::wrong, *end};
  }
  if (!lower.is_finite() || !upper.is_finite()) return {PostVerdict::open, "no bound was found"};
  const IndexRange proven = cells_of(claim.target, lower, upper);
  return {PostVerdict::open, fmt::format("only {} is proven", range_text(target(claim.target), proven))};
}

bool PostProver::is_claimed(const PostClaim& claim, const Arb& lower, const Arb& upper) const {
  if (!lower.is_finite() || !upper.is_finite())
    return claim.range.first == INT32_MIN && claim.range.last == INT32_MAX;
  return holds(target(claim.target), claim.range, cells_of(claim.target, lower, upper));
}

/// The cells that meet values in a range, or if it is a difference by those from the cell with index 0.
IndexRange PostProver::cells_of(std::size_t i, const Arb& lower, const Arb& upper) const {
  const GridDimension& dimension = target(i);
  const Cells cells = spec_.abstraction.cells;
  const Rational least = lower.lower_rational();
  const Rational greatest = upper.upper_rational();
  if (!group_.shifts)
    return meeting_cells(dimension, cells, least - dimension.measurement_error,
                         greatest + dimension.measurement_error, true);
  const Rational reach = dimension.radius() + 2 * dimension.measurement_error;
  return meeting_cells(dimension, cells, dimension.first - reach + least, dimension.first + reach + greatest,
                       false);
}

/// A value is outside for certain if every closed cell that it may be in is.
bool PostProver::misses(const PostClaim& claim, const Rational& lower, const Rational& upper) const {
  const GridDimension& dimension = target(claim.target);
  const IndexRange cells = meeting_cells(dimension, Cells::closed, lower, upper, true);
  if (std::int64_t{cells.last} - cells.first > 3) return false;
  for (std::int64_t k = cells.first; k <= cells.last; ++k) {
    const auto cell = static_cast<std::int32_t>(k);
    if (holds(dimension, claim.range, {cell, cell})) return false;
  }
  return true;
}

std::optional<std::string> PostProver::witness(const PostClaim& claim, const Extreme& extreme) const {
  if (!extreme.attained || !extreme.attained->is_finite()) return std::nullopt;
  const GridDimension& dimension = target(claim.target);
  const Rational error = dimension.measurement_error;
  const Rational reach = group_.shifts ? Rational(dimension.radius() + 2 * error) : error;
  const Rational base = group_.shifts ? dimension.first : Rational(0);
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
    if (group_.shifts && name_of(spec_, slot) == dimension.name) continue;
    from += fmt::format("{}{} = {}", from.empty() ? "" : ", ", name_of(spec_, slot),
                        number_text(extreme.start[slot]));
  }
  return fmt::format("{}{} {} {}", from.empty() ? "" : "from " + from + " ", dimension.name,
                     group_.shifts ? "changes by" : "gets to", number_text(*extreme.attained));
}

/// The variable that adds most to the bounds; among equals the widest.
std::optional<std::uint32_t> PostProver::widest(const SpanBox& box, std::vector<double> excess) const {
  std::optional<std::uint32_t> result;
  double most = 0.0;
  for (std::size_t j = 0; j < excess.size(); ++j) {
    const std::uint32_t slot = next_->divisible()[j];
    const double value = excess[j] + 1e-6 * box[slot].width();
    if (value <= most || box[slot].width() <= 0.0) continue;
    most = value;
    result = slot;
  }
  return result;
}

}  // namespace coordreq
