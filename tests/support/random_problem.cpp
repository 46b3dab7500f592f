#include "support/random_problem.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <vector>

namespace coordreq {
namespace {

int draw(int low, int high) {
  // At full size: RapidCheck would begin with the low end of every range.
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

template <class T>
T pick(const std::vector<T>& choices) {
  return choices[static_cast<std::size_t>(draw(0, static_cast<int>(choices.size()) - 1))];
}

class ProblemWriter {
 public:
  std::string write(RandomTime kind, RandomEdges edges) {
    edges_ = edges;
    const bool between_samples = kind == RandomTime::between_samples;
    continuous_time_ = between_samples || (kind == RandomTime::any && draw(0, 3) == 0);
    // Half of the problems are agents that share a plane: those have layers.
    plane_ = draw(0, 1) == 0;
    const int states = plane_ ? draw(2, 3) : draw(1, 3);
    for (int i = 0; i < states; ++i) add_state(i);
    const int inputs = plane_ ? states : draw(1, 3);
    for (int i = 0; i < inputs; ++i) add_input(i);
    const bool disturbed = draw(0, 2) == 0;
    const std::string cells = pick<std::string>({"closed", "half_open"});
    const std::string safe = pick<std::string>({"inner", "center"});
    std::string text = fmt::format(
        R"({{"coordreq": 1, "name": "random",
"states": [{}],
"inputs": [{}],
"disturbances": [{}],
"agents": [{}],
"dynamics": {{"time": "{}", "period": {}, "equations": {{{}}}}},
"safe": "{}",
"abstraction": {{"cells": "{}", "safe": "{}", "between_samples": {}}},
"controller": {{"synthesis": "{}", "allow": "{}"}},
"coordination": {{"partitions": [{}], "max_delay": {}, "connection_delay": {}}}}})",
        join(state_text_), join(input_text_),
        disturbed ? R"({"name": "w", "lower": -0.25, "upper": 0.5})" : "", agents(),
        continuous_time_ ? "continuous" : "discrete", pick<std::string>({"1", "0.5"}), equations(disturbed),
        safe_condition(), cells, safe, between_samples, draw(0, 3) == 0 ? "given" : "maximal",
        allow_condition(), partitions(), draw(0, 3) == 0 ? std::to_string(draw(0, 3)) : "null", draw(0, 2));
    return text;
  }

 private:
  static std::string join(const std::vector<std::string>& parts) {
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  void add_state(int i) {
    const int count = plane_ ? draw(6, 11) : draw(0, 9) == 0 ? draw(1, 2) : draw(4, 9);
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
    const auto side = [] { return pick<std::string>({"unsafe", "safe", "saturate"}); };
    state_text_.push_back(
        fmt::format(R"({{{}, "upper": {}, "step": 1, "outside": {{"below": "{}", "above": "{}"}}}})", common,
                    count - 1, side(), side()));
  }

  void add_input(int i) {
    input_text_.push_back(
        pick<std::string>({fmt::format(R"({{"name": "u{}", "lower": -1, "upper": 1, "step": 1}})", i),
                           fmt::format(R"({{"name": "u{}", "values": [1, 0, -2]}})", i),
                           fmt::format(R"({{"name": "u{}", "lower": -1, "upper": 1, "step": 0.5}})", i)}));
  }

  std::string agents() {
    const auto inputs = static_cast<int>(input_text_.size());
    agents_ = plane_ ? inputs : draw(1, inputs);
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

  std::string equation(std::size_t i, bool disturbed) {
    if (plane_) {
      const std::string slow = pick<std::string>({"", "0.5*", "0.25*"});
      return fmt::format("{}{}u{}{}", continuous_time_ ? "" : fmt::format("x{} + ", i), slow, i,
                         disturbed && draw(0, 3) == 0 ? " + 0.25*w" : "");
    }
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

  std::string safe_condition() {
    if (plane_) {
      return pick<std::string>({fmt::format("(x0 - 4)^2 + (x1 - 4)^2 <= {}", draw(9, 30)),
                                fmt::format("abs(x0 - x1) >= {}.5", draw(0, 2)), "x0 <= 3 or x1 >= 4",
                                "abs(x0 - 4) >= 1.5 or abs(x1 - 4) >= 1.5",
                                "x0 + x1 >= 5 and x0 + x1 <= 13"});
    }
    return draw(0, 1) == 0 ? atom()
                           : fmt::format("({}) {} ({})", atom(), pick<std::string>({"and", "or"}), atom());
  }

  std::string allow_condition() {
    const int i = draw(0, static_cast<int>(discrete_.size()) - 1);
    const int u = draw(0, static_cast<int>(input_text_.size()) - 1);
    const int v = draw(0, static_cast<int>(input_text_.size()) - 1);
    return pick<std::string>({"true", "true", fmt::format("u{} <= 0", u),
                              fmt::format("x{} >= 2 or u{} != 1", i, u),
                              fmt::format("u{} + u{} <= 1 and x{} + u{} >= 0", u, v, i, v)});
  }

  RandomEdges edges_ = RandomEdges::any;
  bool continuous_time_ = false;
  bool plane_ = false;
  int agents_ = 1;
  std::vector<bool> discrete_;
  std::vector<std::string> state_text_;
  std::vector<std::string> input_text_;
};

}  // namespace

std::string draw_problem(RandomTime kind, RandomEdges edges) {
  return ProblemWriter().write(kind, edges);
}

}  // namespace coordreq
