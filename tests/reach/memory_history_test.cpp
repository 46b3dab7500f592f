#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <map>

#include "base/thread_team.hpp"
#include "expression/cell_truth.hpp"
#include "model/condition_table.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

using History = std::vector<Truth>;

/// A memory over a continuous state x in -2..2 with closed cells of width 1, and a discrete one p in 0..2.
ProblemSpec with_memory(const std::string& formula, const std::string& safe = "inner") {
  return read_spec(R"({"coordreq": 1, "name": "t", "constants": {"N": 2}, "states": [
{"name": "x", "lower": -2, "upper": 2, "step": 1}, {"name": "p", "lower": 0, "upper": 2, "step": 1, "discrete": true}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "u", "p": "u"}},
"memory": {"m": ")" + formula +
                       R"("}, "safe": "m or not m", "abstraction": {"safe": ")" + safe + R"("}})",
                   "test");
}

/// Follows cells (indices of x and p) and tells the truth of the memory at each sample.
History follow(const ProblemSpec& spec, const std::vector<std::pair<int, int>>& cells) {
  ThreadTeam team(1);
  const Abstraction a = build_abstraction(spec, team);
  const bool centres = spec.abstraction.safe == Membership::center;
  CellTruth truth(spec.memory.front().truth,
                  condition_axes(a.grid, a.inputs, centres ? Sampling::centres : Sampling::closed_cells));
  std::vector<std::int64_t> indices(spec.slot_count(), 0);
  History history;
  for (const auto& [x, p] : cells) {
    indices[0] = x;
    indices[1] = p;
    history.push_back(truth.at(indices));
    std::int64_t cell = 0;
    for (std::size_t i = 0; i < a.grid.size(); ++i) cell += indices[i] * a.grid.stride(i);
    for (std::size_t i = 2; i < a.grid.size(); ++i) {
      const IndexRange kept = a.raw(i, cell, 0);
      EXPECT_EQ(kept.first, kept.last);
      EXPECT_TRUE(kept.first >= 0 && kept.first < a.grid[i].count);
      indices[i] = kept.first;
    }
  }
  return history;
}

std::string letters(const History& history) {
  std::string text;
  for (const Truth truth : history) text += truth == Truth::yes ? 'T' : truth == Truth::no ? 'F' : '?';
  return text;
}

TEST(Memory, OperatorsOverAShortHistory) {
  const std::vector<std::pair<int, int>> cells{{0, 0}, {0, 1}, {0, 0}, {0, 0}};  // p == 1: F T F F
  const auto letters_of = [&](const std::string& formula) {
    return letters(follow(with_memory(formula), cells));
  };
  EXPECT_EQ(letters_of("p == 1"), "FTFF");
  EXPECT_EQ(letters_of("once(p == 1)"), "FTTT");
  EXPECT_EQ(letters_of("always(not p == 1)"), "TFFF");
  EXPECT_EQ(letters_of("previous(p == 1)"), "FFTF");
  EXPECT_EQ(letters_of("within(2, p == 1)"), "FTTF");
  EXPECT_EQ(letters_of("for_last(N, not p == 1)"), "FFFT");
  EXPECT_EQ(letters_of("since(not p == 1, p == 1)"), "FTTT");
  EXPECT_EQ(letters_of("within(1, p == 1)"), "FTFF");
}

TEST(Memory, WhatIsUndecidedIsRememberedAsUndecided) {
  const std::vector<std::pair<int, int>> cells{{1, 0}, {2, 0}, {3, 0}, {3, 0}};  // x > 0.2: F ? T T
  EXPECT_EQ(letters(follow(with_memory("previous(x > 0.2)"), cells)), "FF?T");
  EXPECT_EQ(letters(follow(with_memory("for_last(2, x > 0.2)"), cells)), "FF?T");
  EXPECT_EQ(letters(follow(with_memory("within(2, not x > 0.2)"), cells)), "TT?F");
  EXPECT_EQ(letters(follow(with_memory("previous(x > 0.2)", "center"), cells)), "FFFT");
}

// --- random formulas over whole histories

struct RandomFormula {
  std::string text;
  /// The truth at every sample, from the definitions.
  std::function<History(const std::vector<std::pair<int, int>>&)> over;
};

/// x > q/4 on the closed cell of width 1 at x.
Truth above(int x, int quarters) {
  if (4 * x - 2 > quarters) return Truth::yes;
  return 4 * x + 2 <= quarters ? Truth::no : Truth::undecided;
}

