#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <vector>

#include "answers/silence/answer.hpp"
#include "answers/step_codes.hpp"
#include "model/odometer.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/draw.hpp"
#include "support/plain_posts.hpp"
#include "support/plain_silence.hpp"
#include "support/random_goal.hpp"
#include "support/random_problem.hpp"
#include "support/random_silence.hpp"
#include "support/random_sums.hpp"

namespace coordreq {
namespace {

std::size_t nth(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

std::vector<std::int32_t> silence_values(const FastAnalysis& fast, const DelayLayers& layers) {
  std::vector<std::int32_t> result;
  for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
    const std::int64_t level = layers.layers_of.at(x);
    const std::int32_t outside = fast.safe.test(x) ? kOutsideInvariant : kOutsideSafe;
    result.push_back(level == LevelMap::kTop ? layers.top_delay()
                     : level == 0            ? outside
                                             : static_cast<std::int32_t>(level - 1));
  }
  return result;
}

PlainSilence plain_silence(const ProblemSpec& spec, const FastAnalysis& fast,
                           const PackedPairs* listed = nullptr) {
  return told_silence_plainly(spec, fast.abstraction, members(fast.safe),
                              members(fast.beyond.value_or(fast.safe)), plainly(spec, fast, listed));
}

void expect_same_silence(const ProblemSpec& spec, const FastAnalysis& fast, const PlainSilence& plain) {
  bool goes_on = false, is_bounded = false, is_without_action = false;
  RC_ASSERT(members(silence_set(*fast.answers)) == plain.set);
  for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
    const PlainSilence::Partition& expected = plain.partitions[p];
    const SilencePartition& own = silence_of(*fast.answers, p);
    RC_ASSERT(silence_values(fast, own.layers) == expected.silence);
    RC_ASSERT(own.layers.sizes == expected.sizes);
    RC_ASSERT(own.layers.fixed_point_index == expected.fixed_point_index);
    RC_ASSERT(own.layers.truncated == expected.truncated);
    std::int64_t without_action = 0;
    for (std::size_t x = 0; x < plain.set.size(); ++x) {
      const bool some = std::count(expected.actions[x].begin(), expected.actions[x].end(), true) > 0;
      without_action += plain.set[x] && !plain.terminal[x] && !some ? 1 : 0;
    }
    RC_ASSERT(std::accumulate(own.without_action.begin(), own.without_action.end(), std::int64_t{0}) ==
              without_action);
    is_without_action = is_without_action || without_action > 0;
    goes_on = goes_on || expected.sizes.size() > 2;
    is_bounded = is_bounded || expected.sizes.size() > 1;
  }
  RC_CLASSIFY(goes_on, "more than two layers");
  RC_CLASSIFY(is_bounded, "silence has an end");
  RC_CLASSIFY(is_without_action, "some cells have no action");
  RC_CLASSIFY(spec.silence->has_then(), "something comes after");
  const bool has_terminal = std::count(plain.terminal.begin(), plain.terminal.end(), true) > 0;
  RC_CLASSIFY(has_terminal && is_bounded, "a task that ends, and silence");
}

std::string draw_silence_problem() {
  const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
  const RandomAgents agents = *rc::gen::element(RandomAgents::few, RandomAgents::many);
  return with_silence(perhaps_with_goal(draw_problem(time, RandomEdges::any, agents)));
}

TEST(Silence, RowsAndSinglePairsGiveTheSameBits) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("silence of the row engine equals that of the plain one", [&] {
    const ProblemSpec spec = read_spec(draw_silence_problem(), "random");
    const FastAnalysis fast(spec, team);
    expect_same_silence(spec, fast, plain_silence(spec, fast));
  }));
}

