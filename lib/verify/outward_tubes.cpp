#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

#include "answers/checking/cell_parts.hpp"
#include "spec/system_spec.hpp"
#include "verify/check_tube.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/own_posts.hpp"
#include "verify/piece_choices.hpp"

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
        asked_(choices_.made_by(*question.cells)),
        slots_(spec_.slot_count()),
        tally_(question) {
    moving_ = row_of(influences_, state_).value_or(0);
    for (const std::size_t l : influences_.disturbances)
      slots_[spec_.disturbance_slot(l)] = span_of(spec_.disturbances[l].lower, spec_.disturbances[l].upper);
    if (alike_) {
      const Rational reach = target_.radius() + target_.measurement_error;
      places_ = {{{target_.first - reach, target_.first + reach}}};
      slots_[spec_.state_slot(state_)] = span_of(0, 0);
      return;
    }
    own_ = choices_.variable(spec_.state_slot(state_));
    for (std::int64_t k = 0; k < target_.count; ++k) places_.push_back(parts_of(target_, k));
  }

  TubeFinding run(Budget& budget, ThreadTeam& team) {
    if (has_stops(spec_, influences_))
      between_ends_ =
          tubes_between_ends(spec_, *question_.grid, *question_.inputs, state_, *question_.cells, team);
    std::vector<std::unique_ptr<FlowExtremes>> flows(static_cast<std::size_t>(team.size()));
    const auto count = static_cast<std::int64_t>(asked_.size());
    constexpr std::int64_t kBlock = 1024;
    const Work of_begun = budget.of_begun(kBlock);
    answer_within(budget, count, kBlock, team, [&](std::int64_t i, Work most, int worker) {
      auto& flow = flows[static_cast<std::size_t>(worker)];
      if (!flow) flow = std::make_unique<FlowExtremes>(spec_, influences_, target_.step.get_d());
      const Work before = flow->work();
      flow->limit_work(most + of_begun);
      check(Odometer(choices_.counts(), asked_[static_cast<std::size_t>(i)]), before + most, *flow);
      return flow->work() - before;
    });
    budget.leave_open(left_open_);
    return tally_.finding(false);
  }

 private:
  /// @param end of the work of `flow`
  void check(const Odometer& choice, Work end, FlowExtremes& flow) {
    const std::int64_t stride = claimed_.state_stride[state_];
    std::int64_t place = choices_.position(choice);
    std::int64_t k = 0;
    for (; !claimed_.find(place); place += stride) ++k;
    const bool unbounded = tally_.is_unbounded(place);
    std::vector<OwnTube> own;
    const bool is_known = between_ends(place).has_value();
    bool is_cut_off = false;
    for (const Effort& effort : kEfforts) {
      if (unbounded || is_known || tally_.is_enough(place, k, own)) break;
      is_cut_off = flow.work() >= end;
      if (is_cut_off) break;
      std::optional<std::vector<OwnTube>> next = tubes(choice, flow, effort);
      if (next) own = std::move(*next);
    }
    for (; k < (alike_ ? target_.count : 1); ++k, place += stride) {
      if (!claimed_.find(place)) continue;
      if (tally_.is_unbounded(place)) {
        tally_.add_unbounded();
      } else if (const std::optional<OwnTube> tube = between_ends(place)) {
        tally_.add(place, 0, {*tube});
      } else {
        tally_.add(place, k, own);
        if (is_cut_off) ++left_open_;
      }
    }
  }

  /// The tube of an entry, where it follows from the ends of the motion alone.
  [[nodiscard]] std::optional<OwnTube> between_ends(std::int64_t place) const {
    if (!between_ends_) return std::nullopt;
    const std::optional<std::size_t> entry = between_ends_->find(place);
    if (!entry || between_ends_->entries[*entry] == kUnknownTube) return std::nullopt;
    return OwnTube::of(between_ends_->entries[*entry], between_ends_->entries[*entry]);
  }

  [[nodiscard]] std::optional<std::vector<OwnTube>> tubes(const Odometer& choice, FlowExtremes& flow,
                                                          const Effort& effort) const {
    SpanBox slots = slots_;
    std::vector<OwnTube> result;
    const bool enclosed = choices_.for_each_piece(choice, slots, [&](const Odometer& piece) {
      const std::optional<FlowRange> range = range_during_period(flow, moving_, slots, effort);
      if (range) result.push_back(tube_from(*range, place_of(choice, piece)));
      return range.has_value();
    });
    if (!enclosed) return std::nullopt;
    return result;
  }

  [[nodiscard]] const RationalInterval& place_of(const Odometer& choice, const Odometer& piece) const {
    if (alike_) return places_.front().front();
    return places_[static_cast<std::size_t>(choice[own_])][static_cast<std::size_t>(piece[own_])];
  }

  /// Values are those of the state itself, or of the difference to its beginning. What does not leave the
  /// initial place on one side has its end there, exactly.
  [[nodiscard]] OwnTube tube_from(const FlowRange& range, const RationalInterval& place) const {
    const Rational base_lower = alike_ ? place.lower : Rational(0);
    const Rational base_upper = alike_ ? place.upper : Rational(0);
    Rational lower = place.lower;
    Rational upper = place.upper;
    if (!range.stays_above_start)
      lower = std::min(lower, Rational(base_lower + range.lower.lower_rational()));
    if (!range.stays_below_start)
      upper = std::max(upper, Rational(base_upper + range.upper.upper_rational()));
    Rational low = place.lower;
    Rational high = place.upper;
    if (range.low) low = std::min(low, Rational(base_lower + range.low->upper_rational()));
    if (range.high) high = std::max(high, Rational(base_upper + range.high->lower_rational()));
    return OwnTube::of(cells_needed(target_, lower, upper), cells_needed(target_, low, high));
  }

  const PostQuestion& question_;
  const SystemSpec& spec_;
  std::size_t state_;
  const GridDimension& target_;
  const PostTable& claimed_;
  Influences influences_;
  bool alike_;  ///< see flows_alike(): cells of the state itself are moved alike
  PieceChoices choices_;
  std::vector<std::int64_t> asked_;  ///< numbers of choices
  SpanBox slots_;
  TubeTally tally_;
  std::optional<PostTable> between_ends_;              ///< tubes_between_ends(), where limits stop states
  std::atomic<std::int64_t> left_open_ = 0;            ///< tubes that are open for want of work
  std::size_t moving_ = 0;                             ///< place among the moving states
  std::size_t own_ = 0;                                ///< among the variables of choices_
  std::vector<std::vector<RationalInterval>> places_;  ///< [own index][piece]
};

}  // namespace

TubeFinding check_outward_tubes(const PostQuestion& question, Budget& budget, ThreadTeam& team) {
  return OutwardTubes(question).run(budget, team);
}

}  // namespace coordreq
