#include <algorithm>
#include <atomic>
#include <utility>

#include "answers/checking/cell_pieces.hpp"
#include "model/odometer.hpp"
#include "spec/system_spec.hpp"
#include "verify/check_tube.hpp"
#include "verify/parameter_choices.hpp"
#include "verify/sampled_map.hpp"

namespace coordreq {
namespace {

/// The amounts that one moving state adds, from both ends of each piece of its cells, in units of the
/// target's step.
struct TimedTerm {
  struct Ends {
    TimePolynomial lower;
    TimePolynomial upper;
  };
  int sign = 0;  ///< of the coefficient all the time; 0: both ends can be the extreme
  std::size_t source = 0;
  TimePolynomial factor;                 ///< in steps
  bool cut = false;                      ///< at the seam
  std::vector<std::vector<Ends>> cells;  ///< [cell][piece], once they are needed
};

/// The tubes of all cells for one choice of inputs and parameters.
class CornerTubes {
 public:
  CornerTubes(const SystemSpec& spec, const UniformGrid& grid, const Influences& influences,
              std::size_t state, const PostTable& claimed, TubeTally& tally)
      : grid_(grid),
        influences_(influences),
        state_(state),
        target_(grid[state]),
        claimed_(claimed),
        cells_(grid, influences, claimed),
        tau_(spec.dynamics.period),
        tally_(tally) {}

  void check(const TimedMap& map, std::int64_t base) {
    find_terms(map);
    const auto left_out = follows_ ? std::optional(state_) : std::nullopt;
    cells_.for_each(base, left_out, [&](const std::vector<std::int64_t>& cell, std::int64_t first) {
      const std::vector<TubeBounds> bounds = tubes(map, cell);
      for (std::int64_t k = 0; k < (follows_ ? target_.count : 1); ++k) {
        const std::int64_t position = first + k * claimed_.state_stride[state_];
        if (claimed_.find(position)) tally_.add(position, k, bounds);
      }
    });
  }

 private:
  void find_terms(const TimedMap& map) {
    const bool cut = crosses_a_seam(map);
    follows_ = false;
    terms_.clear();
    for (std::size_t j = 0; j < influences_.moving.size(); ++j) {
      const std::size_t source = influences_.moving[j];
      const bool follows = source == state_ && map.coefficient[j].is_one();
      follows_ = follows_ || follows;
      terms_.push_back({sign_on(map.coefficient[j], tau_),
                        source,
                        map.coefficient[j] * (1 / target_.step),
                        cut && !follows,
                        {}});
      terms_.back().cells.resize(static_cast<std::size_t>(grid_[source].count));
    }
  }

  /// Values jump at the seam, unless they are this state itself all the time.
  [[nodiscard]] bool crosses_a_seam(const TimedMap& map) const {
    for (std::size_t j = 0; j < influences_.moving.size(); ++j) {
      const std::size_t source = influences_.moving[j];
      const TimePolynomial& factor = map.coefficient[j];
      if (grid_[source].periodic() && !(source == state_ ? factor.is_one() : factor.is_zero())) return true;
    }
    return false;
  }

  const std::vector<TimedTerm::Ends>& ends_of(TimedTerm& term, std::int64_t k) const {
    auto& ends = term.cells[static_cast<std::size_t>(k)];
    if (!ends.empty()) return ends;
    const GridDimension& dimension = grid_[term.source];
    const Rational reach = dimension.radius() + dimension.measurement_error;
    std::vector<RationalInterval> pieces = {{dimension.point(k) - reach, dimension.point(k) + reach}};
    if (term.cut) pieces = pieces_of(dimension, k);
    for (const RationalInterval& piece : pieces)
      ends.push_back({term.factor * piece.lower, term.factor * piece.upper});
    return ends;
  }

  [[nodiscard]] std::vector<TubeBounds> tubes(const TimedMap& map, const std::vector<std::int64_t>& cell) {
    std::vector<std::int64_t> counts;
    for (std::size_t j = 0; j < terms_.size(); ++j)
      counts.push_back(static_cast<std::int64_t>(ends_of(terms_[j], cell[j]).size()));
    std::vector<TubeBounds> result;
    Odometer piece(counts);
    do {
      std::vector<const TimedTerm::Ends*> box;
      for (std::size_t j = 0; j < terms_.size(); ++j) {
        box.push_back(
            &terms_[j].cells[static_cast<std::size_t>(cell[j])][static_cast<std::size_t>(piece[j])]);
      }
      result.push_back(tube_from(map, box));
    } while (piece.advance());
    return result;
  }

