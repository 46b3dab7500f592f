#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

#include "answers/checking/cell_pieces.hpp"
#include "spec/system_spec.hpp"
#include "verify/check_tube.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/piece_choices.hpp"
#include "verify/reference_posts.hpp"

namespace coordreq {
namespace {

constexpr Effort kEfforts[] = {{1, 1e-4}, {2, 1e-4}, {4, 1e-5}, {8, 1e-5}, {16, 1e-6}, {64, 1e-6}};

class OutwardTubes {
 public:
  explicit OutwardTubes(const PostQuestion& question)
      : question_(question),
        spec_(*question.spec),
        state_(question.state),
        target_((*question.grid)[state_]),
        claimed_(*question.claimed),
        influences_(influences_on(spec_, state_)),
        alike_(flows_alike(spec_, influences_, state_)),
        choices_(spec_, *question.grid, *question.inputs, claimed_,
                 alike_ ? std::optional(state_) : std::nullopt),
        queried_(choices_.made_by(*question.cells)),
        slots_(spec_.slot_count()),
        tally_(question) {
    moving_ = row_of(influences_, state_).value_or(0);
    for (const std::size_t l : influences_.disturbances)
      slots_[spec_.disturbance_slot(l)] = span_of(spec_.disturbances[l].lower, spec_.disturbances[l].upper);
    if (alike_) {
      const Rational reach = target_.radius() + target_.measurement_error;
      pieces_ = {{{target_.first - reach, target_.first + reach}}};
      slots_[spec_.state_slot(state_)] = span_of(0, 0);
      return;
    }
    variable_ = choices_.variable(spec_.state_slot(state_));
    for (std::int64_t k = 0; k < target_.count; ++k) pieces_.push_back(pieces_of(target_, k));
  }

  TubeFinding run(Budget& budget, ThreadTeam& team) {
    if (has_stops(spec_, influences_))
      between_ends_ =
          tubes_between_ends(spec_, *question_.grid, *question_.inputs, state_, *question_.cells, team);
    std::vector<std::unique_ptr<FlowExtremes>> flows(static_cast<std::size_t>(team.size()));
    const auto count = static_cast<std::int64_t>(queried_.size());
    constexpr std::int64_t kBlock = 1024;
    const Work of_begun = budget.of_begun(kBlock);
    answer_within(budget, count, kBlock, team, [&](std::int64_t i, Work most, int worker) {
      auto& flow = flows[static_cast<std::size_t>(worker)];
      if (!flow) flow = std::make_unique<FlowExtremes>(spec_, influences_, target_.step.get_d());
      const Work before = flow->work();
      flow->limit_work(most + of_begun);
      check(Odometer(choices_.counts(), queried_[static_cast<std::size_t>(i)]), before + most, *flow);
      return flow->work() - before;
    });
    budget.leave_open(left_open_);
    return tally_.finding(false);
  }

 private:
  /// @param end of the work of `flow`
  void check(const Odometer& choice, Work end, FlowExtremes& flow) {
    const std::int64_t stride = claimed_.state_stride[state_];
    std::int64_t position = choices_.position(choice);
    std::int64_t k = 0;
    for (; !claimed_.find(position); position += stride) ++k;
    const bool unbounded = tally_.is_unbounded(position);
    std::vector<TubeBounds> bounds;
    const bool is_known = between_ends(position).has_value();
    bool is_cut_off = false;
    for (const Effort& effort : kEfforts) {
      if (unbounded || is_known || tally_.is_enough(position, k, bounds)) break;
      is_cut_off = flow.work() >= end;
      if (is_cut_off) break;
      std::optional<std::vector<TubeBounds>> next = tubes(choice, flow, effort);
      if (next) bounds = std::move(*next);
    }
    for (; k < (alike_ ? target_.count : 1); ++k, position += stride) {
      if (!claimed_.find(position)) continue;
      if (tally_.is_unbounded(position)) {
        tally_.add_unbounded();
      } else if (const std::optional<TubeBounds> tube = between_ends(position)) {
        tally_.add(position, 0, {*tube});
      } else {
        tally_.add(position, k, bounds);
        if (is_cut_off) ++left_open_;
      }
    }
  }

  /// The tube of an entry, where it follows from the ends of the motion alone.
  [[nodiscard]] std::optional<TubeBounds> between_ends(std::int64_t position) const {
    if (!between_ends_) return std::nullopt;
    const std::optional<std::size_t> entry = between_ends_->find(position);
    if (!entry || between_ends_->entries[*entry] == kUnknownTube) return std::nullopt;
    return TubeBounds::of(between_ends_->entries[*entry], between_ends_->entries[*entry]);
  }

  [[nodiscard]] std::optional<std::vector<TubeBounds>> tubes(const Odometer& choice, FlowExtremes& flow,
                                                             const Effort& effort) const {
    SpanBox slots = slots_;
    std::vector<TubeBounds> result;
    const bool enclosed = choices_.for_each_piece(choice, slots, [&](const Odometer& piece) {
      const std::optional<FlowRange> range = range_during_period(flow, moving_, slots, effort);
      if (range) result.push_back(tube_from(*range, piece_of(choice, piece)));
      return range.has_value();
    });
    if (!enclosed) return std::nullopt;
    return result;
  }

  [[nodiscard]] const RationalInterval& piece_of(const Odometer& choice, const Odometer& piece) const {
    if (alike_) return pieces_.front().front();
    return pieces_[static_cast<std::size_t>(choice[variable_])][static_cast<std::size_t>(piece[variable_])];
  }

  /// Values are those of the state itself, or of the difference to its beginning. What does not leave the
  /// initial place on one side has its end there, exactly.
  [[nodiscard]] TubeBounds tube_from(const FlowRange& range, const RationalInterval& piece) const {
    const Rational base_lower = alike_ ? piece.lower : Rational(0);
    const Rational base_upper = alike_ ? piece.upper : Rational(0);
    Rational lower = piece.lower;
    Rational upper = piece.upper;
    if (!range.stays_above_start)
      lower = std::min(lower, Rational(base_lower + range.lower.lower_rational()));
    if (!range.stays_below_start)
      upper = std::max(upper, Rational(base_upper + range.upper.upper_rational()));
    Rational low = piece.lower;
    Rational high = piece.upper;
    if (range.low) low = std::min(low, Rational(base_lower + range.low->upper_rational()));
    if (range.high) high = std::max(high, Rational(base_upper + range.high->lower_rational()));
    return TubeBounds::of(cells_needed(target_, lower, upper), cells_needed(target_, low, high));
  }

  const PostQuestion& question_;
  const SystemSpec& spec_;
  std::size_t state_;
  const GridDimension& target_;
  const PostTable& claimed_;
  Influences influences_;
  bool alike_;  ///< see flows_alike(): cells of the state itself are moved alike
  PieceChoices choices_;
  std::vector<std::int64_t> queried_;  ///< numbers of choices
  SpanBox slots_;
  TubeTally tally_;
  std::optional<PostTable> between_ends_;              ///< tubes_between_ends(), where limits stop states
  std::atomic<std::int64_t> left_open_ = 0;            ///< tubes that are open for want of work
  std::size_t moving_ = 0;                             ///< place among the moving states
  std::size_t variable_ = 0;                           ///< among the variables of choices_
  std::vector<std::vector<RationalInterval>> pieces_;  ///< [index of the state][piece]
};

}  // namespace

TubeFinding check_outward_tubes(const PostQuestion& question, Budget& budget, ThreadTeam& team) {
  return OutwardTubes(question).run(budget, team);
}

}  // namespace coordreq
