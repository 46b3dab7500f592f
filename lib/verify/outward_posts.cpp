#include "verify/outward_posts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>

#include "answers/checking/cell_location.hpp"
#include "answers/checking/posts.hpp"
#include "model/odometer.hpp"
#include "spec/system_spec.hpp"
#include "verify/map_extremes.hpp"
#include "verify/piece_choices.hpp"
#include "verify/post_proof.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kBytesOfAllocations = 32;  ///< of a part

/// One round after the other, of more work for what is still open. Once more the same serves those that got
/// a smaller share the first time.
const PostEffort kRounds[] = {{1, {2, 1e-3}},    {2, {8, 1e-4}},     {16, {8, 1e-5}},   {64, {16, 1e-6}},
                              {512, {32, 1e-7}}, {4096, {96, 1e-7}}, {4096, {96, 1e-7}}};

/// The next value is the present one and something that does not depend on it.
bool follows_itself(const PostQuestion& question, const Influences& influences) {
  const SystemSpec& spec = *question.spec;
  const UniformGrid& grid = *question.grid;
  const InputSpace& inputs = *question.inputs;
  if (grid[question.state].discrete) return false;
  if (spec.dynamics.time == Time::continuous) return flows_alike(spec, influences, question.state);
  ArbBox everything(spec.slot_count());
  for (std::size_t j = 0; j < grid.size(); ++j) {
    const Rational reach = grid[j].radius() + grid[j].measurement_error;
    const Rational last = grid[j].point(grid[j].count - 1);
    everything[spec.state_slot(j)] = span_of(std::min(Rational(grid[j].first - reach), grid[j].lower),
                                             std::max(Rational(last + reach), grid[j].upper))
                                         .all();
  }
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    const auto ends = std::minmax_element(inputs[j].values.begin(), inputs[j].values.end());
    everything[spec.input_slot(j)] = span_of(*ends.first, *ends.second).all();
  }
  for (const std::size_t l : influences.disturbances)
    everything[spec.disturbance_slot(l)] =
        span_of(spec.disturbances[l].lower, spec.disturbances[l].upper).all();
  // The difference is taken with the state at 0, which need not be in the domain: sign(x) is another constant
  // there.
  const std::uint32_t slot = spec.state_slot(question.state);
  everything[slot] = hull(everything[slot], Arb(0.0));
  return MapExtremes(spec, influences, question.state).follows(everything, slot);
}

/// Tables that one enclosure serves.
class OutwardPosts {
 public:
  OutwardPosts(std::vector<PostQuestion> questions, PostGroup group)
      : questions_(std::move(questions)),
        group_(std::move(group)),
        spec_(*questions_.front().spec),
        grid_(*questions_.front().grid),
        inputs_(*questions_.front().inputs),
        slots_(spec_.slot_count()),
        choices_(spec_, grid_, inputs_, table(0),
                 group_.shifts ? std::optional(group_.states.front()) : std::nullopt),
        open_(open_choices()) {
    for (const std::size_t l : group_.influences.disturbances)
      slots_[spec_.disturbance_slot(l)] = span_of(spec_.disturbances[l].lower, spec_.disturbances[l].upper);
    if (group_.shifts) slots_[spec_.state_slot(group_.states.front())] = span_of(0, 0);
    for (const PostQuestion& question : questions_) {
      tallies_.emplace_back(question.check);
      tallies_.back().add_checked(static_cast<std::int64_t>(question.claimed->entries.size()));
      tallies_.back().set_note("enclosures");
    }
  }

  std::vector<Finding> run(Budget& budget, const PostProgress& progress, ThreadTeam& team) {
    const std::size_t all = open_.size();
    std::vector<std::unique_ptr<PostProver>> provers(static_cast<std::size_t>(team.size()));
    for (std::size_t round = 0; round < std::size(kRounds) && !open_.empty(); ++round) {
      is_last_ = round + 1 == std::size(kRounds);
      const auto report = [&](std::size_t settled) {
        if (progress) progress(all - open_.size() + settled, all);
      };
      report(0);
      run_round(kRounds[round], budget, provers, report, team);
    }
    budget.leave_open(left_open_);
    std::vector<Finding> findings;
    for (const Tally& tally : tallies_) findings.push_back(tally.finding());
    return findings;
  }

