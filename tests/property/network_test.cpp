// The network as an automaton on random systems: rows against single pairs, and what must hold of it.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "answers/network/network_problem.hpp"
#include "answers/network/network_safety.hpp"
#include "answers/step_codes.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/draw.hpp"
#include "support/plain_posts.hpp"
#include "support/plain_silence.hpp"
#include "support/random_goal.hpp"
#include "support/random_problem.hpp"
#include "support/random_silence.hpp"

namespace coordreq {
namespace {

using Set = std::vector<bool>;

std::string with_network(std::string text, const std::string& network) {
  text.erase(text.rfind('}'));
  return text + R"(, "network": )" + network + "}";
}

/// Modes with partitions of these names and random transitions.
std::string draw_automaton(const std::vector<std::string>& partitions, bool resynthesise) {
  const int modes = draw(1, 4);
  std::string list;
  std::string transitions;
  for (int q = 0; q < modes; ++q) {
    const auto p = static_cast<std::size_t>(draw(0, static_cast<int>(partitions.size()) - 1));
    list += fmt::format(R"({}{{"name": "{}", "partition": "{}"}})", q == 0 ? "" : ", ", q, partitions[p]);
    const int sure = draw(0, modes - 1);
    for (int next = 0; next < modes; ++next) {
      if (next != sure && draw(0, 2) > 0) continue;
      transitions += fmt::format(R"({}["{}", "{}"])", transitions.empty() ? "" : ", ", q, next);
    }
  }
  return fmt::format(R"({{"modes": [{}], "transitions": [{}], "resynthesise": {}}})", list, transitions,
                     resynthesise);
}

std::string draw_losses(bool resynthesise) {
  const std::string tail = fmt::format(R"(, "resynthesise": {}}})", resynthesise);
  if (draw(0, 2) == 0) return fmt::format(R"({{"delay": {})", draw(0, 3)) + tail;
  if (draw(0, 1) == 0) {
    return fmt::format(R"({{"burst": {{"length": {}, "gap": {}}})", draw(1, 3), draw(1, 3)) + tail;
  }
  const int window = draw(1, 4);
  return fmt::format(R"({{"weakly_hard": {{"misses": {}, "window": {}}})", draw(0, window), window) + tail;
}

/// All partitions that the random problem lists, everyone alone, and all together.
std::vector<std::string> partition_names(const ProblemSpec& spec) {
  std::vector<std::string> names;
  for (const PartitionSpec& partition : spec.coordination.partitions) names.push_back(partition.name);
  std::string all;
  for (const AgentSpec& agent : spec.agents) all += (all.empty() ? "" : "+") + agent.name;
  names.push_back(all);
  return names;
}

/// W(q) by the row engine.
std::vector<Set> fast_network(const ProblemSpec& spec, const FastAnalysis& fast, ThreadTeam& team) {
  std::vector<Set> result;
  const NetworkProblem problem = network_problem(spec, fast.controller, fast.hull);
  for (const CellSet& set : find_network_safety(problem, {}, team).safe) result.push_back(members(set));
  return result;
}

std::int64_t size(const Set& set) {
  return std::count(set.begin(), set.end(), true);
}

bool is_subset(const Set& a, const Set& b) {
  for (std::size_t x = 0; x < a.size(); ++x) {
    if (a[x] && !b[x]) return false;
  }
  return true;
}

/// A network of either kind for a problem.
std::string draw_network(const std::string& problem, bool resynthesise) {
  if (draw(0, 1) == 0) return draw_losses(resynthesise);
  return draw_automaton(partition_names(read_spec(problem, "random")), resynthesise);
}

/// W(q) where agents act by rules in modes of more than one class, cell by cell.
class PlainRuleModes {
 public:
  PlainRuleModes(const ProblemSpec& spec, const FastAnalysis& fast)
      : spec_(spec),
        safe_(members(fast.safe)),
        beyond_(members(fast.beyond.value_or(fast.safe))),
        posts_{fast.abstraction, safe_, beyond_},
        plain_(plainly(spec, fast)),
        silence_(told_silence_plainly(spec, fast.abstraction, safe_, beyond_, plain_)) {}

  [[nodiscard]] const Set& invariant() const { return plain_.invariant; }
  [[nodiscard]] std::vector<Set> safe() const {
    std::vector<Set> sets(spec_.network->modes.size(), plain_.invariant);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t q = 0; q < sets.size(); ++q) {
        const Set target = target_of(q, sets);
        for (std::size_t x = 0; x < target.size(); ++x) {
          if (!sets[q][x] || stays(q, x, target)) continue;
          sets[q][x] = false;
          changed = true;
        }
      }
    }
    return sets;
  }