TEST(Silence, AgreesOnListedPairs) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("silence with a controller from a file", [&] {
    const ProblemSpec spec = read_spec(draw_silence_problem(), "random");
    PackedPairs listed{.inputs = make_input_space(spec).count(), .bytes = {}};
    const std::int64_t cells = make_grid(spec).cells();
    listed.bytes.resize(nth(cells * listed.bytes_per_cell()));
    const int density = *rc::gen::inRange(3, 9);
    for (std::int64_t x = 0; x < cells; ++x) {
      for (std::int64_t u = 0; u < listed.inputs; ++u) {
        if ((x * 7919 + u * 104729) % 8 < density) listed.set(x, u);
      }
    }
    const FastAnalysis fast(spec, team, &listed);
    expect_same_silence(spec, fast, plain_silence(spec, fast, &listed));
  }));
}

TEST(Silence, AgreesOnAnySums) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("silence on hand-made sums", [&] {
    const ProblemSpec spec = read_spec(
        with_silence(perhaps_with_goal(draw_problem(RandomTime::any, RandomEdges::plain))), "random");
    RC_PRE(spec.states.size() > 1);
    Abstraction abstraction = build_abstraction(spec, team);
    draw_sums(abstraction);
    const FastAnalysis fast(spec, std::move(abstraction), team);
    expect_same_silence(spec, fast, plain_silence(spec, fast));
  }));
}

/// Where runs can be that begin in one cell, whatever agents choose of what they may. They end with the task.
class ToldRuns {
 public:
  ToldRuns(const ProblemSpec& spec, const FastAnalysis& fast)
      : fast_(fast),
        safe_(members(fast.safe)),
        safe_beyond_(members(fast.beyond.value_or(fast.safe))),
        plain_(plainly(spec, fast)),
        posts_{fast.abstraction, safe_, safe_beyond_} {}

  void begin(std::int64_t start) { cells_ = {start}; }

  /// All next cells. @returns false if one of them is not safe, or nothing can be chosen
  bool step(const std::vector<std::vector<bool>>& choices) {
    std::set<std::int64_t> next;
    for (const std::int64_t x : cells_) {
      if (plain_.terminal[nth(x)]) continue;
      bool some = false;
      for (std::int64_t u = 0; u < fast_.abstraction.inputs.count(); ++u) {
        if (!choices[nth(x)][nth(u)]) continue;
        some = true;
        if (!plain_.permitted[nth(x)][nth(u)] || !posts_.stays_in(x, u, safe_)) return false;
        add_post(x, u, next);
      }
      if (!some) return false;
    }
    cells_ = std::move(next);
    return true;
  }
  /// The same for ever.
  bool go_on(const std::vector<std::vector<bool>>& choices) {
    std::set<std::int64_t> all;
    while (!std::includes(all.begin(), all.end(), cells_.begin(), cells_.end())) {
      all.insert(cells_.begin(), cells_.end());
      if (!step(choices)) return false;
    }
    return true;
  }
  [[nodiscard]] const std::set<std::int64_t>& cells() const { return cells_; }

 private:
  void add_post(std::int64_t x, std::int64_t u, std::set<std::int64_t>& next) const {
    const UniformGrid& grid = fast_.abstraction.grid;
    std::vector<std::int64_t> counts, first;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const ResolvedRange range = fast_.abstraction.resolved(i, x, u);
      if (range.all_left()) return;
      first.push_back(range.inside.first);
      counts.push_back(range.inside.last - range.inside.first + 1);
    }
    Odometer index(counts);
    do {
      std::int64_t cell = 0;
      for (std::size_t i = 0; i < grid.size(); ++i)
        cell += (first[i] + index[i]) % grid[i].count * grid.stride(i);
      next.insert(cell);
    } while (index.advance());
  }

  const FastAnalysis& fast_;
  std::vector<bool> safe_, safe_beyond_;
  PlainAnalysis plain_;
  PlainPosts posts_;
  std::set<std::int64_t> cells_;
};

