#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "model/pieces.hpp"
#include "verify/check_tube.hpp"
#include "verify/piece_choices.hpp"
#include "verify/tube_bounds.hpp"

namespace coordreq {
namespace {

struct Effort {
  int parts;
  int halvings;
};
constexpr Effort kEfforts[] = {{1, 0}, {2, 1}, {4, 1}, {8, 3}, {16, 3}, {64, 6}};

class OutwardTubes {
 public:
  OutwardTubes(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs, std::size_t state,
               const PostTable& claimed)
      : spec_(spec),
        state_(state),
        target_(grid[state]),
        claimed_(claimed),
        influences_(influences_on(spec, state)),
        alike_(flows_alike(spec, influences_, state)),
        choices_(spec, grid, inputs, claimed, alike_ ? std::optional(state) : std::nullopt),
        slots_(spec.slot_count()),
        tally_(target_, claimed) {
    for (const std::size_t l : influences_.disturbances)
      slots_[spec.disturbance_slot(l)] = box_of(spec.disturbances[l].lower, spec.disturbances[l].upper);
    if (alike_) {
      const Rational reach = target_.radius() + target_.measurement_error;
      places_ = {{{target_.first - reach, target_.first + reach}}};
      slots_[spec.state_slot(state)] = {0.0, 0.0};
      return;
    }
    own_ = choices_.variable(spec.state_slot(state));
    for (std::int64_t k = 0; k < target_.count; ++k) places_.push_back(pieces(target_, k));
  }

  std::optional<TubeFinding> run(ThreadTeam& team) {
    if (has_stops(spec_, influences_) || jumps_on_the_way(spec_, influences_)) return std::nullopt;
    std::atomic<bool> enclosed = true;
    std::vector<std::unique_ptr<TubeBounds>> bounds(static_cast<std::size_t>(team.size()));
    team.for_each(choices_.size(), 64, [&](ThreadTeam::Range range, int worker) {
      auto& own = bounds[static_cast<std::size_t>(worker)];
      if (!own) own = std::make_unique<TubeBounds>(spec_, influences_, state_);
      Odometer choice(choices_.counts(), range.begin);
      for (std::int64_t i = range.begin; i < range.end && enclosed; ++i, choice.advance()) {
        if (!check(choice, *own)) enclosed = false;
      }
    });
    if (!enclosed) return std::nullopt;
    return tally_.finding(false);
  }

 private:
  bool check(const Odometer& choice, TubeBounds& bounds) {
    const std::int64_t position = choices_.position(choice);
    const std::int64_t entries = alike_ ? target_.count : 1;
    if (tally_.is_unbounded(position)) {
      for (std::int64_t k = 0; k < entries; ++k) tally_.add_unbounded();
      return true;
    }
    std::optional<std::vector<OwnTube>> own;
    for (const Effort& effort : kEfforts) {
      std::optional<std::vector<OwnTube>> next = tubes(choice, bounds, effort);
      if (next) own = std::move(next);
      if (own && tally_.is_enough(position, 0, *own)) break;
    }
    if (!own) return false;
    for (std::int64_t k = 0; k < entries; ++k)
      tally_.add(position + k * claimed_.state_stride[state_], k, *own);
    return true;
  }

  [[nodiscard]] std::optional<std::vector<OwnTube>> tubes(const Odometer& choice, TubeBounds& bounds,
                                                          const Effort& effort) const {
    std::vector<Interval> slots = slots_;
    std::vector<OwnTube> result;
    const bool enclosed = choices_.for_each_piece(choice, slots, [&](const Odometer& piece) {
      const std::optional<FlowTube> tube = bounds.over(slots, effort.parts, effort.halvings);
      if (tube) result.push_back(tube_from(*tube, place_of(choice, piece)));
      return tube.has_value();
    });
    if (!enclosed) return std::nullopt;
    return result;
  }

  [[nodiscard]] const Piece& place_of(const Odometer& choice, const Odometer& piece) const {
    if (alike_) return places_.front().front();
    return places_[static_cast<std::size_t>(choice[own_])][static_cast<std::size_t>(piece[own_])];
  }

  /// The initial place is known exactly, in doubles only nearly: what does not leave it on one side has its
  /// end there.
  [[nodiscard]] OwnTube tube_from(const FlowTube& tube, const Piece& place) const {
    Rational lower = place.lower + exact(tube.beyond.lower);
    Rational upper = place.upper + exact(tube.beyond.upper);
    // Values are those of the state itself, or of the difference to its beginning.
    const Rational base_lower = alike_ ? place.lower : Rational(0);
    const Rational base_upper = alike_ ? place.upper : Rational(0);
    lower = std::max(lower, Rational(base_lower + exact(tube.values.lower)));
    upper = std::min(upper, Rational(base_upper + exact(tube.values.upper)));
    Rational low = place.lower;
    Rational high = place.upper;
    // A little less, for boxes in doubles hold a little more than the cells.
    if (std::isfinite(tube.low))
      low = std::min(low, Rational(base_lower + exact(tube.low + margin(tube.low))));
    if (std::isfinite(tube.high))
      high = std::max(high, Rational(base_upper + exact(tube.high - margin(tube.high))));
    return {cells_covered(target_, std::min(lower, place.lower), std::max(upper, place.upper)),
            cells_covered(target_, low, high)};
  }

  [[nodiscard]] static double margin(double value) { return 1e-9 * (1.0 + std::fabs(value)); }

  const ProblemSpec& spec_;
  std::size_t state_;
  const GridDimension& target_;
  const PostTable& claimed_;
  Influences influences_;
  bool alike_;  ///< see flows_alike(): cells of the state itself are moved alike
  PieceChoices choices_;
  std::vector<Interval> slots_;
  TubeTally tally_;
  std::size_t own_ = 0;                     ///< among the variables of choices_
  std::vector<std::vector<Piece>> places_;  ///< [own index][piece]
};

}  // namespace

std::optional<TubeFinding> check_outward_tubes(const ProblemSpec& spec, const UniformGrid& grid,
                                               const InputSpace& inputs, std::size_t state,
                                               const PostTable& claimed, ThreadTeam& team) {
  return OutwardTubes(spec, grid, inputs, state, claimed).run(team);
}

}  // namespace coordreq
