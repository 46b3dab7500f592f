#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "answers/checking/cell_pieces.hpp"
#include "base/error.hpp"
#include "model/odometer.hpp"
#include "spec/system_spec.hpp"
#include "verify/check_tube.hpp"
#include "verify/parameter_choices.hpp"
#include "verify/reference_posts.hpp"

namespace coordreq {
namespace {

/// The amounts that one moving state adds to the value of the map: at the two ends of each piece of each of
/// its cells.
struct Contribution {
  struct Ends {
    Rational one;
    Rational other;
    bool attained = true;  ///< the greater one, from a cell without its upper end
  };
  std::size_t source = 0;
  Rational factor;
  bool cut = false;                      ///< at the seam
  const StoppedTerm* stopped = nullptr;  ///< instead of the factor
  std::vector<std::vector<Ends>> cells;  ///< [cell][piece], once they are needed
};

class CornerPosts {
 public:
  CornerPosts(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs, std::size_t state,
              const std::vector<std::int64_t>& cells)
      : spec_(spec),
        grid_(grid),
        inputs_(inputs),
        state_(state),
        target_(grid[state]),
        influences_(influences_on(spec, state)),
        table_(empty_table(grid, inputs, influences_, cells)),
        cells_(grid_, influences_, table_) {}

  std::optional<PostTable> run(ThreadTeam& team) {
    if (!fill_all(team)) return std::nullopt;
    for (IndexRange& range : table_.entries)
      range = with_measurements_at_limits(target_, spec_.abstraction.cells, range);
    return std::move(table_);
  }

  std::optional<PostTable> run_tubes(ThreadTeam& team) {
    are_tubes_ = true;
    if (target_.discrete || target_.periodic() || !row_of(influences_, state_) || !fill_all(team))
      return std::nullopt;
    return std::move(table_);
  }

 private:
  /// @returns whether the map is affine for all inputs and parameters
  bool fill_all(ThreadTeam& team) {
    const ParameterChoices choices(spec_, grid_, inputs_, influences_, table_);
    std::atomic<bool> affine = true;
    std::atomic<bool> exact = true;
    team.for_each(choices.size(), 1, [&](ThreadTeam::Range range, int) {
      Odometer choice(choices.counts(), range.begin);
      for (std::int64_t i = range.begin; i < range.end && affine; ++i, choice.advance()) {
        const std::optional<SampledMap> map = sampled_map(spec_, influences_, state_, choices.slots(choice));
        if (!map) {
          affine = false;
        } else {
          fill(*map, choices.position(choice));
          if (!map->exact) exact = false;
        }
      }
    });
    table_.exact = exact;
    return affine;
  }

  void fill(const SampledMap& map, std::int64_t base) {
    std::vector<Contribution> terms;
    const bool cut = jumps_at_a_seam(map);
    for (std::size_t j = 0; j < influences_.moving.size(); ++j) {
      // A state that others only move along goes round with its cell: that need not be cut at the seam.
      const std::size_t source = influences_.moving[j];
      const bool follows = source == state_ && map.coefficient[j] == 1;
      terms.push_back({source, map.coefficient[j], cut && !follows, nullptr, {}});
      terms.back().cells.resize(static_cast<std::size_t>(grid_[source].count));
    }
    for (const StoppedTerm& stopped : map.stopped) terms[stopped.moving].stopped = &stopped;
    cells_.for_each(base, std::nullopt, [&](const std::vector<std::int64_t>& cell, std::int64_t position) {
      table_.entries[*table_.find(position)] = are_tubes_ ? tube(map, terms, cell) : post(map, terms, cell);
    });
  }

  /// Equations see the representative in [lower, upper) of a periodic state, so that a value jumps at the
  /// seam, unless it is this state itself, turned a whole number of times.
  [[nodiscard]] bool jumps_at_a_seam(const SampledMap& map) const {
    for (std::size_t j = 0; j < influences_.moving.size(); ++j) {
      const std::size_t source = influences_.moving[j];
      const bool turns = source == state_ && is_integer(map.coefficient[j]);
      if (grid_[source].periodic() && map.coefficient[j] != 0 && !turns) return true;
    }
    return false;
  }

