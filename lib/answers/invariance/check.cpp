#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/invariance/check_safe.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Findings that all threads share.
struct SetTallies {
  Tally safe{"S"};
  Tally invariant{"K"};
  Tally collision_time{"collision time"};
  Tally controller{"controller"};
};

class SetChecker : public CellChecker {
 public:
  SetChecker(const CheckContext& context, SetTallies& tallies, SafeMemory& memory)
      : context_(context),
        invariant_(context.claims->members("/invariant")),
        collision_time_(context.claims->values("/collision_time")),
        controller_(context.claims->bits("/controller")),
        tallies_(tallies),
        judge_(*context.spec, context.spec->safe, *context.grid, memory) {}

  void check(CheckedCell& cell) override {
    check_safe(cell);
    if (!cell.is_safe()) {
      check_outside(cell);
    } else if (!cell.is_invariant()) {
      check_escape(cell);
    } else if (cell.is_terminal()) {  // the check of the goal checks that it is
      tallies_.invariant.add_checked(1);
      check_collision_time(cell, kUnbounded);
    } else {
      check_stay(cell);
    }
    if (controller_ != nullptr) check_controller(cell);
  }

 private:
  void check_safe(const CheckedCell& cell) {
    tallies_.safe.add_checked(1);
    const SafeVerdict verdict = judge_.judge(cell.number(), cell.is_safe());
    if (!cell.is_safe() && verdict == SafeVerdict::safe) {
      add_wrong(tallies_.safe, cell, "not in S, but it is safe");
    } else if (cell.is_safe() && verdict == SafeVerdict::unsafe) {
      add_wrong(tallies_.safe, cell, "in S, but it is not safe");
    } else if (cell.is_safe() && verdict == SafeVerdict::open) {
      tallies_.safe.add_unproven();
    }
  }

  void check_outside(const CheckedCell& cell) {
    tallies_.invariant.add_checked(1);
    if (invariant_[cell.at()] != 0) add_wrong(tallies_.invariant, cell, "in K, but not in S");
    check_collision_time(cell, 0);
  }

  /// Checks a cell of S outside K: that no coordination keeps it safe.
  void check_escape(CheckedCell& cell) {
    const bool maximal = context_.spec->controller.synthesis == Synthesis::maximal;
    bool any = false;
    std::int32_t best = maximal ? 0 : kUnbounded;
    for (std::int64_t u = 0; u < context_.inputs->count(); ++u) {
      if (!cell.is_allowed(u)) continue;
      any = true;
      const std::int32_t time = cell.least(u, collision_time_, 0);
      best = maximal ? std::max(best, time) : std::min(best, time);
    }
    tallies_.invariant.add_checked(1);
    if (any && best == kUnbounded) {
      if (context_.sound_only()) {
        tallies_.invariant.add_unproven();
      } else {
        add_wrong(tallies_.invariant, cell, "not in K, but coordinating agents can stay in K indefinitely");
      }
    }
    check_collision_time(cell, any ? one_more(best) : 1);
  }

  /// Checks a cell of K: that it can be kept in K.
  void check_stay(const CheckedCell& cell) {
    check_collision_time(cell, kUnbounded);
    tallies_.invariant.add_checked(1);
    if (context_.spec->controller.synthesis == Synthesis::given && !cell.all_stay())
      add_wrong(tallies_.invariant, cell, "in K, but an allowed input leads out of it");
    if (std::find(cell.admitted().begin(), cell.admitted().end(), 1) == cell.admitted().end())
      add_wrong(tallies_.invariant, cell, "in K, but no allowed input keeps it there");
  }

  void check_collision_time(const CheckedCell& cell, std::int32_t expected) {
    tallies_.collision_time.add_checked(1);
    const std::int32_t claimed = collision_time_[cell.at()];
    if (claimed == expected) return;
    if (context_.sound_only() && claimed < expected && claimed > 0) {
      tallies_.collision_time.add_unproven();
      return;
    }
    tallies_.collision_time.add_wrong(cell.number(), [&] {
      return fmt::format("{}: {}, expected {}", cell.location(), step_text(claimed), step_text(expected));
    });
  }

  void check_controller(const CheckedCell& cell) {
    add_choices(context_, tallies_.controller, cell, compare_bits(*controller_, cell.at(), cell.admitted()),
                "joint inputs");
  }

  const CheckContext& context_;
  const std::vector<std::uint8_t>& invariant_;
  const std::vector<std::int32_t>& collision_time_;
  const std::vector<std::uint8_t>* controller_;  ///< null: not stored
  SetTallies& tallies_;
  SafeJudge judge_;
};

class InvarianceCheck : public AnswerCheck {
 public:
  explicit InvarianceCheck(const CheckContext& context)
      : AnswerCheck(CheckSection::sets), context_(context), memory_(context.spec->safe, *context.grid) {}

  std::vector<Finding> compare_sizes(Comparison& sizes) override {
    const Claims& claims = *context_.claims;
    for (const auto& [label, path] : {std::pair("|S|", "/safe"), std::pair("|K|", "/invariant")})
      sizes.expect(label, claims.at(path).cells.front(), count_members(claims.members(path)));
    std::int64_t last = 0;
    for (const std::int32_t time : claims.values("/collision_time")) {
      if (time != kUnbounded) last = std::max(last, std::int64_t{time});
    }
    sizes.expect("iterations", claims.attribute("/collision_time", "iterations"),
                 last + 1);  // the last sweep removes nothing
    return {};
  }
  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<SetChecker>(context_, tallies_, memory_);
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result = {tallies_.safe.finding(), tallies_.invariant.finding(),
                                   tallies_.collision_time.finding()};
    if (context_.claims->has("/controller")) result.push_back(tallies_.controller.finding());
    return result;
  }

 private:
  const CheckContext& context_;
  SafeMemory memory_;
  SetTallies tallies_;
};

}  // namespace

/// Checks S, K, collision times and C(x), straight from the definitions, one cell after the other and for
/// each every joint input. A pair without post is worth 0; a pair that has left safely, and every cell of K,
/// are worth infinity:
/// - S by its definition;
/// - each cell of K keeps an allowed input whose post lies in K (`given`: every allowed input, and there is
///   one);
/// - for x in S but not in K: collision_time(x) = 1 + max (`given`: min) over allowed u of min over y in f(x,
///   u) of collision_time(y), 1 without allowed inputs. By induction on the time, no cell outside K could be
///   in a larger K;
/// - a stored controller has the inputs of C(x);
/// - |S|, |K| and the number of sweeps against the cells.
std::unique_ptr<AnswerCheck> check_invariance(const CheckContext& context) {
  return std::make_unique<InvarianceCheck>(context);
}

}  // namespace coordreq
