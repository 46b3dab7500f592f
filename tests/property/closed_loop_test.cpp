// The paper's propositions on random systems, seen from the system itself: self-triggered runs from K stay in
// K, and cells of delay k tolerate k steps of any choices in IND_C.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/layers/answer.hpp"
#include "answers/paths.hpp"
#include "cell/closed_loop.hpp"
#include "model/locate.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"
#include "support/members.hpp"
#include "support/plain_engine.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

/// A random problem, its agents with preferences, analysed the plain way.
struct Analysed {
  explicit Analysed(ThreadTeam& team, RandomTime kind = RandomTime::any)
      : spec(read_spec(with_preferences(draw_problem(kind)), "random")),
        abstraction(build_abstraction(spec, team)),
        safe(safe_set(spec, abstraction, team)),
        beyond(safe_beyond_limits(spec, abstraction, safe, team)),
        plain(analyze_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)))) {}

  static std::string with_preferences(std::string text) {
    const std::string agents = R"("agents": [{)";
    text.insert(text.find(agents) + agents.size(), R"json("prefer": "abs(x0 - 3)", )json");
    return text;
  }

  [[nodiscard]] bool is_empty() const {
    return std::count(plain.invariant.begin(), plain.invariant.end(), true) == 0;
  }

  [[nodiscard]] LoopProblem problem(std::size_t partition) const {
    return {.spec = &spec,
            .abstraction = &abstraction,
            .partition = &spec.coordination.partitions[partition],
            .policies = layer_policies(spec),
            .values = {{paths::kDelay, plain.partitions[partition].delay}},
            .safe_beyond = beyond ? &*beyond : nullptr,
            .connection_delay = spec.coordination.connection_delay};
  }

  ProblemSpec spec;
  Abstraction abstraction;
  CellSet safe;
  std::optional<CellSet> beyond;
  PlainAnalysis plain;
};

std::int64_t cell_of(const UniformGrid& grid, const std::vector<double>& measured) {
  std::vector<Rational> state(measured.begin(), measured.end());
  return locate(grid, state).cell;
}

/// What is done is in C(x), or, where nobody coordinates, in its projections, of the cell that was measured.
void expect_admissible(const Analysed& analysed, std::size_t p, const RunTrace& trace) {
  const Abstraction& a = analysed.abstraction;
  const PlainAnalysis& plain = analysed.plain;
  const auto classes = input_classes(analysed.spec, a.inputs, analysed.spec.coordination.partitions[p]);
  for (std::size_t k = 0; k < trace.steps.size(); ++k) {
    const auto x = static_cast<std::size_t>(cell_of(a.grid, trace.samples[k].measured));
    const std::int64_t u = trace.steps[k].input;
    if (trace.steps[k].coordinated) RC_ASSERT(plain.controller[x][static_cast<std::size_t>(u)]);
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const std::vector<std::int64_t> action = classes[c].project({u});
      RC_ASSERT(plain.partitions[p].projection[c][x][static_cast<std::size_t>(action.front())]);
    }
  }
}

void expect_sound(const Analysed& analysed, const RunTrace& trace) {
  RC_ASSERT(!is_violation(trace.outcome));
  const std::size_t count = trace.samples.size() - (trace.outcome == Outcome::left_safely ? 1 : 0);
  for (std::size_t k = 0; k < count; ++k) {
    const RunTrace::Sample& sample = trace.samples[k];
    RC_ASSERT(sample.delay >= sample.countdown);
    // Every point of a cell in S is safe unless only centres were asked.
    RC_ASSERT(analysed.spec.abstraction.safe == Membership::center || sample.margin >= 0);
  }
}

void expect_runs_stay(RandomTime time) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("runs stay in K", [&] {
    const Analysed analysed(team, time);
    RC_CLASSIFY(!analysed.is_empty(), "K not empty");
    RC_CLASSIFY(!analysed.spec.disturbances.empty(), "disturbed");
    if (analysed.is_empty()) return;
    bool silent = false;
    bool coordinated = false;
    for (std::size_t p = 0; p < analysed.plain.partitions.size(); ++p) {
      for (const Policy policy : {Policy::random, Policy::adversarial, Policy::prefer}) {
        for (const Disturbance kind : {Disturbance::random, Disturbance::extremes}) {
          const LoopOptions options{.steps = 12, .policy = policy, .disturbance = kind, .seed = p, .runs = 4};
          for (const RunTrace& trace : simulate_runs(analysed.problem(p), options, team)) {
            expect_sound(analysed, trace);
            expect_admissible(analysed, p, trace);
            coordinated = coordinated || trace.coordinated_steps() > 0;
            silent = silent || trace.longest_silence() > 0;
          }
        }
      }
    }
    RC_CLASSIFY(silent && coordinated, "silent and coordinated");
  }));
}

TEST(ClosedLoop, NoSelfTriggeredRunFromKLeavesIt) {
  expect_runs_stay(RandomTime::any);
}

TEST(ClosedLoop, NoSelfTriggeredRunThatIsSafeBetweenTheSamplesLeavesIt) {
  expect_runs_stay(RandomTime::between_samples);
}

void expect_plain_inputs(RandomTime kind) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("C(x) and IND_C(x) cell by cell", [&] {
    const Analysed analysed(team, kind);
    RC_CLASSIFY(!analysed.is_empty(), "K not empty");
    const PlainAnalysis& plain = analysed.plain;
    const UniformGrid& grid = analysed.abstraction.grid;
    MembersByCell invariant(
        grid, [&plain](std::int64_t x) { return plain.invariant[static_cast<std::size_t>(x)]; });
    MembersByCell safe(grid, [&analysed](std::int64_t x) { return analysed.safe.test(x); });
    MembersByCell beyond(grid, [&analysed](std::int64_t x) { return analysed.beyond->test(x); });
    CellPosts posts(analysed.abstraction);
    AdmissibleInputs::Sets sets{.invariant = &invariant, .safe = &safe};
    if (analysed.beyond) sets.safe_beyond = [&beyond] { return &beyond; };
    AdmissibleInputs inputs(analysed.spec, posts, sets);
    for (std::size_t x = 0; x < plain.invariant.size(); ++x) {
      if (!plain.invariant[x]) continue;
      const std::vector<std::int64_t>& found = inputs.of(static_cast<std::int64_t>(x));
      std::vector<bool> set(plain.controller[x].size(), false);
      for (const std::int64_t u : found) set[static_cast<std::size_t>(u)] = true;
      RC_ASSERT(set == plain.controller[x]);
      RC_ASSERT(std::is_sorted(found.begin(), found.end()));
      for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
        const auto classes = input_classes(analysed.spec, analysed.abstraction.inputs,
                                           analysed.spec.coordination.partitions[p]);
        for (std::size_t c = 0; c < classes.size(); ++c) {
          std::vector<bool> actions(static_cast<std::size_t>(classes[c].actions()), false);
          for (const std::int64_t a : classes[c].project(found)) actions[static_cast<std::size_t>(a)] = true;
          RC_ASSERT(actions == plain.partitions[p].projection[c][x]);
        }
      }
    }
  }));
}

TEST(AdmissibleInputs, AreThoseOfThePlainEngineAndSoAreTheirProjections) {
  expect_plain_inputs(RandomTime::any);
}

TEST(AdmissibleInputs, HaveSafeTubes) {
  expect_plain_inputs(RandomTime::between_samples);
}

}  // namespace
}  // namespace coordreq
