#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <mutex>
#include <tuple>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/counterexample/check_path.hpp"
#include "answers/requirements/check_region.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using DefinedRank =
    std::tuple<std::int64_t, std::int32_t, std::int64_t>;  // (of the value, collision time, number)

/// The rank of a value, the lower the worse: not safe, not invariant, no way to the goal, then delays
/// ascending, or arrivals descending.
std::int64_t rank_by_definition(RequirementKind kind, std::int32_t value) {
  if (value == kOutsideWinning) return -1;
  if (value < 0) return INT64_MIN / 2 + value;  // the claim may be any number
  const bool is_limit = kind == RequirementKind::max_arrival || kind == RequirementKind::max_risk;
  return is_limit ? -std::int64_t{value} : std::int64_t{value};
}

/// Bounds of the verdict on a region: over cells that surely meet it, and over cells that may be counted.
struct Bounds {
  std::uint64_t sure = 0, possible = 0;
  std::uint64_t sure_failing = 0, possible_failing = 0;
  std::uint64_t doubted_failing = 0;  ///< not counted, but not shown not to meet the region
  DefinedRank sure_worst{INT64_MAX, kUnbounded, INT64_MAX};
  std::int64_t sure_least = INT64_MAX, possible_least = INT64_MAX;  ///< ranks

  void add(const Bounds& other) {
    sure += other.sure;
    possible += other.possible;
    sure_failing += other.sure_failing;
    possible_failing += other.possible_failing;
    doubted_failing += other.doubted_failing;
    sure_worst = std::min(sure_worst, other.sure_worst);
    sure_least = std::min(sure_least, other.sure_least);
    possible_least = std::min(possible_least, other.possible_least);
  }
};

class RequirementChecker {
 public:
  RequirementChecker(const CheckContext& context, std::size_t number, const ResultRequirement& claim,
                     ThreadTeam& team)
      : context_(context),
        requirement_(context.spec->requirements[number]),
        claim_(claim),
        value_of_(*context.claims, *context.spec, requirement_),
        collision_time_(context.claims->values("/collision_time")),
        region_(*context.spec, requirement_.where, *context.grid, context.claims->same_version, team),
        tally_("requirement " + requirement_.name) {
    if (requirement_.kind != RequirementKind::max_risk) return;
    const Rational rate = exact(context.claims->number("/risk", "rate"));
    most_risk_ = requirement_.risk - rate * static_cast<long>(requirement_.steps);
  }

  Finding run(ThreadTeam& team) {
    const Bounds bounds = find_bounds(team);
    tally_.add_checked(static_cast<std::int64_t>(bounds.possible));
    check_counts(bounds);
    check_reach();
    const bool holds = claim_.failing == 0 && !claim_.reached_side;
    if (claim_.holds != holds) wrong("the verdict does not follow from the stored numbers");
    // The analysis must have shown that doubted cells do not meet the region, which this check does not show.
    if (claim_.failing == 0 && bounds.doubted_failing > 0) tally_.add_unproven();
    if (claim_.path.has_value() != (claim_.failing > 0)) wrong("a counterexample without a failing cell");
    if (claim_.path) check_path(*claim_.path, bounds);
    return tally_.finding();
  }

 private:
  void wrong(const std::string& what) {
    tally_.add_wrong(number_++, [&what] { return what; });
  }

  [[nodiscard]] bool fails(std::int32_t value) const {
    if (requirement_.kind == RequirementKind::max_risk) return is_too_risky(value);
    return value < 0 || (requirement_.kind == RequirementKind::max_arrival ? value > requirement_.steps
                                                                           : value < requirement_.steps);
  }
  /// Whether the risk with these bits, and the part of the rate for the steps, is above the limit.
  [[nodiscard]] bool is_too_risky(std::int32_t bits) const {
    const auto risk = double{std::bit_cast<float>(bits)};
    return !(risk >= 0 && risk <= 1) || exact(risk) > most_risk_;  // the claim may be any number
  }

  [[nodiscard]] Bounds find_bounds(ThreadTeam& team) const {
    Bounds all;
    std::mutex mutex;
    team.for_each(context_.grid->cells(), 4096, [&](ThreadTeam::Range range, int) {
      Bounds partial;
      for (std::int64_t x = range.begin; x < range.end; ++x) add(x, partial);
      const std::lock_guard lock(mutex);
      all.add(partial);
    });
    return all;
  }

  void add(std::int64_t cell, Bounds& bounds) const {
    const Meeting meeting = region_.of(cell);
    if (meeting == Meeting::off) return;
    const auto x = static_cast<std::size_t>(cell);
    const std::int32_t value = value_of_(x);
    const std::int64_t rank = rank_by_definition(requirement_.kind, value);
    const bool failing = fails(value);
    if (failing && meeting != Meeting::counted) ++bounds.doubted_failing;
    if (meeting == Meeting::doubted) return;
    ++bounds.possible;
    bounds.possible_failing += failing ? 1 : 0;
    bounds.possible_least = std::min(bounds.possible_least, rank);
    if (meeting != Meeting::counted) return;
    ++bounds.sure;
    bounds.sure_least = std::min(bounds.sure_least, rank);
    if (!failing) return;
    ++bounds.sure_failing;
    bounds.sure_worst = std::min(bounds.sure_worst, {rank, collision_time_[x], cell});
  }

