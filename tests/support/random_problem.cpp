#include "support/random_problem.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <vector>

#include "support/draw.hpp"

namespace coordreq {
namespace {

class ProblemWriter {
 public:
  std::string write(RandomTime kind, RandomEdges edges, RandomAgents agents_drawn) {
    edges_ = edges;
    crowd_ = agents_drawn == RandomAgents::many;
    const bool between_samples = kind == RandomTime::between_samples;
    continuous_time_ = between_samples || (kind == RandomTime::any && draw(0, 3) == 0);
    // Most problems are agents that share a plane: those have layers.
    plane_ = crowd_ || draw(0, 2) > 0;
    coupled_ = draw(0, 2) == 0;
    states_ = crowd_ ? draw(2, 4) : plane_ ? draw(2, 3) : draw(1, 3);
    for (int i = 0; i < states_; ++i) add_state(i);
    const int inputs = crowd_                            ? std::max(states_, draw(3, 4))
                       : !plane_                         ? draw(1, 3)
                       : states_ == 2 && draw(0, 2) == 0 ? 3
                                                         : states_;
    for (int i = 0; i < inputs; ++i) add_input(i);
    const bool disturbed = draw(0, 2) == 0;
    const std::string cells =
        crowd_ && draw(0, 1) == 0 ? "half_open" : pick<std::string>({"closed", "half_open"});
    const std::string safe = pick<std::string>({"inner", "center"});
    std::string text = fmt::format(
        R"({{"coordreq": 1, "name": "random",
"states": [{}],
"inputs": [{}],
"disturbances": [{}],
"agents": [{}],
"dynamics": {{"time": "{}", "period": {}, "equations": {{{}}}}},
"safe": "{}",
"abstraction": {{"cells": "{}", "safe": "{}", "between_samples": {}, "effort": {}}},
"controller": {{"synthesis": "{}", "allow": "{}"}},
"coordination": {{{}}}}})",
        join(state_text_), join(input_text_),
        disturbed ? R"({"name": "w", "lower": -0.25, "upper": 0.5})" : "", agents(),
        continuous_time_ ? "continuous" : "discrete", pick<std::string>({"1", "0.5"}), equations(disturbed),
        safe_condition(), cells, safe, between_samples, effort(), draw(0, 3) == 0 ? "given" : "maximal",
        allow_condition(), coordination());
    return text;
  }

 private:
  /// Dividing cells is most of the work where it is done, and nothing that comes after a post depends on it.
  static int effort() { return draw(0, 7) == 0 ? 200 : 0; }

  static std::string join(const std::vector<std::string>& parts) {
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  void add_state(int i) {
    // So that all in all there are not too many cells for a plain engine.
    const int most_of_crowd = states_ == 2 ? 9 : states_ == 3 ? 6 : 4;
    const int count = crowd_            ? draw(most_of_crowd - 1, most_of_crowd)
                      : plane_          ? draw(6, 11)
                      : draw(0, 9) == 0 ? draw(1, 2)
                                        : draw(4, 9);
    const bool discrete = !continuous_time_ && !plane_ && draw(0, 2) == 0;
    discrete_.push_back(discrete);
    const bool any_edge = edges_ == RandomEdges::any;
    const std::string error = any_edge && !discrete && draw(0, 5) == 0 ? "0.25" : "0";
    const std::string common = fmt::format(
        R"("name": "x{}", "discrete": {}, "measurement_error": {}, "lower": 0)", i, discrete, error);
    if (any_edge && draw(0, 3) == 0) {
      state_text_.push_back(
          fmt::format(R"({{{}, "upper": {}, "count": {}, "outside": "periodic"}})", common, count, count));
      return;
    }
    // Where nothing can be lost at the edges of the plane, all actions are possible far from obstacles.
    const bool harmless = plane_ && draw(0, crowd_ ? 5 : 1) > 0;
    const auto side = [&] {
      return harmless ? pick<std::string>({"safe", "saturate"})
                      : pick<std::string>({"unsafe", "safe", "saturate"});
    };
    state_text_.push_back(
        fmt::format(R"({{{}, "upper": {}, "step": 1, "outside": {{"below": "{}", "above": "{}"}}}})", common,
                    count - 1, side(), side()));
  }

  void add_input(int i) {
    if (crowd_) {
      input_text_.push_back(
          fmt::format(R"({{"name": "u{}", "values": [{}]}})", i,
                      pick<std::string>({"-1, 0, 1", "-1, 0, 1", "0, 1", "0, -1", "1, -1"})));
      return;
    }
    input_text_.push_back(
        pick<std::string>({fmt::format(R"({{"name": "u{}", "lower": -1, "upper": 1, "step": 1}})", i),
                           fmt::format(R"({{"name": "u{}", "values": [1, 0, -2]}})", i),
                           fmt::format(R"({{"name": "u{}", "lower": -1, "upper": 1, "step": 0.5}})", i)}));
  }

  std::string agents() {
    const auto inputs = static_cast<int>(input_text_.size());
    const auto states = static_cast<int>(discrete_.size());
    agents_ = crowd_ ? draw(3, inputs) : plane_ ? draw(std::min(states, inputs), inputs) : draw(1, inputs);
    std::vector<std::vector<std::string>> owned(static_cast<std::size_t>(agents_));
    for (int i = 0; i < inputs; ++i) {
      const int owner = i < agents_ ? i : draw(0, agents_ - 1);
      owned[static_cast<std::size_t>(owner)].push_back(fmt::format("\"u{}\"", i));
    }
    std::vector<std::string> parts;
    for (int a = 0; a < agents_; ++a) {
      parts.push_back(
          fmt::format(R"({{"name": "a{}", "inputs": [{}]}})", a, join(owned[static_cast<std::size_t>(a)])));
    }
    return join(parts);
  }

  std::string coordination() {
    const int max_delay = draw(0, 3) == 0 ? draw(0, 3) : -1;
    std::string text = fmt::format(R"("partitions": {}, "max_delay": {}, "connection_delay": {})",
                                   crowd_ ? "\"all\"" : "[" + partitions() + "]",
                                   max_delay < 0 ? "null" : std::to_string(max_delay), draw(0, 2));
    if (crowd_) {
      text += fmt::format(R"(, "horizon": {}, "link_cost": [{}])", draw(0, max_delay < 0 ? 4 : max_delay),
                          link_costs());
    }
    return text;
  }

  std::string link_costs() {
    std::vector<std::string> parts;
    for (int a = 0; a < agents_; ++a) {
      for (int b = a + 1; b < agents_; ++b) {
        if (draw(0, 2) > 0) continue;
        parts.push_back(fmt::format(R"({{"agents": ["a{}", "a{}"], "cost": {}}})", b, a,
                                    pick<std::string>({"0", "0.5", "2", "\"1/3\"", "3"})));
      }
    }
    return join(parts);
  }

  std::string partitions() {
    std::vector<std::string> parts = {R"({"name": "alone", "classes": []})"};
    if (agents_ >= 2) parts.push_back(R"({"classes": [["a0", "a1"]]})");
    if (agents_ >= 3) parts.push_back(R"({"classes": [["a0", "a2"], ["a1"]]})");
    return join(parts);
  }

  std::string equations(bool disturbed) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < discrete_.size(); ++i)
      parts.push_back(fmt::format("\"x{}\": \"{}\"", i, equation(i, disturbed)));
    return join(parts);
  }

  /// Each agent moves a state of its own, mostly; at times another input joins in, or nothing moves a state.
  std::string plane_equation(std::size_t i, bool disturbed) {
    std::string text = continuous_time_ ? "0" : fmt::format("x{}", i);
    const auto inputs = static_cast<int>(input_text_.size());
    if (draw(0, 9) > 0) text += fmt::format(" + {}u{}", pick<std::string>({"", "0.5*", "0.25*"}), i);
    const int other = (static_cast<int>(i) + draw(1, inputs - 1)) % inputs;
    if ((coupled_ || crowd_) && draw(0, 1) == 0) text += fmt::format(" + 0.5*u{}", other);
    if (!disturbed || draw(0, 3) > 0) return text;
    // At times from somewhere on, so that ranges differ in nothing but their width.
    if (continuous_time_ || edges_ == RandomEdges::plain || draw(0, 2) > 0) return text + " + 0.25*w";
    return text + fmt::format(" + if(x{} >= 3.5, w, 0)", draw(0, static_cast<int>(discrete_.size()) - 1));
  }

  std::string equation(std::size_t i, bool disturbed) {
    if (plane_) return plane_equation(i, disturbed);
    const std::string u = fmt::format("u{}", draw(0, static_cast<int>(input_text_.size()) - 1));
    if (discrete_[i]) {
      // Whole numbers whatever the input is, so that the next value is on the grid.
      return pick<std::string>({fmt::format("x{}", i), fmt::format("x{} + if({} > 0, 1, 0)", i, u),
                                fmt::format("if({} < 0, 0, x{}) - 1", u, i),
                                fmt::format("sign({}) + x{}^2 - x{}", u, i, i)});
    }
    if (continuous_time_) {
      // Strictly upper triangular, so nilpotent.
      std::string text = u;
      for (std::size_t j = i + 1; j < discrete_.size(); ++j)
        text += pick<std::string>({"", fmt::format(" + x{}", j), fmt::format(" - 0.5*x{}", j)});
      return text + (disturbed && draw(0, 1) == 0 ? " + w" : "");
    }
    std::string text = pick<std::string>(
        {fmt::format("x{} + {}", i, u), fmt::format("x{} - {}", i, u), fmt::format("x{} + 0.5*{}", i, u),
         fmt::format("0.5*x{} - {}", i, u), fmt::format("{} - x{}", u, i), fmt::format("2 + {}", u),
         fmt::format("x{}", i), fmt::format("2*x{} - 3*{}", i, u), fmt::format("x{} * {}", i, u)});
    const auto other = static_cast<std::size_t>(draw(0, static_cast<int>(discrete_.size()) - 1));
    if (draw(0, 3) == 0) text += fmt::format(" + 0.25*x{}", other);
    if (draw(0, 2) == 0) text += fmt::format(" + 0.3*u{}", draw(0, static_cast<int>(input_text_.size()) - 1));
    return text + (disturbed && draw(0, 1) == 0 ? " + w" : "");
  }

  std::string atom() {
    const int i = draw(0, static_cast<int>(discrete_.size()) - 1);
    const int j = draw(0, static_cast<int>(discrete_.size()) - 1);
    return pick<std::string>(
        {fmt::format("x{} >= {}", i, draw(0, 3)), fmt::format("x{} <= {}.5", i, draw(0, 6)),
         fmt::format("x{} != x{} or x{} < 3", i, j, j), fmt::format("x{}^2 + x{}^2 <= {}", i, j, draw(2, 60)),
         fmt::format("abs(x{} - x{}) >= 0.5", i, j), fmt::format("x{} * (5 - x{}) <= {}", i, i, draw(0, 7)),
         fmt::format("x{}^2 - 2*x{}*x{} + x{}^2 <= {}", i, i, j, j, draw(1, 12)),
         fmt::format("x{} >= {} or x{} <= 2.5", i, draw(1, 4), i), "true"});
  }

  /// Something about two or three of the states.
  std::string safe_condition_of_crowd() {
    const int i = draw(0, states_ - 1);
    const int j = (i + draw(1, states_ - 1)) % states_;
    const int k = draw(0, states_ - 1);
    return pick<std::string>(
        {fmt::format("abs(x{} - x{}) >= 0.5", i, j), fmt::format("x{} >= 0.5 or x{} >= 0.5", i, j),
         fmt::format("x{} >= 0.5 or x{} >= 0.5 or x{} <= 1.5", i, j, k), fmt::format("x{} + x{} >= 1", i, j),
         fmt::format("x{} + x{} + x{} <= {}.5", i, j, k, draw(4, 7)),
         fmt::format("x{} <= 1.5 or x{} >= 1.5", i, j),
         fmt::format("(x{0} - 1)^2 + (x{1} - 1)^2 + (x{2} - 1)^2 >= 0.25", i, j, k)});
  }

  std::string safe_condition() {
    if (crowd_) return safe_condition_of_crowd();
    if (plane_) {
      return pick<std::string>({fmt::format("(x0 - 4)^2 + (x1 - 4)^2 <= {}", draw(9, 30)),
                                fmt::format("abs(x0 - x1) >= {}.5", draw(0, 2)), "x0 <= 3 or x1 >= 4",
                                "(x0 - 4)^2 + (x1 - 5)^2 >= 3", "x0 >= 2.5 or x1 >= 2",
                                "abs(x0 - 4) >= 1.5 or abs(x1 - 4) >= 1.5",
                                "x0 + x1 >= 5 and x0 + x1 <= 13"});
    }
    return draw(0, 1) == 0 ? atom()
                           : fmt::format("({}) {} ({})", atom(), pick<std::string>({"and", "or"}), atom());
  }

  /// Each may do what they must not do together.
  static std::string joint_allow_condition(int i, int u, int v) {
    return pick<std::string>({fmt::format("u{} + u{} <= {}", u, v, draw(0, 1)),
                              fmt::format("x{} <= {} or u{} != u{}", i, draw(0, 5), u, v),
                              fmt::format("not (u{} == 1 and u{} < 0)", u, v),
                              fmt::format("u{} * u{} <= 0 or x{} == {}", u, v, i, draw(0, 4)),
                              fmt::format("abs(u{} - u{}) < 2 and u{} <= {}", u, v, u, draw(0, 1))});
  }

  std::string allow_condition() {
    const int i = draw(0, static_cast<int>(discrete_.size()) - 1);
    const int inputs = static_cast<int>(input_text_.size());
    const int u = draw(0, inputs - 1);
    const int v = inputs == 1 ? u : (u + draw(1, inputs - 1)) % inputs;  // mostly of another agent
    if (plane_ && draw(0, crowd_ ? 3 : 1) > 0) return "true";
    if (draw(0, 1) == 0) return joint_allow_condition(i, u, v);
    return pick<std::string>({"true", "true", fmt::format("u{} <= 0", u), fmt::format("x{} != 3", i),
                              fmt::format("x{} >= 2 or u{} != 1", i, u),
                              fmt::format("u{} + u{} <= 1 and x{} + u{} >= 0", u, v, i, v)});
  }

  RandomEdges edges_ = RandomEdges::any;
  bool crowd_ = false;
  int states_ = 1;
  bool continuous_time_ = false;
  bool plane_ = false;
  bool coupled_ = false;  ///< in a plane: states may be moved by several agents
  int agents_ = 1;
  std::vector<bool> discrete_;
  std::vector<std::string> state_text_;
  std::vector<std::string> input_text_;
};

}  // namespace

std::string draw_problem(RandomTime kind, RandomEdges edges, RandomAgents agents) {
  return ProblemWriter().write(kind, edges, agents);
}

}  // namespace coordreq