  [[nodiscard]] TubeBounds tube_from(const TimedMap& map,
                                     const std::vector<const TimedTerm::Ends*>& box) const {
    const FloorOfLeast first = least_at_corners(map, box, false);
    const FloorOfLeast last = least_at_corners(map, box, true);
    const auto range = [](std::int64_t low, std::int64_t high) {
      return IndexRange{saturate_index(low), saturate_index(high)};
    };
    return TubeBounds::of(range(first.outer, -last.outer), range(first.inner, -last.inner));
  }

  /// floor of the least value in steps plus the reach of a cell; of all values negated if `upper`.
  [[nodiscard]] FloorOfLeast least_at_corners(const TimedMap& map,
                                              const std::vector<const TimedTerm::Ends*>& box,
                                              bool upper) const {
    std::vector<std::size_t> open;
    TimePolynomial fixed = {cell_reach(upper)};
    for (std::size_t j = 0; j < box.size(); ++j) {
      if (terms_[j].sign == 0) {
        open.push_back(j);
      } else {
        fixed += (terms_[j].sign > 0) == upper ? box[j]->upper : box[j]->lower;
      }
    }
    std::optional<FloorOfLeast> least;
    for (std::uint64_t corner = 0; corner < std::uint64_t{1} << open.size(); ++corner) {
      TimePolynomial value = fixed;
      for (std::size_t c = 0; c < open.size(); ++c)
        value += (corner >> c & 1U) != 0 ? box[open[c]]->upper : box[open[c]]->lower;
      const FloorOfLeast next = least_of(map, value, upper);
      if (!least) least = next;
      *least = {std::min(least->outer, next.outer), std::min(least->inner, next.inner)};
    }
    return *least;
  }

  /// Such that floor, or ceil of `upper` values, tells the cell that covers the value.
  [[nodiscard]] Rational cell_reach(bool upper) const {
    const Rational reach = target_.radius() + target_.measurement_error;
    return ((upper ? Rational(-reach) : reach) - target_.first) / target_.step;
  }

  [[nodiscard]] FloorOfLeast least_of(const TimedMap& map, const TimePolynomial& value, bool upper) const {
    FloorOfLeast least = least_with(value, upper ? map.upper : map.lower, upper);
    if (map.exact) return least;
    least.inner = floor_to_int(upper ? Rational(-value[0]) : value[0]);  // it begins there
    for (const TimePolynomial& rest : map.attained)
      least.inner = std::min(least.inner, least_with(value, rest, upper).inner);
    return least;
  }

  [[nodiscard]] FloorOfLeast least_with(const TimePolynomial& value, const TimePolynomial& rest,
                                        bool upper) const {
    TimePolynomial sum = value;
    sum += rest * (1 / target_.step);
    return floor_of_least(upper ? sum * -1 : sum, tau_);
  }

  const UniformGrid& grid_;
  const Influences& influences_;
  std::size_t state_;
  const GridDimension& target_;
  const PostTable& claimed_;
  CellsOfTable cells_;
  const Rational& tau_;
  TubeTally& tally_;
  std::vector<TimedTerm> terms_;
  bool follows_ = false;  ///< the cells of the state itself are moved alike
};

}  // namespace

std::optional<TubeFinding> check_corner_tubes(const PostQuestion& question, ThreadTeam& team) {
  const SystemSpec& spec = *question.spec;
  const UniformGrid& grid = *question.grid;
  const PostTable& claimed = *question.claimed;
  const Influences influences = influences_on(spec, question.state);
  const ParameterChoices choices(spec, grid, *question.inputs, influences, claimed);
  TubeTally tally(question);
  std::atomic<bool> solved = true;
  team.for_each(choices.size(), 1, [&](ThreadTeam::Range range, int) {
    CornerTubes tubes(spec, grid, influences, question.state, claimed, tally);
    Odometer choice(choices.counts(), range.begin);
    for (std::int64_t i = range.begin; i < range.end && solved; ++i, choice.advance()) {
      const std::optional<TimedMap> map = timed_map(spec, influences, question.state, choices.slots(choice));
      if (map) {
        tubes.check(*map, choices.position(choice));
      } else {
        solved = false;
      }
    }
  });
  if (!solved) return std::nullopt;
  return tally.finding(true);
}

}  // namespace coordreq
