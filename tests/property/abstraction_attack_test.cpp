// The whole way from the text of a spec to resolved posts, attacked: a true state that can be measured in a
// cell is moved by a disturbance that varies within the period, leaves or stays by the rules of the domain,
// and is measured again. The cell that it is measured in must be in the post.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "property/random_dynamics.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/system_spec.hpp"
#include "support/without.hpp"

namespace coordreq {
namespace {

constexpr int kSpecs = 3;  ///< a case of RapidCheck
constexpr int kAttempts = 30;
constexpr int kSteps = 240;
constexpr IndexRange kEverything{std::numeric_limits<std::int32_t>::min(),
                                 std::numeric_limits<std::int32_t>::max()};

long double number(const Rational& q) {
  const double high = q.get_d();
  return static_cast<long double>(high) + static_cast<long double>(Rational(q - exact(high)).get_d());
}

/// -1, 1, or a number between.
long double draw_share() {
  return pick(2) == 0 ? 2.0L * pick(2) - 1.0L : pick_between(-1.0, 1.0, 101);
}

class Attack {
 public:
  Attack(const RandomDynamics& drawn, const Abstraction& abstraction) : drawn_(drawn), a_(abstraction) {}

  void run() {
    x_ = pick(static_cast<int>(a_.grid.cells()));
    u_ = pick(static_cast<int>(a_.inputs.count()));
    for (std::size_t i = 0; i < a_.grid.size(); ++i) {
      // May escape to infinity, after it has left: the pair is blocked.
      if (a_.raw(i, x_, u_) == kEverything) return;
    }
    if (!move()) return;
    bool blocked = false;
    for (std::size_t i = 0; i < a_.grid.size(); ++i) blocked = blocked || a_.resolved(i, x_, u_).blocked;
    bool absorbed = false;
    for (std::size_t i = 0; i < a_.grid.size(); ++i) absorbed = absorbed || leaves_safely(i);
    for (std::size_t i = 0; i < a_.grid.size(); ++i) {
      check_raw(i);
      if (!blocked) check_resolved(i, absorbed);
    }
  }

 private:
  /// A true state that can be measured in cell x_, and where it is after a period.
  /// @returns false if a periodic state passes its seam on the way, which this reference does not follow
  /// (simulated_flow does)
  bool move() {
    FlowCase system = drawn_.system;
    std::vector<long double> start;
    for (std::size_t i = 0; i < a_.grid.size(); ++i) start.push_back(draw_start(i));
    for (std::size_t i = 0; i < a_.inputs.size(); ++i) {
      const double value = a_.inputs[i].values[static_cast<std::size_t>(a_.inputs.index(u_, i))].get_d();
      system.slots[kInputSlot + i] = {value, value};
    }
    Signal signal = random_signal(system);
    if (drawn_.spec.dynamics.time == Time::discrete) {
      next_ = apply_map(system, start, signal.front());
      error_.assign(next_.size(), 1e-13L);
      return true;
    }
    const auto path = integrate(system, start, signal, kSteps);
    for (const auto& states : path) {
      if (passes_seam(states)) return false;
    }
    next_ = path.back();
    const auto coarse = integrate(system, start, signal, kSteps / 2).back();
    error_.clear();
    // The reference may jump or stop a step late, and then be off by a step's way.
    for (std::size_t i = 0; i < next_.size(); ++i) {
      error_.push_back(1e-9L + 2.0L * std::fabs(next_[i] - coarse[i]) +
                       4.0L / kSteps * std::fabs(next_[i] - start[i]));
    }
    return true;
  }

  [[nodiscard]] bool passes_seam(const std::vector<long double>& states) const {
    for (std::size_t i = 0; i < a_.grid.size(); ++i) {
      const GridDimension& dimension = a_.grid[i];
      if (!dimension.periodic()) continue;
      if (states[i] < number(dimension.lower) || states[i] >= number(dimension.upper)) return true;
    }
    return false;
  }