  const std::vector<Contribution::Ends>& ends_of(Contribution& term, std::int64_t k) const {
    auto& ends = term.cells[static_cast<std::size_t>(k)];
    if (!ends.empty()) return ends;
    const GridDimension& dimension = grid_[term.source];
    const Rational reach = dimension.radius() + dimension.measurement_error;
    const RationalInterval cell{.lower = dimension.point(k) - reach, .upper = dimension.point(k) + reach};
    if (term.stopped != nullptr) {
      ends.push_back(ends_of_stopped(dimension, *term.stopped, pieces_of(dimension, k).front(), cell.upper));
      return ends;
    }
    // The upper end of a half-open cell is not in it, so neither is the greatest value if that grows with it.
    const bool attained = !(term.factor > 0) || dimension.discrete;
    for (const RationalInterval& piece : term.cut ? pieces_of(dimension, k) : std::vector{cell})
      ends.push_back({Rational(term.factor * piece.lower), Rational(term.factor * piece.upper), attained});
    return ends;
  }

  /// @param uncut the upper end of the cell if there was no limit
  [[nodiscard]] Contribution::Ends ends_of_stopped(const GridDimension& dimension, const StoppedTerm& term,
                                                   const RationalInterval& piece,
                                                   const Rational& uncut) const {
    const Rational bottom = dimension.first;
    const Rational top = dimension.point(dimension.count - 1);
    const Rational& tau = spec_.dynamics.period;
    const TimePolynomial sum = term.response.integral();
    const auto from = [&](const Rational& start, const Rational& rate) {
      Rational moving = tau;
      if (rate < 0 && dimension.below == Outside::stop)
        moving = std::min(moving, Rational((bottom - start) / rate));
      if (rate > 0 && dimension.above == Outside::stop)
        moving = std::min(moving, Rational((top - start) / rate));
      return Rational(term.response.at(tau) * start + rate * (sum.at(tau) - sum.at(tau - moving)));
    };
    const Rational low = from(piece.lower, term.slowest);
    const Rational high = from(piece.upper, term.fastest);
    if (!term.rises) return {low, high, true};
    if (dimension.above == Outside::stop && uncut > top)
      return {low, high, true};  // the limit itself is in it
    // All that comes near the end of the cell may be held at the same limit, if it is v itself.
    const Rational end = piece.upper + term.fastest * tau;
    const bool held = (dimension.below == Outside::stop && end <= bottom) ||
                      (dimension.above == Outside::stop && end > top);
    return {low, high, held && term.response.is_one()};
  }

  /// The cells reached from all pieces of one cell.
  [[nodiscard]] IndexRange post(const SampledMap& map, std::vector<Contribution>& terms,
                                const std::vector<std::int64_t>& cell) const {
    std::vector<const std::vector<Contribution::Ends>*> ends;
    std::vector<std::int64_t> counts;
    for (std::size_t j = 0; j < terms.size(); ++j) {
      ends.push_back(&ends_of(terms[j], cell[j]));
      counts.push_back(static_cast<std::int64_t>(ends.back()->size()));
    }
    std::optional<IndexRange> range;
    Odometer piece(counts);
    do {
      std::vector<const Contribution::Ends*> box;
      for (std::size_t j = 0; j < ends.size(); ++j)
        box.push_back(&(*ends[j])[static_cast<std::size_t>(piece[j])]);
      const IndexRange next = cells_from(map, box);
      range = range ? both_of(*range, next, target_) : next;
    } while (piece.advance());
    return *range;
  }

  [[nodiscard]] IndexRange tube(const SampledMap& map, std::vector<Contribution>& terms,
                                const std::vector<std::int64_t>& cell) const {
    const std::size_t row = row_of(influences_, state_).value();
    if (!map.rate || !map.exact || (terms[row].stopped == nullptr && !keeps_direction(map, terms, cell)))
      return kUnknownTube;
    std::vector<const Contribution::Ends*> box;
    for (std::size_t j = 0; j < terms.size(); ++j) {
      const auto& ends = ends_of(terms[j], cell[j]);
      if (ends.size() > 1) return kUnknownTube;
      box.push_back(&ends.front());
    }
    const RationalInterval end = hull_of_corners(box);
    const RationalInterval start = pieces_of(target_, cell[row]).front();
    return cells_needed(target_, std::min(start.lower, Rational(end.lower + map.lower)),
                        std::max(start.upper, Rational(end.upper + map.upper)));
  }

