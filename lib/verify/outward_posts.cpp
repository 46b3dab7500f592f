#include "verify/outward_posts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "model/odometer.hpp"
#include "verify/cell_place.hpp"
#include "verify/map_extremes.hpp"
#include "verify/piece_choices.hpp"
#include "verify/post_proof.hpp"

namespace coordreq {
namespace {

/// One round after the other, of more work for what is still open.
const PostEffort kRounds[] = {{1, {2, 1e-3}},   {2, {8, 1e-4}},    {16, {8, 1e-5}},
                              {64, {16, 1e-6}}, {512, {32, 1e-7}}, {4096, {96, 1e-7}}};

class OutwardPosts {
 public:
  explicit OutwardPosts(const PostQuestion& question)
      : spec_(*question.spec),
        grid_(*question.grid),
        inputs_(*question.inputs),
        state_(question.state),
        target_(grid_[state_]),
        claimed_(*question.claimed),
        cells_(*question.cells),
        budget_(*question.budget),
        influences_(influences_on(spec_, state_)),
        slots_(spec_.slot_count()),
        tally_(question.check) {
    for (const std::size_t l : influences_.disturbances)
      slots_[spec_.disturbance_slot(l)] = span_of(spec_.disturbances[l].lower, spec_.disturbances[l].upper);
  }

  std::optional<Finding> run(ThreadTeam& team) {
    const PostTable shape = empty_table(grid_, inputs_, influences_);
    if (has_stops(spec_, influences_) || jumps_on_the_way(spec_, influences_) ||
        claimed_.entries.size() != shape.entries.size())
      return std::nullopt;
    shifts_ = follows_itself();
    if (shifts_) slots_[spec_.state_slot(state_)] = span_of(0, 0);
    choices_.emplace(spec_, grid_, inputs_, claimed_, shifts_ ? std::optional(state_) : std::nullopt);
    open_ = choices_->made_by(cells_);
    tally_.add_checked(static_cast<std::int64_t>(open_.size()) * copies());
    tally_.set_note("enclosures");
    std::vector<std::unique_ptr<PostProver>> provers(static_cast<std::size_t>(team.size()));
    for (std::size_t round = 0; round < std::size(kRounds) && !open_.empty(); ++round) {
      is_last_ = round + 1 == std::size(kRounds);
      run_round(kRounds[round], provers, team);
    }
    return tally_.finding();
  }

 private:
  void run_round(const PostEffort& effort, std::vector<std::unique_ptr<PostProver>>& provers,
                 ThreadTeam& team) {
    std::vector<std::uint8_t> still_open(open_.size());
    const auto count = static_cast<std::int64_t>(open_.size());
    const std::int64_t grain = effort.most_boxes == 1 ? 16 : 1;
    team.for_each(count, grain, [&](ThreadTeam::Range range, int worker) {
      auto& prover = provers[static_cast<std::size_t>(worker)];
      if (!prover) {
        prover = std::make_unique<PostProver>(spec_, target_,
                                              next_value_of(spec_, influences_, state_, target_), shifts_);
      }
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        const auto place = static_cast<std::size_t>(i);
        still_open[place] = settle(open_[place], effort, *prover) ? 0 : 1;
      }
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (still_open[i] != 0) open_[kept++] = open_[i];
    }
    open_.resize(kept);
  }

  /// @returns false if it is to be tried again
  bool settle(std::int64_t number, const PostEffort& effort, PostProver& prover) {
    const Odometer choice(choices_->counts(), number);
    const bool over = budget_.is_over();
    bool settled = true;
    const std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int64_t>> claims =
        claims_of(choice);
    std::vector<std::pair<std::int64_t, PostProof>> proofs;
    for (const auto& [range, entries] : claims) {
      PostProof proof = over ? PostProof{PostVerdict::open, "the budget ended"}
                             : prove(choice, {range.first, range.second}, effort, prover);
      settled = settled && proof.verdict != PostVerdict::open;
      for (const std::int64_t entry : entries) proofs.emplace_back(entry, proof);
    }
    if (!settled && !over && !is_last_) return false;
    for (const auto& [entry, proof] : proofs) note(entry, proof);
    return true;
  }

