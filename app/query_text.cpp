#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/network_report.hpp"
#include "app/query_report.hpp"
#include "app/query_values.hpp"
#include "app/render.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostTuples = 6;

/// A number at a length that can be read: exact if that is short, else rounded to six digits.
std::string shown(const Rational& value) {
  constexpr std::size_t kShort = 12;
  std::string text = to_text(value);
  return text.size() <= kShort ? text : fmt::format("{:.6g}", nearest_double(value));
}

/// The document that --json prints in words. Numbers in it are rounded: exact ones are looked up.
class AnswerText {
 public:
  AnswerText(const Json& answer, const std::vector<Rational>& state, const ResultsReader& results)
      : answer_(answer), state_(state), results_(results), grid_(results.grid()) {}

  [[nodiscard]] std::string all() const {
    std::string text = head();
    for (const Json& partition : answer_["partitions"]) text += partition_text(partition);
    if (!answer_["inside"].get<bool>()) return text;
    if (answer_.contains("coalition")) text += coalition_text(answer_["coalition"]);
    if (const auto& network = results_.spec().network)
      text += safe_modes_text(*network, answer_["safe_modes"].get<std::vector<std::string>>());
    if (!answer_.contains("convention")) return text;
    Facts facts;
    for (const Json& own : answer_["convention"])
      facts.emplace_back("  actions of " + text_of(own["name"]), class_text(own));
    return text + "\nconvention\n" + facts_text(facts);
  }

 private:
  [[nodiscard]] std::string head() const {
    Facts facts = {{"state", state_text()}};
    if (!answer_["inside"].get<bool>()) {
      facts.emplace_back("cell", outside_text(answer_["outside"]));
      return facts_text(facts);
    }
    const Json& cell = answer_["cell"];
    facts.emplace_back("cell", fmt::format("number {}, index ({}): {}", grouped(cell["number"]),
                                           fmt::join(cell["index"].get<std::vector<std::int64_t>>(), ", "),
                                           box_text(number_of(cell["number"]))));
    facts.emplace_back("safe set", answer_["safe"] ? "inside" : "outside");
    facts.emplace_back("invariance set", answer_["invariant"] ? "inside" : "outside");
    facts.emplace_back("leaves the safe set", collision_text(answer_["collision_time"]));
    for (const Field* const field : asked_fields(results_))
      facts.emplace_back(field->shown.asked, value_text(answer_, field->path.substr(1)));
    facts.emplace_back("guarantee", guarantee_text(text_of(answer_["guarantee"])));
    return facts_text(facts);
  }

  [[nodiscard]] std::string steps_text(const Json& steps) const {
    const DynamicsSpec& dynamics = results_.spec().dynamics;
    return duration(number_of(steps), nearest_double(dynamics.period), dynamics.unit);
  }