template <class At>
RandomFormula formula_of(std::string text, At at) {
  return {std::move(text), [at](const std::vector<std::pair<int, int>>& cells) {
            History history;
            for (const auto& cell : cells) history.push_back(at(cell));
            return history;
          }};
}

RandomFormula joined(const std::string& text, const RandomFormula& a, const RandomFormula& b,
                     const std::function<Truth(const History&, const History&, std::size_t)>& at) {
  return {text, [=](const std::vector<std::pair<int, int>>& cells) {
            const History one = a.over(cells), other = b.over(cells);
            History history;
            for (std::size_t k = 0; k < cells.size(); ++k) history.push_back(at(one, other, k));
            return history;
          }};
}

RandomFormula random_formula(int depth) {
  const int kind = *rc::gen::inRange(0, depth == 0 ? 2 : 11);
  if (kind == 0) {
    const int quarters = *rc::gen::inRange(-6, 7);
    return formula_of("x > " + std::to_string(quarters) + "/4",
                      [=](const std::pair<int, int>& cell) { return above(cell.first - 2, quarters); });
  }
  if (kind == 1) {
    const int value = *rc::gen::inRange(0, 3);
    return formula_of("p == " + std::to_string(value),
                      [=](const std::pair<int, int>& cell) { return to_truth(cell.second == value); });
  }
  const RandomFormula a = random_formula(depth - 1);
  const RandomFormula b = kind <= 4 ? random_formula(depth - 1) : a;
  const std::string one = "(" + a.text + ")";
  const int n = *rc::gen::inRange(1, 4);
  const auto counted = [&](const std::string& name) {
    return name + "(" + std::to_string(n) + ", " + a.text + ")";
  };
  switch (kind) {
    case 2:
      return joined(one + " and (" + b.text + ")", a, b,
                    [](const History& x, const History& y, std::size_t k) { return truth_and(x[k], y[k]); });
    case 3:
      return joined(one + " or (" + b.text + ")", a, b,
                    [](const History& x, const History& y, std::size_t k) { return truth_or(x[k], y[k]); });
    case 4:
      return joined("since(" + a.text + ", " + b.text + ")", a, b,
                    [](const History& x, const History& y, std::size_t k) {
                      Truth any = Truth::no;
                      for (std::size_t j = 0; j <= k; ++j) {
                        Truth all = y[j];
                        for (std::size_t i = j + 1; i <= k; ++i) all = truth_and(all, x[i]);
                        any = truth_or(any, all);
                      }
                      return any;
                    });
    case 5:
      return joined("not " + one, a, a,
                    [](const History& x, const History&, std::size_t k) { return !x[k]; });
    case 6:
      return joined("previous(" + a.text + ")", a, a, [](const History& x, const History&, std::size_t k) {
        return k == 0 ? Truth::no : x[k - 1];
      });
    default:
      break;
  }
  const bool all = kind == 8 || kind == 10;
  const bool is_counted = kind >= 9;
  const std::string name = kind == 7 ? "once" : kind == 8 ? "always" : kind == 9 ? "within" : "for_last";
  const std::string text = is_counted ? counted(name) : name + "(" + a.text + ")";
  return joined(text, a, a, [=](const History& x, const History&, std::size_t k) {
    const std::size_t samples = is_counted ? static_cast<std::size_t>(n) : k + 1;
    if (all && k + 1 < samples) return Truth::no;
    Truth truth = to_truth(all);
    for (std::size_t j = 0; j < samples && j <= k; ++j)
      truth = all ? truth_and(truth, x[k - j]) : truth_or(truth, x[k - j]);
    return truth;
  });
}

RC_GTEST_PROP(Memory, AgreesWithWholeHistories, ()) {
  const RandomFormula formula = random_formula(*rc::gen::inRange(0, 4));
  const ProblemSpec spec = with_memory(formula.text);
  RC_PRE(spec.states.size() < 9);  // the table of the whole grid is not what is tested
  std::vector<std::pair<int, int>> cells;
  for (int k = 0; k < 9; ++k) cells.emplace_back(*rc::gen::inRange(0, 5), *rc::gen::inRange(0, 3));
  RC_LOG() << formula.text << '\n';
  RC_ASSERT(letters(follow(spec, cells)) == letters(formula.over(cells)));
}

}  // namespace
}  // namespace coordreq
