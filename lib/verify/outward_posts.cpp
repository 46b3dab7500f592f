#include "verify/outward_posts.hpp"

#include <algorithm>
#include <atomic>
#include <memory>

#include "model/pieces.hpp"
#include "verify/check_abstraction.hpp"
#include "verify/flow_bounds.hpp"
#include "verify/map_bounds.hpp"
#include "verify/odometer.hpp"
#include "verify/piece_choices.hpp"

namespace coordreq {
namespace {

constexpr int kMostHalvings = 6;

/// Encloses a map or a flow, whichever the spec has.
class Bounds {
 public:
  Bounds(const ProblemSpec& spec, const Influences& influences, std::size_t state) {
    if (spec.dynamics.time == Time::continuous) {
      flow_ = std::make_unique<FlowBounds>(spec, influences, state);
      return;
    }
    std::vector<std::uint32_t> variables;
    for (const std::size_t j : influences.moving) variables.push_back(spec.state_slot(j));
    for (const std::size_t l : influences.disturbances) variables.push_back(spec.disturbance_slot(l));
    map_ = std::make_unique<MapBounds>(spec.dynamics.equations[state], variables);
  }

  [[nodiscard]] std::optional<Interval> operator()(const std::vector<Interval>& slots, int halvings) {
    return flow_ ? flow_->after_period(slots, halvings) : map_->over(slots, halvings);
  }
  [[nodiscard]] MapBounds& map() { return *map_; }

 private:
  std::unique_ptr<FlowBounds> flow_;
  std::unique_ptr<MapBounds> map_;
};

class OutwardPosts {
 public:
  OutwardPosts(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs, std::size_t state,
               const PostTable& claimed)
      : spec_(spec),
        grid_(grid),
        inputs_(inputs),
        state_(state),
        target_(grid[state]),
        claimed_(claimed),
        influences_(influences_on(spec, state)),
        table_(empty_table(grid, inputs, influences_)),
        slots_(spec.slot_count()) {
    table_.exact = false;
    for (const std::size_t l : influences_.disturbances)
      slots_[spec.disturbance_slot(l)] = box_of(spec.disturbances[l].lower, spec.disturbances[l].upper);
  }

  std::optional<PostTable> run(ThreadTeam& team) {
    if (has_stops(spec_, influences_) || jumps_on_the_way(spec_, influences_) ||
        claimed_.entries.size() != table_.entries.size())
      return std::nullopt;
    shifts_ = follows_itself();
    const PieceChoices choices(spec_, grid_, inputs_, table_, shifts_ ? std::optional(state_) : std::nullopt);
    std::atomic<bool> enclosed = true;
    std::vector<std::unique_ptr<Bounds>> bounds(static_cast<std::size_t>(team.size()));
    team.for_each(choices.size(), 64, [&](ThreadTeam::Range range, int worker) {
      auto& own = bounds[static_cast<std::size_t>(worker)];
      if (!own) own = std::make_unique<Bounds>(spec_, influences_, state_);
      Odometer choice(choices.counts(), range.begin);
      for (std::int64_t i = range.begin; i < range.end && enclosed; ++i, choice.advance()) {
        if (!fill(choices, choice, *own)) enclosed = false;
      }
    });
    if (!enclosed) return std::nullopt;
    add_measurements_at_limits(target_, spec_.abstraction.cells, table_);
    return std::move(table_);
  }

 private:
  /// The next value is the present one and something that does not depend on it.
  [[nodiscard]] bool follows_itself() const {
    const std::uint32_t own = spec_.state_slot(state_);
    if (target_.discrete) return false;
    if (spec_.dynamics.time == Time::continuous) return flows_alike(spec_, influences_, state_);
    std::vector<Interval> everything = slots_;
    for (std::size_t j = 0; j < grid_.size(); ++j) {
      const Rational reach = grid_[j].radius() + grid_[j].measurement_error;
      const Rational last = grid_[j].point(grid_[j].count - 1);
      everything[spec_.state_slot(j)] = box_of(std::min(Rational(grid_[j].first - reach), grid_[j].lower),
                                               std::max(Rational(last + reach), grid_[j].upper));
    }
    for (std::size_t j = 0; j < inputs_.size(); ++j) {
      const auto ends = std::minmax_element(inputs_[j].values.begin(), inputs_[j].values.end());
      everything[spec_.input_slot(j)] = box_of(*ends.first, *ends.second);
    }
    return Bounds(spec_, influences_, state_).map().follows(everything, own);
  }

  bool fill(const PieceChoices& choices, const Odometer& choice, Bounds& bounds) {
    const std::int64_t base = choices.position(choice);
    for (const int halvings : {0, 1, 3, kMostHalvings}) {
      const std::optional<IndexRange> range = met_from(choices, choice, bounds, halvings);
      if (!range) return false;
      store(base, *range);
      if (holds(target_, claimed_.entries[static_cast<std::size_t>(base)], *range)) break;
    }
    return true;
  }

  [[nodiscard]] std::optional<IndexRange> met_from(const PieceChoices& choices, const Odometer& choice,
                                                   Bounds& bounds, int halvings) const {
    std::vector<Interval> slots = slots_;
    if (shifts_) slots[spec_.state_slot(state_)] = {0.0, 0.0};
    std::optional<IndexRange> met;
    const bool enclosed = choices.for_each_piece(choice, slots, [&](const Odometer&) {
      const std::optional<Interval> next = bounds(slots, halvings);
      if (!next) return false;
      const IndexRange range = cells_met_by(*next);
      met = met ? merge_ranges(*met, range, target_) : range;
      return true;
    });
    return enclosed ? met : std::nullopt;
  }

  /// Of the cell at `first` if the state follows itself.
  [[nodiscard]] IndexRange cells_met_by(const Interval& next) const {
    const Rational& error = target_.measurement_error;
    if (!shifts_) {
      return cells_met(target_, spec_.abstraction.cells, exact(next.lower) - error, exact(next.upper) + error,
                       true);
    }
    const Rational reach = target_.radius() + 2 * error;
    return cells_met(target_, spec_.abstraction.cells, target_.first - reach + exact(next.lower),
                     target_.first + reach + exact(next.upper), false);
  }

  void store(std::int64_t base, IndexRange range) {
    if (!shifts_) {
      table_.entries[static_cast<std::size_t>(base)] = range;
      return;
    }
    for (std::int64_t k = 0; k < target_.count; ++k) {
      table_.entries[static_cast<std::size_t>(base + k * table_.state_stride[state_])] = {
          saturate_index(range.first + k), saturate_index(range.last + k)};
    }
  }

  const ProblemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  std::size_t state_;
  const GridDimension& target_;
  const PostTable& claimed_;
  Influences influences_;
  PostTable table_;
  std::vector<Interval> slots_;
  bool shifts_ = false;
};

}  // namespace

std::optional<PostTable> outward_posts(const ProblemSpec& spec, const UniformGrid& grid,
                                       const InputSpace& inputs, std::size_t state, const PostTable& claimed,
                                       ThreadTeam& team) {
  return OutwardPosts(spec, grid, inputs, state, claimed).run(team);
}

}  // namespace coordreq