  void check_counts(const Bounds& bounds) {
    expect("cells", claim_.cells, bounds.sure, bounds.possible);
    expect("failing cells", claim_.failing, bounds.sure_failing, bounds.possible_failing);
    if (claim_.failing > claim_.cells) wrong("more cells fail than there are");
    expect("worst value, ranked", rank_by_definition(requirement_.kind, claim_.least_delay),
           bounds.possible_least, bounds.sure_least);
  }

  template <class Number>
  void expect(const char* what, Number value, Number least, Number most) {
    if (value >= least && value <= most) return;
    wrong(fmt::format("{}: {}, expected {}", what, value,
                      least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most)));
  }

  /// Checks the first side beyond which the region reaches.
  void check_reach() {
    const auto is_unsafe = [this](const ResultSide& side) {
      const StateSpec& state = context_.spec->states[side.state];
      return (side.above ? state.above : state.below) == Outside::unsafe;
    };
    for (std::size_t i = 0; i < context_.grid->size(); ++i) {
      for (const bool above : {false, true}) {
        const ResultSide side{.state = i, .above = above};
        const bool claimed = claim_.reached_side == side;
        const Reach reach = is_unsafe(side)
                                ? reach_beyond(*context_.spec, requirement_.where, *context_.grid, side)
                                : Reach::never;
        if (claimed && reach == Reach::never) wrong("the region does not reach beyond the side named");
        if (claimed) return;
        if (reach == Reach::reached) wrong("the region reaches beyond a side that is not named");
        if (reach == Reach::open) tally_.add_unproven();
      }
    }
  }

  void check_path(const ResultPath& path, const Bounds& bounds) {
    const std::uint64_t first = path.cell.front();
    const auto cell = static_cast<std::int64_t>(first);
    const std::int32_t value = value_of_(first);
    if (region_.of(cell) < Meeting::perhaps) wrong("the counterexample begins outside the region");
    if (!fails(value)) wrong("the counterexample begins in a cell that does not fail");
    if (value != claim_.least_delay) wrong("the counterexample begins with another value than the worst");
    if (DefinedRank(rank_by_definition(requirement_.kind, value), collision_time_[first], cell) >
        bounds.sure_worst)
      wrong("the counterexample does not begin in the worst cell");
    check_seen(path, value);
    PathChecker(context_, requirement_).check(path, tally_);
  }

  /// The step at which the system itself leaves is an observation, but cannot be before the proven one.
  void check_seen(const ResultPath& path, std::int32_t value) {
    if ((is_followed(requirement_.kind) && path.steps() > 0) != (path.seen != ResultPath::kNotFollowed))
      return wrong("a nominal simulation where none is made, or none where one is");
    if (path.seen <= 0) return;
    const bool is_after = path.phase.front() == PathPhase::afterwards;
    const std::int64_t left = collision_time_[path.cell.front()];  // the claim may be any number
    const std::int64_t proven = value >= 0 ? value : is_after ? 0 : left - 1;
    if (path.seen <= proven) wrong("the nominal simulation leaves sooner than proven");
  }

  const CheckContext& context_;
  const RequirementSpec& requirement_;
  const ResultRequirement& claim_;
  ClaimedValues value_of_;
  const std::vector<std::int32_t>& collision_time_;
  RegionJudge region_;
  Rational most_risk_;  ///< of `max_risk`
  Tally tally_;
  std::int64_t number_ = -1000;  // below the numbers of the steps of the counterexample
};

class RequirementsCheck : public AnswerCheck {
 public:
  explicit RequirementsCheck(const CheckContext& context)
      : AnswerCheck(CheckSection::requirements),
        context_(context),
        claims_(read_requirement_values(*context.spec, *context.claims)) {}

  [[nodiscard]] std::vector<std::uint64_t> more_cells() const override {
    std::vector<std::uint64_t> cells;
    for (const ResultRequirement& claim : claims_) {
      if (claim.path) cells.insert(cells.end(), claim.path->cell.begin(), claim.path->cell.end());
    }
    return cells;
  }
  void check_all(ThreadTeam& team) override {
    for (std::size_t r = 0; r < claims_.size(); ++r)
      findings_.push_back(RequirementChecker(context_, r, claims_[r], team).run(team));
  }
  [[nodiscard]] std::vector<Finding> findings() const override { return findings_; }

 private:
  const CheckContext& context_;
  std::vector<ResultRequirement> claims_;
  std::vector<Finding> findings_;
};

}  // namespace

/// Bytes a cell: whether the cell meets a region.
double requirements_check_memory(const ProblemSpec& spec) {
  return spec.requirements.empty() ? 0 : 1;
}

/// Checks the verdicts on requirements: regions by an evaluation of its own, verdicts from the delays in the
/// file, counterexamples step by step. If it stays open whether a cell meets the region, and the verdict
/// depends on the cell, the verdict counts as not confirmed. Verdicts are about the whole file, whichever
/// cells are sampled.
std::unique_ptr<AnswerCheck> check_requirements(const CheckContext& context) {
  return std::make_unique<RequirementsCheck>(context);
}

}  // namespace coordreq