 private:
  [[nodiscard]] Set target_of(std::size_t q, const std::vector<Set>& sets) const {
    Set target(plain_.invariant.size(), true);
    for (const auto& [from, to] : spec_.network->transitions) {
      if (static_cast<std::size_t>(from) != q) continue;
      for (std::size_t x = 0; x < target.size(); ++x)
        target[x] = target[x] && sets[static_cast<std::size_t>(to)][x];
    }
    return target;
  }
  /// C(x) where all are one class, else A(x).
  [[nodiscard]] const std::vector<bool>& choices(std::size_t q, std::size_t x) const {
    const PartitionSpec& partition = spec_.network->modes[q].partition;
    if (partition.classes.size() == 1) return plain_.controller[x];
    const std::vector<PartitionSpec>& listed = spec_.coordination.partitions;
    const auto same = std::find_if(listed.begin(), listed.end(),
                                   [&](const auto& one) { return one.canonical == partition.canonical; });
    return silence_.partitions.at(static_cast<std::size_t>(same - listed.begin())).actions[x];
  }
  [[nodiscard]] bool stays(std::size_t q, std::size_t x, const Set& target) const {
    if (plain_.terminal[x]) return true;
    const std::vector<bool>& chosen = choices(q, x);
    for (std::size_t u = 0; u < chosen.size(); ++u) {
      const auto input = static_cast<std::int64_t>(u);
      if (chosen[u] &&
          (!plain_.permitted[x][u] || !posts_.stays_in(static_cast<std::int64_t>(x), input, target)))
        return false;
    }
    return std::find(chosen.begin(), chosen.end(), true) != chosen.end();
  }

  const ProblemSpec& spec_;
  Set safe_, beyond_;
  PlainPosts posts_;
  PlainAnalysis plain_;
  PlainSilence silence_;
};

TEST(Network, AgreesWhereAgentsActByRules) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("row engine equals plain engine", [&] {
    const std::string text = with_silence(perhaps_with_goal(draw_problem()));
    std::string network = draw_network(text, false);
    network.replace(network.rfind('}'), 1, R"(, "actions": "silence"})");
    const ProblemSpec spec = read_spec(with_network(text, network), "random");
    const FastAnalysis fast(spec, team);
    const PlainRuleModes plain(spec, fast);
    std::vector<Set> safe;
    for (const CellSet& set : fast.answers->get<NetworkSafety>().safe) safe.push_back(members(set));
    RC_ASSERT(safe == plain.safe());
    const bool is_telling = std::any_of(safe.begin(), safe.end(), [&](const Set& set) {
      return size(set) > 0 && size(set) < size(plain.invariant());
    });
    RC_CLASSIFY(is_telling, "some cells of K");
  }));
}

TEST(Network, AgreesWhereAGoalEndsTheTask) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("row engine equals plain engine, and the goal is in every mode", [&] {
    const std::string text = perhaps_with_goal(draw_problem());
    const ProblemSpec spec =
        read_spec(with_network(text, draw_network(text, *rc::gen::arbitrary<bool>())), "random");
    const FastAnalysis fast(spec, team);
    const PlainAnalysis plain = plainly(spec, fast);
    std::vector<Set> safe;
    for (const CellSet& set : fast.answers->get<NetworkSafety>().safe) {
      safe.push_back(members(set));
      RC_ASSERT(is_subset(plain.terminal, safe.back()));
    }
    RC_ASSERT(safe == plain.network);
    RC_CLASSIFY(size(plain.terminal) > 0 && size(safe.front()) < size(plain.invariant), "some cells of K");
  }));
}

TEST(Network, RowsAndSinglePairsGiveTheSameSets) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("row engine equals plain engine", [&] {
    const std::string text = draw_problem(draw(0, 3) == 0 ? RandomTime::between_samples : RandomTime::any);
    const FastAnalysis fast(read_spec(text, "random"), team);
    for (const bool resynthesise : {false, true}) {
      const ProblemSpec spec = read_spec(with_network(text, draw_network(text, resynthesise)), "random");
      const PlainAnalysis plain = analyze_plainly(spec, fast.abstraction, members(fast.safe),
                                                  members(fast.beyond.value_or(fast.safe)));
      const std::vector<Set> safe = fast_network(spec, fast, team);
      const std::int64_t invariant = size(plain.invariant);
      const bool is_telling = std::any_of(
          safe.begin(), safe.end(), [&](const Set& set) { return size(set) > 0 && size(set) < invariant; });
      RC_CLASSIFY(is_telling && !resynthesise, "some cells of K");
      RC_CLASSIFY(is_telling && resynthesise, "some cells of K, resynthesised");
      RC_ASSERT(safe == plain.network);
    }
  }));
}

/// The delay layers of the first partition, in which all are alone.
Set layer(const FastAnalysis& fast, std::int64_t k) {
  Set result;
  for (const std::int32_t delay : fast.delays(0)) result.push_back(delay >= k);
  return result;
}

/// A random problem whose layers are not cut off, and another network for it.
class Problem {
 public:
  explicit Problem(ThreadTeam& team) : team_(team) {
    text_ = draw_problem();
    const std::string key = R"("max_delay": )";
    const std::size_t begin = text_.find(key) + key.size();
    text_.replace(begin, text_.find(',', begin) - begin, "null");
    spec_ = read_spec(text_, "random");
    fast_.emplace(spec_, team);
  }