 private:
  /// The work that may be done for a choice, and beyond that where something is begun.
  struct Share {
    Work most = 0;
    Work of_begun = 0;
  };
  /// A part of one of the boxes of a choice, which has open claims.
  struct Left {
    std::int64_t box = 0;
    OpenSubbox subbox;
  };
  /// A choice of indices, and which of its claims are settled: bits, as far as they go.
  struct Open {
    std::int64_t choice = 0;
    std::uint64_t settled = 0;
    std::unique_ptr<std::vector<Left>> left = {};  ///< null: nothing is proven of claims that are not settled
    [[nodiscard]] bool has_settled(std::size_t claim) const {
      return claim < kMostSettled && (settled >> claim & 1U) != 0;
    }
    void settle(std::size_t claim) {
      if (claim < kMostSettled) settled |= std::uint64_t{1} << claim;
    }
    static constexpr std::size_t kMostSettled = 64;
  };
  /// A claim and the places of its table's entries that make it.
  struct Claimed {
    PostClaim claim;
    std::vector<std::int64_t> positions;
  };

  [[nodiscard]] std::vector<Open> open_choices() const {
    std::vector<Open> open;
    for (const std::int64_t choice : choices_.made_by(*questions_.front().cells)) open.push_back({choice});
    return open;
  }