TEST(Silence, KeepsItsPromiseWhateverAgentsChoose) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("all runs of silent agents are safe, and so is what comes after", [&] {
    const ProblemSpec spec = read_spec(with_silence(perhaps_with_goal(draw_problem())), "random");
    const FastAnalysis fast(spec, team);
    const PlainSilence plain = plain_silence(spec, fast);
    const std::vector<std::int32_t> silence = silence_values(fast, silence_of(*fast.answers, 0).layers);
    ToldRuns runs(spec, fast);
    bool is_long = false;
    for (std::int64_t x = 0; x < fast.safe.cells(); ++x) {
      const std::int32_t steps = silence[nth(x)];
      if (steps < 0) continue;
      runs.begin(x);
      if (steps == INT32_MAX) {
        RC_ASSERT(runs.go_on(plain.partitions[0].actions));
        continue;
      }
      for (std::int32_t k = 0; k < steps; ++k) RC_ASSERT(runs.step(plain.partitions[0].actions));
      for (const std::int64_t y : runs.cells()) RC_ASSERT(plain.set[nth(y)]);
      if (spec.silence->has_then()) RC_ASSERT(runs.go_on(plain.then));
      is_long = is_long || steps > 1;
    }
    RC_CLASSIFY(is_long, "silence of several steps");
  }));
}

/// Two agents on a line, of which each moves by itself; apart by one or two. Every other pair goes one way
/// until the first one is at the end of the line, and stands still afterwards: silence of some steps.
nlohmann::json draw_pair() {
  nlohmann::json spec = nlohmann::json::parse(R"({"coordreq": 1, "name": "pair",
"states": [{"name": "x1", "lower": 0, "step": 1, "discrete": true}, {"name": "x2", "lower": 0, "step": 1, "discrete": true}],
"inputs": [{"name": "u1", "values": [-1, 0, 1]}, {"name": "u2", "values": [-1, 0, 1]}],
"agents": [{"name": "a", "inputs": ["u1"], "sees": ["x1"]}, {"name": "b", "inputs": ["u2"], "sees": ["x2"]}],
"dynamics": {"time": "discrete", "period": 1}})");
  const int last = draw(3, 5);
  const bool is_long = draw(0, 1) == 0;
  const std::string outside = is_long ? "saturate" : pick<std::string>({"saturate", "unsafe", "safe"});
  const int drift = is_long ? 0 : pick<int>({-1, 0, 0, 0, 1}), from = draw(0, last);
  for (const std::string number : {"1", "2"}) {
    nlohmann::json& state = spec["states"][number == "1" ? 0 : 1];
    state["upper"] = last;
    state["outside"] = outside == "safe" ? nlohmann::json{{"below", "saturate"}, {"above", "saturate"}}
                                         : nlohmann::json(outside);
    spec["dynamics"]["equations"]["x" + number] = "x" + number + " + u" + number + " + if(x" + number +
                                                  " >= " + std::to_string(from) + ", " +
                                                  std::to_string(drift) + ", 0)";
  }
  spec["safe"] = "abs(x1 - x2) >= " + std::to_string(draw(1, 2));
  const auto rules = [&](const std::vector<std::string>& all) {
    const std::string rule = pick(all);
    nlohmann::json result;
    for (const auto& [agent, number] : {std::pair("a", "1"), {"b", "2"}}) {
      std::string text = rule;
      for (std::size_t place = 0; (place = text.find('#')) != std::string::npos;)
        text.replace(place, 1, number);
      result[agent] = text;
    }
    return result;
  };
  const std::string middle = std::to_string(draw(1, 3));
  const std::vector<std::string> actions = {"true",    "u# <= 0", "u# >= 0",
                                            "u# == 0", "u# == 1", "x# > " + middle + " or u# == 0"};
  const std::vector<std::string> then = {"u# == 0", "u# == if(x# > " + middle + ", 1, -1)", "u# <= 0",
                                         "u# == -1"};
  spec["silence"]["actions"] = rules(is_long ? std::vector<std::string>{"u# == 1", "u# == -1"} : actions);
  spec["silence"]["then"] = rules(is_long ? std::vector<std::string>{"u# == 0"} : then);
  return spec;
}

/// Three agents each of which moves as one of a pair does: every run of all of them that does what the
/// theorem says keeps every pair safe (contract, section 9).
class Fleet {
 public:
  Fleet(const ProblemSpec& spec, const FastAnalysis& fast)
      : fast_(fast), plain_(plain_silence(spec, fast)), last_(spec.states[0].grid.count - 1) {}