  [[nodiscard]] const FastAnalysis& fast() const { return *fast_; }
  [[nodiscard]] Set invariant() const { return members(fast_->invariance.invariant); }
  [[nodiscard]] std::vector<Set> safe(const std::string& network) const {
    const ProblemSpec spec = read_spec(with_network(text_, network), "random");
    return fast_network(spec, *fast_, team_);
  }
  [[nodiscard]] std::vector<std::string> partitions() const { return partition_names(spec_); }

 private:
  ThreadTeam& team_;
  std::string text_;
  ProblemSpec spec_;
  std::optional<FastAnalysis> fast_;
};

TEST(Network, WhatIsKnownOfSpecialNetworks) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("a delay of D steps gives Z_D, always up K, always down Z_F", [&] {
    const Problem problem(team);
    const int steps = draw(0, 4);
    const std::vector<Set> late = problem.safe(fmt::format(R"({{"delay": {}}})", steps));
    for (int k = 0; k <= steps; ++k)
      RC_ASSERT(late[static_cast<std::size_t>(k)] == layer(problem.fast(), steps - k));
    RC_ASSERT(late.back() == problem.invariant());
    RC_ASSERT(problem.safe(R"({"delay": 0, "resynthesise": true})")[0] == problem.invariant());
    const Set unbounded = layer(problem.fast(), kUnbounded);
    RC_ASSERT(problem.safe(R"({"modes": [{"name": "down", "partition": "alone"}],
"transitions": [["down", "down"]]})")[0] == unbounded);
    const int window = draw(1, 5);
    const std::vector<Set> hard =
        problem.safe(fmt::format(R"({{"weakly_hard": {{"misses": {0}, "window": {0}}}}})", window));
    // The mode of a lost step. That of a step that is not lost may have more: it has one step of contact.
    RC_ASSERT(hard[1] == unbounded);
    RC_ASSERT(is_subset(hard[1], hard[0]));
  }));
}

void expect_more_losses_give_less(const Problem& problem) {
  const auto burst = [&](int length, int gap) {
    return problem.safe(fmt::format(R"({{"burst": {{"length": {}, "gap": {}}}}})", length, gap))[0];
  };
  const auto hard = [&](int misses, int window) {
    return problem.safe(
        fmt::format(R"({{"weakly_hard": {{"misses": {}, "window": {}}}}})", misses, window))[0];
  };
  if (draw(0, 1) == 0) {
    const int length = draw(1, 3);
    const int gap = draw(1, 3);
    const Set safe = burst(length, gap);
    RC_ASSERT(is_subset(burst(length + 1, gap), safe));
    RC_ASSERT(is_subset(safe, burst(length, gap + 1)));
  } else {
    const int window = draw(2, 4);
    const int misses = draw(0, window - 1);
    const Set safe = hard(misses, window);
    RC_ASSERT(is_subset(hard(misses + 1, window), safe));
    RC_ASSERT(is_subset(safe, hard(misses, window + 1)));
  }
}

void expect_more_transitions_give_less(const Problem& problem) {
  std::string automaton = draw_automaton(problem.partitions(), false);
  const std::vector<Set> fewer = problem.safe(automaton);
  std::string all;
  for (std::size_t q = 0; q < fewer.size(); ++q) {
    for (std::size_t next = 0; next < fewer.size(); ++next)
      all += fmt::format(R"({}["{}", "{}"])", all.empty() ? "" : ", ", q, next);
  }
  automaton.replace(automaton.find(R"("transitions": )"), std::string::npos,
                    fmt::format(R"("transitions": [{}]}})", all));
  const std::vector<Set> more = problem.safe(automaton);
  for (std::size_t q = 0; q < fewer.size(); ++q) RC_ASSERT(is_subset(more[q], fewer[q]));
}

TEST(Network, MoreBehavioursNeverGiveMoreCells) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("more transitions, more losses", [&] {
    const Problem problem(team);
    draw(0, 1) == 0 ? expect_more_losses_give_less(problem) : expect_more_transitions_give_less(problem);
  }));
}

TEST(Network, CareNeverCostsACell) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("resynthesis gives at least as much", [&] {
    const Problem problem(team);
    std::string network = draw_losses(false);
    const std::vector<Set> plain = problem.safe(network);
    const std::vector<Set> careful = problem.safe(network.replace(network.rfind("false"), 5, "true"));
    bool more = false;
    for (std::size_t q = 0; q < plain.size(); ++q) {
      RC_ASSERT(is_subset(plain[q], careful[q]));
      RC_ASSERT(is_subset(careful[q], problem.invariant()));
      more = more || size(careful[q]) > size(plain[q]);
    }
    RC_CLASSIFY(more, "it gives more");
  }));
}

}  // namespace
}  // namespace coordreq