  long double draw_start(std::size_t i) const {
    const GridDimension& dimension = a_.grid[i];
    const long double reach = number(dimension.radius()) + number(dimension.measurement_error);
    // Rounding must not carry it over a face, as that may be the seam.
    const long double share = draw_share() * (1.0L - 1e-15L);
    long double value = number(dimension.point(a_.grid.index(x_, i))) + share * reach;
    if (dimension.periodic()) {
      const long double period = number(dimension.upper) - number(dimension.lower);
      value -= period * std::floor((value - number(dimension.lower)) / period);
    }
    if (dimension.below == Outside::stop) value = std::max(value, number(dimension.first));
    if (dimension.above == Outside::stop) value = std::min(value, last_point(i));
    return value;
  }

  static std::vector<long double> apply_map(const FlowCase& system, const std::vector<long double>& start,
                                            const std::vector<long double>& disturbance) {
    std::vector<Real> slots;
    for (const Interval& box : system.slots) slots.push_back({box.lower});
    for (std::size_t i = 0; i < start.size(); ++i) slots[i] = {start[i]};
    for (std::size_t l = 0; l < disturbance.size(); ++l) slots[kDisturbanceSlot + l] = {disturbance[l]};
    std::vector<long double> next;
    for (const Program& equation : system.equations) {
      next.push_back(Evaluator<Real>(equation).number(slots).value);
    }
    return next;
  }

  [[nodiscard]] long double last_point(std::size_t i) const {
    return number(a_.grid[i].point(a_.grid[i].count - 1));
  }
  [[nodiscard]] long double slack(std::size_t i) const { return error_[i] * (1.0L + std::fabs(next_[i])); }
  /// Cells from the first one's centre: cell k is [k - 1/2, k + 1/2].
  [[nodiscard]] long double position(std::size_t i, long double value) const {
    return (value - number(a_.grid[i].first)) / number(a_.grid[i].step);
  }

  /// The raw post, widened by the measurement error, holds the state itself and its neighbourhood.
  void check_raw(std::size_t i) {
    const GridDimension& dimension = a_.grid[i];
    const IndexRange range = a_.raw(i, x_, u_);
    const long double measured = next_[i] + draw_share() * number(dimension.measurement_error);
    const long double margin = slack(i) / number(dimension.step) + 0.5L;
    RC_ASSERT(range.first <= range.last);
    RC_ASSERT(!std::isnan(measured));
    const long double k = position(i, measured);
    const auto holds = [&](long double at) {
      return range.first - margin <= at && at <= range.last + margin;
    };
    bool held = holds(k);
    if (dimension.periodic()) {
      // The representatives around the beginning of the range.
      const auto count = static_cast<long double>(dimension.count);
      const long double turned = range.first + std::fmod(k - range.first, count);
      held = holds(turned - count) || holds(turned) || holds(turned + count);
    }
    if (!held) {
      RC_LOG(fmt::format("{} is measured at {} in cells, posted {} to {}; from cell {} under input {}\n",
                         dimension.name, static_cast<double>(k), range.first, range.last, x_, u_));
    }
    RC_ASSERT(held);
  }

  [[nodiscard]] bool leaves_safely(std::size_t i) const {
    const GridDimension& dimension = a_.grid[i];
    const long double k = position(i, next_[i]);
    return (dimension.below == Outside::safe && k < -0.5L) ||
           (dimension.above == Outside::safe && k > static_cast<long double>(dimension.count) - 0.5L);
  }

  /// The true state after the rules of the domain, or nothing if it has left.
  std::optional<long double> after_rules(std::size_t i) const {
    const GridDimension& dimension = a_.grid[i];
    const long double value = next_[i];
    if (dimension.periodic()) return value;
    const long double reach = 0.5L * number(dimension.step) + slack(i);
    const long double first = number(dimension.first);
    if (value < first) {
      if (dimension.below == Outside::saturate) return first;
      if (value < first - reach) return std::nullopt;
    }
    if (value > last_point(i)) {
      if (dimension.above == Outside::saturate) return last_point(i);
      if (value > last_point(i) + reach) return std::nullopt;
    }
    return value;
  }