  /// Whether the derivative has one sign, wherever the states that are stopped can be during the period.
  [[nodiscard]] bool keeps_direction(const SampledMap& map, const std::vector<Contribution>& terms,
                                     const std::vector<std::int64_t>& cell) const {
    Rational least = map.rate->slowest, greatest = map.rate->fastest;
    for (std::size_t j = 0; j < terms.size(); ++j) {
      const Rational& slope = map.rate->slope[j];
      if (slope == 0) continue;
      if (terms[j].stopped == nullptr) return false;
      const GridDimension& dimension = grid_[terms[j].source];
      RationalInterval range = pieces_of(dimension, cell[j]).front();
      const Rational& tau = spec_.dynamics.period;
      range.lower = std::min(range.lower, Rational(range.lower + terms[j].stopped->slowest * tau));
      range.upper = std::max(range.upper, Rational(range.upper + terms[j].stopped->fastest * tau));
      if (dimension.below == Outside::stop) range.lower = std::max(range.lower, dimension.first);
      if (dimension.above == Outside::stop)
        range.upper = std::min(range.upper, dimension.point(dimension.count - 1));
      least += slope > 0 ? slope * range.lower : slope * range.upper;
      greatest += slope > 0 ? slope * range.upper : slope * range.lower;
    }
    return least >= 0 || greatest <= 0;
  }

  [[nodiscard]] IndexRange cells_from(const SampledMap& map,
                                      const std::vector<const Contribution::Ends*>& box) const {
    const bool attained =
        !map.exact ||
        std::all_of(box.begin(), box.end(), [](const Contribution::Ends* ends) { return ends->attained; });
    const RationalInterval hull = hull_of_corners(box);
    const Rational &least = hull.lower, &greatest = hull.upper;
    const Rational error = target_.measurement_error;
    if (target_.discrete) return index_of(least + map.lower, greatest + map.upper);
    return meeting_cells(target_, spec_.abstraction.cells, least + map.lower - error,
                         greatest + map.upper + error, attained);
  }

  [[nodiscard]] static RationalInterval hull_of_corners(const std::vector<const Contribution::Ends*>& box) {
    Rational least = 0;
    Rational greatest = 0;
    for (std::uint64_t corner = 0; corner < std::uint64_t{1} << box.size(); ++corner) {
      Rational value = 0;
      for (std::size_t j = 0; j < box.size(); ++j)
        value += (corner >> j & 1U) != 0 ? box[j]->one : box[j]->other;
      if (corner == 0 || value < least) least = value;
      if (corner == 0 || value > greatest) greatest = value;
    }
    return {.lower = least, .upper = greatest};
  }

  [[nodiscard]] IndexRange index_of(const Rational& lower, const Rational& upper) const {
    const Rational index = (lower - target_.first) / target_.step;
    if (lower != upper || !is_integer(index)) {
      throw SpecError(fmt::format("the discrete state '{}' can leave its grid", target_.name),
                      "/dynamics/equations/" + target_.name);
    }
    const std::int64_t k = floor_to_int(index);
    return cut_to_range(target_, k, k);
  }

  const SystemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  std::size_t state_;
  const GridDimension& target_;
  Influences influences_;
  PostTable table_;
  CellsOfTable cells_;
  bool are_tubes_ = false;
};

}  // namespace

std::optional<PostTable> corner_posts(const SystemSpec& spec, const UniformGrid& grid,
                                      const InputSpace& inputs, std::size_t state,
                                      const std::vector<std::int64_t>& cells, ThreadTeam& team) {
  return CornerPosts(spec, grid, inputs, state, cells).run(team);
}

std::optional<PostTable> tubes_between_ends(const SystemSpec& spec, const UniformGrid& grid,
                                            const InputSpace& inputs, std::size_t state,
                                            const std::vector<std::int64_t>& cells, ThreadTeam& team) {
  return CornerPosts(spec, grid, inputs, state, cells).run_tubes(team);
}

}  // namespace coordreq