  void run_round(const PostEffort& effort, Budget& budget, std::vector<std::unique_ptr<PostProver>>& provers,
                 const std::function<void(std::size_t settled)>& report, ThreadTeam& team) {
    std::vector<std::uint8_t> still_open(open_.size());
    const auto count = static_cast<std::int64_t>(open_.size());
    const std::int64_t block = effort.most_boxes == 1 ? 1024 : 64;
    const Work of_begun = budget.of_begun(block);
    std::size_t bytes = 0;
    std::int64_t looked_at = 0;
    const auto answered = [&](std::int64_t some) {
      for (; looked_at < some; ++looked_at) {
        std::unique_ptr<std::vector<Left>>& left = open_[static_cast<std::size_t>(looked_at)].left;
        if (left) bytes += bytes_of(*left);
        if (static_cast<double>(bytes) > kMostBytesOfOpenSubboxes) left.reset();  // is begun anew
      }
      report(static_cast<std::size_t>(std::count(still_open.begin(), still_open.begin() + some, 0)));
    };
    const auto answer = [&](std::int64_t i, Work most, int worker) {
      auto& prover = provers[static_cast<std::size_t>(worker)];
      if (!prover) prover = std::make_unique<PostProver>(spec_, grid_, group_);
      const Work before = prover->work();
      const auto index = static_cast<std::size_t>(i);
      still_open[index] = settle(open_[index], effort, {most, of_begun}, *prover) ? 0 : 1;
      return prover->work() - before;
    };
    answer_within(budget, count, block, team, answer, answered);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (still_open[i] != 0 && kept++ != i) open_[kept - 1] = std::move(open_[i]);
    }
    open_.resize(kept);
  }

  /// @returns false if it is to be tried again
  bool settle(Open& open, const PostEffort& effort, Share share, PostProver& prover) {
    const Odometer choice(choices_.counts(), open.choice);
    const bool is_spent = share.most == 0;
    const std::vector<Claimed> all = claims_of(choice);
    std::vector<PostClaim> claims;
    std::vector<std::uint32_t> unsettled;
    for (std::size_t c = 0; c < all.size(); ++c) {
      claims.push_back(all[c].claim);
      if (!open.has_settled(c)) unsettled.push_back(static_cast<std::uint32_t>(c));
    }
    if (unsettled.empty()) return true;
    const std::vector<PostProof> proofs =
        is_spent ? std::vector<PostProof>(all.size(), {PostVerdict::open, "the budget ended"})
                 : prove(choice, claims, unsettled, open, effort, share, prover);
    bool settled = true;
    for (const std::uint32_t c : unsettled) {
      if (proofs[c].verdict == PostVerdict::open && !is_spent && !is_last_) {
        settled = false;
        continue;
      }
      open.settle(c);
      const bool is_cut_off = is_spent || (proofs[c].verdict == PostVerdict::open && proofs[c].is_cut_off);
      if (is_cut_off) left_open_ += static_cast<std::int64_t>(all[c].positions.size());
      for (const std::int64_t position : all[c].positions) note(all[c].claim.target, position, proofs[c]);
    }
    return settled;
  }

  [[nodiscard]] static std::size_t bytes_of(const std::vector<Left>& left) {
    std::size_t bytes = left.capacity() * sizeof(Left);
    for (const Left& one : left)
      bytes += one.subbox.cuts.capacity() * sizeof(std::uint16_t) +
               one.subbox.claims.capacity() * sizeof(std::uint32_t) + kBytesOfAllocations;
    return bytes;
  }

  /// Ranges as they are for the cell with index 0 if cells follow themselves, and whose they are.
  [[nodiscard]] std::vector<Claimed> claims_of(const Odometer& choice) const {
    std::vector<Claimed> result;
    const std::int64_t base = choices_.position(choice);
    for (std::size_t t = 0; t < group_.states.size(); ++t) {
      const std::size_t first = result.size();
      for (std::int64_t k = 0; k < copies(); ++k) {
        const std::int64_t position =
            base + (group_.shifts ? k * table(t).state_stride[group_.states[t]] : 0);
        const std::optional<std::size_t> entry = table(t).find(position);
        if (!entry || is_given_up(position)) continue;
        const IndexRange range = back(table(t).entries[*entry], k);
        const auto known = std::find_if(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(),
                                        [&](const Claimed& one) { return one.claim.range == range; });
        if (known != result.end()) {
          known->positions.push_back(position);
        } else {
          result.push_back({{t, range}, {position}});
        }
      }
    }
    return result;
  }

  /// A state that is said to end anywhere leaves its domain, so that there is no post: nothing is claimed.
  [[nodiscard]] bool is_given_up(std::int64_t position) const {
    for (std::size_t t = 0; t < group_.states.size(); ++t) {
      const IndexRange range = table(t).at(position);
      const bool anywhere = range.first == INT32_MIN && range.last == INT32_MAX;
      if (anywhere && after_leaving(range, grid_[group_.states[t]]).blocked) return true;
    }
    return false;
  }

  [[nodiscard]] static IndexRange back(IndexRange range, std::int64_t by) {
    const auto one = [by](std::int32_t index) {
      return index == INT32_MIN || index == INT32_MAX ? index : saturate_index(std::int64_t{index} - by);
    };
    return {one(range.first), one(range.last)};
  }

  /// Goes on with the parts that were left.
  [[nodiscard]] std::vector<PostProof> prove(const Odometer& choice, const std::vector<PostClaim>& claims,
                                             const std::vector<std::uint32_t>& unsettled, Open& open,
                                             const PostEffort& effort, Share share,
                                             PostProver& prover) const {
    const std::unique_ptr<std::vector<Left>> before =
        std::exchange(open.left, std::make_unique<std::vector<Left>>());
    SpanBox slots = slots_;
    std::vector<PostProof> worst(claims.size());
    std::int64_t box = -1;
    const Work begun = prover.work();
    choices_.for_each_piece(choice, slots, [&](const Odometer&) {
      ++box;
      std::vector<OpenSubbox> subboxes;
      if (!before) {
        subboxes.push_back({.cuts = {}, .claims = unsettled});
      } else {
        for (const Left& one : *before) {
          if (one.box == box) subboxes.push_back(one.subbox);
        }
      }
      const Work used = prover.work() - begun;
      const Work left = std::max<Work>(share.most - used, 0);
      const Work beyond = std::clamp<Work>(share.most + share.of_begun - used, 0, share.of_begun);
      std::vector<PostProof> proofs = prover.prove(slots, claims, subboxes, effort, left, beyond);
      for (OpenSubbox& subbox : subboxes) open.left->push_back({box, std::move(subbox)});
      bool all_wrong = true;
      for (const std::uint32_t c : unsettled) {
        if (proofs[c].verdict != PostVerdict::holds && worst[c].verdict != PostVerdict::wrong) {
          proofs[c].is_cut_off = proofs[c].is_cut_off || worst[c].is_cut_off;
          worst[c] = std::move(proofs[c]);
        }
        all_wrong = all_wrong && worst[c].verdict == PostVerdict::wrong;
      }
      return !all_wrong;
    });
    const auto is_whole = [](const Left& one) { return one.subbox.cuts.empty(); };
    if (std::ranges::all_of(*open.left, is_whole) && box <= 0) open.left.reset();
    return worst;
  }

  void note(std::size_t target, std::int64_t position, const PostProof& proof) {
    const GridDimension& dimension = grid_[group_.states[target]];
    const IndexRange range = table(target).at(position);
    const bool has_limits = with_measurements_at_limits(dimension, spec_.abstraction.cells, range) == range;
    const auto where = [&] { return entry_text(grid_, inputs_, table(target), position); };
    const auto describe = [&] {
      return fmt::format("{}: {} {}, but {}", where(), dimension.name, range_text(dimension, range),
                         has_limits ? proof.why : "without the cells that may be measured at a limit");
    };
    Tally& tally = tallies_[target];
    if (range.first > range.last) {
      tally.add_wrong(position, [&] { return where() + ": no cell at all"; });
    } else if (proof.verdict == PostVerdict::wrong) {
      tally.add_wrong(position, describe);
    } else if (proof.verdict == PostVerdict::open || !has_limits) {
      tally.add_unproven(position, describe);
    }
  }

  [[nodiscard]] const PostTable& table(std::size_t target) const { return *questions_[target].claimed; }
  [[nodiscard]] std::int64_t copies() const { return group_.shifts ? grid_[group_.states.front()].count : 1; }

  std::vector<PostQuestion> questions_;
  PostGroup group_;
  const SystemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  SpanBox slots_;
  PieceChoices choices_;
  std::vector<Open> open_;
  std::deque<Tally> tallies_;                ///< [target]
  std::atomic<std::int64_t> left_open_ = 0;  ///< entries that are open for want of work
  bool is_last_ = false;
};