  /// REQUIRES: the pair is not blocked.
  void check_resolved(std::size_t i, bool absorbed) {
    const GridDimension& dimension = a_.grid[i];
    const std::optional<long double> state = after_rules(i);
    if (!state) {
      // Not through an unsafe side: then the pair would be blocked.
      const bool below = next_[i] < number(dimension.first);
      const Outside side = below ? dimension.below : dimension.above;
      RC_ASSERT(side == Outside::safe || side == Outside::stop);
      return;
    }
    if (absorbed) return;
    const long double measured = *state + draw_share() * number(dimension.measurement_error);
    const long double k = position(i, measured);
    const long double nearest = std::round(k);
    if (std::fabs(k - nearest) > 0.5L - slack(i) / number(dimension.step))
      return;  // perhaps in the neighbour
    const IndexRange inside = a_.resolved(i, x_, u_).inside;
    auto cell = static_cast<std::int64_t>(nearest);
    if (dimension.periodic()) {
      cell = (cell % dimension.count + dimension.count) % dimension.count;
      RC_ASSERT((inside.first <= cell && cell <= inside.last) || cell + dimension.count <= inside.last);
      return;
    }
    const bool unsafe_below = dimension.below == Outside::unsafe && cell < 0;
    const bool unsafe_above = dimension.above == Outside::unsafe && cell >= dimension.count;
    RC_ASSERT(!unsafe_below && !unsafe_above);
    cell = std::clamp<std::int64_t>(cell, 0, dimension.count - 1);
    RC_ASSERT(inside.first <= cell);
    RC_ASSERT(cell <= inside.last);
  }

  const RandomDynamics& drawn_;
  const Abstraction& a_;
  std::int64_t x_ = 0;
  std::int64_t u_ = 0;
  std::vector<long double> next_;
  std::vector<long double> error_;  ///< of the simulation, relative to 1 + |next|
};

/// @returns whether there was an abstraction to attack
bool attack(const RandomDynamics& drawn, ThreadTeam& team) {
  RC_LOG(drawn.text + "\n");
  std::optional<Abstraction> abstraction;
  try {
    abstraction = build_abstraction(drawn.spec, team);
  } catch (const SpecError& error) {
    // Refused: the place is named, and nothing is not a number.
    const std::string text = error.what();
    RC_ASSERT(text.find("/dynamics/equations/") != std::string::npos);
    RC_ASSERT(text.find("nan") == std::string::npos);
    return false;
  }
  for (int k = 0; k < kAttempts; ++k) Attack(drawn, *abstraction).run();
  return true;
}

TEST(AbstractionAttack, SuccessorsOfTrueStatesAreMeasuredInThePost) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check([&] {
    int built = 0;
    for (int n = 0; n < kSpecs; ++n) built += attack(RandomDynamics::draw(), team) ? 1 : 0;
    RC_CLASSIFY(built == kSpecs, "all built");
  }));
}

TEST(AbstractionAttack, SuccessorsAreInThePostWithoutEachMeansToNarrowIt) {
  ThreadTeam team(1);
  std::vector<FastPath> paths;
  for (const FastPath& path : kFastPaths) {
    if (!path.keeps_results) paths.push_back(path);
  }
  std::size_t next = 0;
  EXPECT_TRUE(rc::check([&] {
    const FastPath& path = paths[next++ % paths.size()];
    RC_LOG(std::string("without ") + path.name + "\n");
    const Without off(path);
    RC_CLASSIFY(attack(RandomDynamics::draw(), team), "built");
  }));
}

}  // namespace
}  // namespace coordreq