  /// Ranges as they are for the cell with index 0 if cells follow themselves, and whose they are.
  [[nodiscard]] std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int64_t>> claims_of(
      const Odometer& choice) const {
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int64_t>> result;
    const std::int64_t base = choices_->position(choice);
    for (std::int64_t k = 0; k < copies(); ++k) {
      const std::int64_t entry = base + (shifts_ ? k * claimed_.state_stride[state_] : 0);
      const IndexRange range = claimed_.entries[static_cast<std::size_t>(entry)];
      result[{back(range.first, k), back(range.last, k)}].push_back(entry);
    }
    return result;
  }

  [[nodiscard]] static std::int32_t back(std::int32_t index, std::int64_t by) {
    return index == INT32_MIN || index == INT32_MAX ? index : saturate_index(std::int64_t{index} - by);
  }

  [[nodiscard]] PostProof prove(const Odometer& choice, IndexRange claimed, const PostEffort& effort,
                                PostProver& prover) const {
    if (claimed.first == INT32_MIN && claimed.last == INT32_MAX) return {};
    const Budget::Clock::time_point end = budget_.end_of_one();
    SpanBox slots = slots_;
    PostProof worst;
    choices_->for_each_piece(choice, slots, [&](const Odometer&) {
      PostProof proof = prover.prove(slots, claimed, effort, end);
      if (proof.verdict != PostVerdict::holds && worst.verdict != PostVerdict::wrong)
        worst = std::move(proof);
      return worst.verdict != PostVerdict::wrong;
    });
    return worst;
  }

  void note(std::int64_t entry, const PostProof& proof) {
    const IndexRange range = claimed_.entries[static_cast<std::size_t>(entry)];
    const bool has_limits = with_measurements_at_limits(target_, spec_.abstraction.cells, range) == range;
    const auto describe = [&] {
      return fmt::format("{}: {} {}, but {}", entry_text(grid_, inputs_, claimed_, entry), target_.name,
                         range_text(target_, range),
                         has_limits ? proof.why : "without the cells that may be measured at a limit");
    };
    if (range.first > range.last) {
      tally_.add_wrong(entry,
                       [&] { return entry_text(grid_, inputs_, claimed_, entry) + ": no cell at all"; });
    } else if (proof.verdict == PostVerdict::wrong) {
      tally_.add_wrong(entry, describe);
    } else if (proof.verdict == PostVerdict::open || !has_limits) {
      tally_.add_unproven(entry, describe);
    }
  }

  [[nodiscard]] std::int64_t copies() const { return shifts_ ? target_.count : 1; }

  /// The next value is the present one and something that does not depend on it.
  [[nodiscard]] bool follows_itself() const {
    if (target_.discrete) return false;
    if (spec_.dynamics.time == Time::continuous) return flows_alike(spec_, influences_, state_);
    ArbBox everything = all_of(slots_);
    for (std::size_t j = 0; j < grid_.size(); ++j) {
      const Rational reach = grid_[j].radius() + grid_[j].measurement_error;
      const Rational last = grid_[j].point(grid_[j].count - 1);
      everything[spec_.state_slot(j)] = span_of(std::min(Rational(grid_[j].first - reach), grid_[j].lower),
                                                std::max(Rational(last + reach), grid_[j].upper))
                                            .all();
    }
    for (std::size_t j = 0; j < inputs_.size(); ++j) {
      const auto ends = std::minmax_element(inputs_[j].values.begin(), inputs_[j].values.end());
      everything[spec_.input_slot(j)] = span_of(*ends.first, *ends.second).all();
    }
    return MapExtremes(spec_, influences_, state_).follows(everything, spec_.state_slot(state_));
  }

  const ProblemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  std::size_t state_;
  const GridDimension& target_;
  const PostTable& claimed_;
  const std::vector<std::int64_t>& cells_;
  const Budget& budget_;
  Influences influences_;
  SpanBox slots_;
  Tally tally_;
  std::optional<PieceChoices> choices_;
  std::vector<std::int64_t> open_;  ///< numbers of choices
  bool shifts_ = false;
  bool is_last_ = false;
};

}  // namespace

std::optional<Finding> check_outward_posts(const PostQuestion& question, ThreadTeam& team) {
  return OutwardPosts(question).run(team);
}

}  // namespace coordreq