  /// What one agent may do at a place: as the first one of a pair, whoever the other one is.
  [[nodiscard]] std::vector<std::int64_t> choices(const std::vector<std::vector<bool>>& joint,
                                                  std::int64_t place) const {
    std::set<std::int64_t> own;
    for (std::int64_t u = 0; u < 9; ++u) {
      if (joint[nth(place * (last_ + 1))][nth(u)]) own.insert(u / 3);
    }
    return {own.begin(), own.end()};
  }
  /// Where it is next; negative: it leaves its line.
  [[nodiscard]] std::int64_t next(std::int64_t place, std::int64_t action) const {
    const ResolvedRange range = fast_.abstraction.resolved(0, place * (last_ + 1), action * 3);
    return range.blocked ? -1 : range.inside.first;
  }
  [[nodiscard]] bool is_safe(const std::vector<std::int64_t>& places) const {
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < places.size(); ++j) {
        if (i != j && !fast_.safe.test(places[i] * (last_ + 1) + places[j])) return false;
      }
    }
    return true;
  }
  [[nodiscard]] std::int32_t least_silence(const std::vector<std::int64_t>& places) const {
    std::int32_t least = INT32_MAX;
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < places.size(); ++j) {
        if (i != j)
          least = std::min(least, plain_.partitions[0].silence[nth(places[i] * (last_ + 1) + places[j])]);
      }
    }
    return least;
  }

  /// Whether all runs are safe: so many steps of `actions`, then `then` for ever.
  [[nodiscard]] bool keeps_apart(const std::vector<std::int64_t>& start, std::int32_t steps) const {
    std::set<std::vector<std::int64_t>> places = {start}, all;
    for (std::int32_t k = 0; k < std::min(steps, 40); ++k) {
      if (!step(plain_.partitions[0].actions, places)) return false;
    }
    if (steps == INT32_MAX) return true;
    while (!std::includes(all.begin(), all.end(), places.begin(), places.end())) {
      all.insert(places.begin(), places.end());
      if (!step(plain_.then, places)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool step(const std::vector<std::vector<bool>>& joint,
                          std::set<std::vector<std::int64_t>>& places) const {
    std::set<std::vector<std::int64_t>> result;
    for (const std::vector<std::int64_t>& now : places) {
      std::vector<std::vector<std::int64_t>> open = {{}};
      for (const std::int64_t place : now) {
        std::vector<std::vector<std::int64_t>> longer;
        for (const std::int64_t action : choices(joint, place)) {
          for (std::vector<std::int64_t> before : open) {
            before.push_back(next(place, action));
            if (before.back() < 0) return false;
            longer.push_back(std::move(before));
          }
        }
        open = std::move(longer);
      }
      if (open.empty()) return false;
      for (std::vector<std::int64_t>& one : open) {
        if (!is_safe(one)) return false;
        result.insert(std::move(one));
      }
    }
    places = std::move(result);
    return true;
  }

  const FastAnalysis& fast_;
  PlainSilence plain_;
  std::int64_t last_;
};

TEST(Silence, OfAllPairsIsThatOfTheFleet) {
  ThreadTeam team(1);
  int long_ones = 0, tried = 0;
  EXPECT_TRUE(rc::check("three agents, of which all pairs have so much silence", [&] {
    const ProblemSpec spec = read_spec(draw_pair().dump(), "pair");
    const FastAnalysis fast(spec, team);
    const Fleet fleet(spec, fast);
    bool is_long = false;
    const std::int64_t places = spec.states[0].grid.count;
    for (std::int64_t x = 0; x < places * places * places; ++x) {
      const std::vector<std::int64_t> start = {x / (places * places), x / places % places, x % places};
      const std::int32_t least = fleet.least_silence(start);
      if (least < 0) continue;
      RC_ASSERT(fleet.keeps_apart(start, least));
      is_long = is_long || (least > 0 && least != INT32_MAX);
    }
    RC_CLASSIFY(is_long, "fleets that may be silent for some steps");
    ++tried;
    long_ones += is_long ? 1 : 0;
  }));
  EXPECT_GE(10 * long_ones, tried);  // else it says little
}

}  // namespace
}  // namespace coordreq