bool can_be_enclosed(const PostQuestion& question, const Influences& influences) {
  const PostTable shape = empty_table(*question.grid, *question.inputs, influences, *question.cells);
  return question.claimed->states == shape.states && question.claimed->inputs == shape.inputs &&
         question.claimed->entries.size() == shape.entries.size();
}

}  // namespace

std::vector<std::optional<Finding>> check_outward_posts(const std::vector<PostQuestion>& questions,
                                                        Budget& budget, const PostProgress& progress,
                                                        ThreadTeam& team) {
  std::vector<std::optional<Finding>> findings(questions.size());
  std::vector<PostGroup> groups;
  std::vector<std::vector<std::size_t>> members;
  std::int64_t entries = 0;  // of groups that have not been looked at
  std::vector<bool> done(questions.size(), false);
  for (std::size_t q = 0; q < questions.size(); ++q) {
    if (done[q]) continue;
    const SystemSpec& spec = *questions[q].spec;
    PostGroup group{.states = {}, .influences = influences_on(spec, questions[q].state)};
    if (!can_be_enclosed(questions[q], group.influences)) continue;
    group.shifts = follows_itself(questions[q], group.influences);
    const bool alone = group.shifts || spec.dynamics.time == Time::discrete;
    std::vector<std::size_t>& positions = members.emplace_back();
    for (std::size_t other = q; other < (alone ? q + 1 : questions.size()); ++other) {
      if (!(influences_on(spec, questions[other].state) == group.influences)) continue;
      if (!can_be_enclosed(questions[other], group.influences)) continue;
      done[other] = true;
      positions.push_back(other);
      group.states.push_back(questions[other].state);
    }
    groups.push_back(std::move(group));
    entries += static_cast<std::int64_t>(questions[q].claimed->entries.size());
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<PostQuestion> together;
    for (const std::size_t q : members[g]) together.push_back(questions[q]);
    const auto count = static_cast<std::int64_t>(together.front().claimed->entries.size());
    Budget fraction = budget.fraction(count, entries);
    std::vector<Finding> found =
        OutwardPosts(std::move(together), std::move(groups[g])).run(fraction, progress, team);
    budget.settle(fraction);
    entries -= count;
    for (std::size_t k = 0; k < found.size(); ++k) findings[members[g][k]] = std::move(found[k]);
  }
  return findings;
}

}  // namespace coordreq