  [[nodiscard]] std::string state_text() const {
    std::string text;
    for (std::size_t i = 0; i < grid_.size(); ++i)
      text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid_[i].name, shown(state_[i]));
    return text;
  }

  /// "x1 in [0.095, 0.105)" for every state, "lane = 1" for a discrete one.
  [[nodiscard]] std::string box_text(std::int64_t cell) const {
    const CellBox box = box_of_cell(grid_, cell);
    std::string text;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      text += text.empty() ? "" : ", ";
      text += grid_[i].discrete
                  ? fmt::format("{} = {}", grid_[i].name, shown(box.centre[i]))
                  : fmt::format("{} in [{}, {})", grid_[i].name, shown(box.lower[i]), shown(box.upper[i]));
    }
    return text;
  }

  /// Why there is no cell.
  [[nodiscard]] std::string outside_text(const Json& outside) const {
    std::size_t i = 0;
    while (outside["state"] != grid_[i].name) ++i;
    const GridDimension& dimension = grid_[i];
    const std::string value = fmt::format("{} = {}", dimension.name, shown(state_[i]));
    if (outside["reason"] == "off_grid") {
      return fmt::format("no state of the system: {} is none of {} + k * {}", value, shown(dimension.first),
                         shown(dimension.step));
    }
    const std::string side = text_of(outside["side"]);
    if (!answer_["safe"].is_null()) {
      return fmt::format("outside: {} has left {} the domain, where the spec says that all is safe for ever",
                         value, side);
    }
    const Rational low = dimension.first - dimension.radius();
    const Rational high = dimension.point(dimension.count - 1) + dimension.radius();
    return fmt::format("outside: {} lies {} the domain, {} in [{}, {}{}; nothing is known there", value, side,
                       dimension.name, shown(low), shown(high), dimension.discrete ? "]" : ")");
  }

  [[nodiscard]] std::string collision_text(const Json& time) const {
    if (time.is_null()) return "never, with coordination";
    if (time == 0) return "0 steps: not safe now";
    return "perhaps within " + steps_text(time) + ", whatever is coordinated";
  }

  /// A value by its key, or the word that it means.
  [[nodiscard]] std::string value_text(const Json& of, const std::string& name) const {
    const std::string status = text_of(of[name + "_status"]);
    if (status == "steps" || status == "at_least")
      return (status == "at_least" ? "at least " : "") + steps_text(of[name]);
    if (status == "number") return grouped(of[name]);
    std::string words = status;
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
  }

  [[nodiscard]] std::string delay_text(const Json& partition) const {
    const Json& status = partition["delay_status"];
    if (status == "not_safe") return "none: the cell is not safe";
    if (status == "not_invariant")
      return "none: on this grid no coordination keeps the system safe from here";
    if (status == "unbounded") return "unbounded: safe without coordination for ever";
    return value_text(partition, "delay");
  }

  [[nodiscard]] std::string countdown_text(const Json& partition) const {
    const Json& status = partition["countdown_status"];
    if (status == "connection_must_stand_already") return "a connection must exist already";
    if (status == "never") return "never need to connect";
    if (status != "steps") return "none";
    if (partition["countdown"] == 0) {
      return results_.spec().coordination.connection_delay > 0 ? "start to connect now" : "coordinate now";
    }
    return steps_text(partition["countdown"]);
  }

  [[nodiscard]] std::string partition_text(const Json& partition) const {
    Facts facts = {{"  delay", delay_text(partition)}, {"  countdown", countdown_text(partition)}};
    for (const Json& own : partition["classes"])
      facts.emplace_back("  actions of " + text_of(own["name"]), class_text(own));
    if (partition.contains("approach")) add_approach(partition["approach"], facts);
    return fmt::format("\npartition {}\n{}", text_of(partition["name"]), facts_text(facts));
  }

  /// Towards the goal. Where nothing comes nearer, since the goal is reached or cannot be, no actions are
  /// told.
  void add_approach(const Json& approach, Facts& facts) const {
    facts.emplace_back("  approach delay", value_text(approach, "delay"));
    facts.emplace_back("  approach countdown", value_text(approach, "countdown"));
    for (const Json& own : approach["classes"]) {
      if (!own["actions"].empty())
        facts.emplace_back("  approach of " + text_of(own["name"]), class_text(own));
    }
  }

  [[nodiscard]] std::string class_text(const Json& own) const {
    const std::size_t count = own["actions"].size();
    if (count == 0) return "none";
    if (own["total"] == count) return fmt::format("all {}", grouped(own["total"]));
    const auto names = own["inputs"].get<std::vector<std::string>>();
    const std::string name = names.size() == 1 ? names.front() : fmt::format("({})", fmt::join(names, ", "));
    return fmt::format("{} of {}: {} = {}", grouped(std::uint64_t{count}), grouped(own["total"]), name,
                       actions_text(names, own["actions"].get<std::vector<std::size_t>>()));
  }

  /// Runs of actions that follow one another as "-0.8 ... 1"; of several inputs the first few tuples.
  [[nodiscard]] std::string actions_text(const std::vector<std::string>& names,
                                         const std::vector<std::size_t>& actions) const {
    const std::vector<std::int32_t> inputs = inputs_called(names);
    const bool is_single = inputs.size() == 1;
    std::string text;
    std::size_t tuples = 0;
    for (std::size_t i = 0; i < actions.size(); ++i) {
      if (tuples++ == kMostTuples) return text + " ...";
      text += (text.empty() ? "" : is_single ? ", " : " ") + tuple_text(inputs, actions[i]);
      std::size_t last = i;
      while (is_single && last + 1 < actions.size() && actions[last + 1] == actions[last] + 1) ++last;
      if (last > i) text += (last > i + 1 ? " ... " : ", ") + tuple_text(inputs, actions[last]);
      i = last;
    }
    return text;
  }

  [[nodiscard]] std::vector<std::int32_t> inputs_called(const std::vector<std::string>& names) const {
    const std::vector<InputSpec>& all = results_.spec().inputs;
    std::vector<std::int32_t> inputs;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (std::find(names.begin(), names.end(), all[i].name) != names.end())
        inputs.push_back(static_cast<std::int32_t>(i));
    }
    return inputs;
  }

  [[nodiscard]] std::string tuple_text(const std::vector<std::int32_t>& inputs, std::size_t action) const {
    std::string text;
    for (const Rational& value : values_of(results_.spec(), inputs, action))
      text += (text.empty() ? "" : ", ") + shown(value);
    return inputs.size() == 1 ? text : "(" + text + ")";
  }

  [[nodiscard]] std::string coalition_text(const Json& coalition) const {
    const Json& status = coalition["status"];
    Facts facts = {{"  cheapest partition", status == "partition" ? text_of(coalition["partition"])
                                            : status == "no_partition_suffices"
                                                ? "none: no partition of the file suffices"
                                                : "none"}};
    const auto pairs = coalition["critical_pairs"].get<std::vector<std::string>>();
    if (status == "partition")
      facts.emplace_back("  critical pairs",
                         pairs.empty() ? "none" : fmt::format("{}", fmt::join(pairs, ", ")));
    return fmt::format("\n{} without further contact\n{}", steps_text(coalition["horizon"]),
                       facts_text(facts));
  }

  const Json& answer_;
  const std::vector<Rational>& state_;
  const ResultsReader& results_;
  const UniformGrid& grid_;
};

}  // namespace

std::string answer_text(const Json& answer, const std::vector<Rational>& state,
                        const ResultsReader& results) {
  return AnswerText(answer, state, results).all();
}

}  // namespace coordreq
