#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "answers/plan.hpp"
#include "app/query_report.hpp"
#include "app/render.hpp"
#include "app/reports.hpp"
#include "results/read_info.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostTuples = 6;
constexpr std::size_t kMostNames = 12;

/// A number at a length that can be read: exact if that is short, else rounded to six digits.
std::string exact_or_short(const Rational& value) {
  constexpr std::size_t kShort = 12;
  std::string text = to_text(value);
  return text.size() <= kShort ? text : short_number(value);
}

/// The document that --json prints, as text. Numbers in it are rounded: exact ones are looked up.
class AnswerText {
 public:
  AnswerText(const Json& answer, const std::vector<Rational>& state, const QueryForm& form)
      : answer_(answer), state_(state), form_(form), grid_(form.results.grid()) {}

  [[nodiscard]] std::string all() const {
    std::string text = head();
    for (std::size_t p = 0; p < answer_["partitions"].size(); ++p) text += partition_text(p);
    if (!answer_["inside"].get<bool>()) return text;
    text += sections_text();
    for (const AnswerPolicy& policy : form_.of_agents) {
      Facts facts;
      add_classes(policy, answer_[policy.name], facts);
      text += "\n" + policy.name + "\n" + facts_text(facts);
    }
    return text;
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
    for (const Field* const field : form_.numbers) {
      if (!QueryForm::is_of_partitions(*field))
        facts.emplace_back(field->display.query.label,
                           value_text(*field, answer_, field->display.query.name));
    }
    facts.emplace_back("guarantee", guarantee_of_file(text_of(answer_["guarantee"]), form_.spec()));
    return facts_text(facts);
  }

  [[nodiscard]] std::string steps_text(const Json& steps) const {
    const DynamicsSpec& dynamics = form_.spec().dynamics;
    return duration(number_of(steps), nearest_double(dynamics.period), dynamics.unit);
  }

  [[nodiscard]] std::string state_text() const {
    std::string text;
    for (std::size_t i = 0; i < grid_.size(); ++i)
      text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid_[i].name, exact_or_short(state_[i]));
    return text;
  }

  /// "x1 in [0.095, 0.105)" for every state, "lane = 1" for a discrete one.
  [[nodiscard]] std::string box_text(std::int64_t cell) const {
    const CellBox box = box_of_cell(grid_, cell);
    std::string text;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      text += text.empty() ? "" : ", ";
      text += grid_[i].discrete ? fmt::format("{} = {}", grid_[i].name, exact_or_short(box.centre[i]))
                                : fmt::format("{} in [{}, {})", grid_[i].name, exact_or_short(box.lower[i]),
                                              exact_or_short(box.upper[i]));
    }
    return text;
  }

  /// Why there is no cell.
  [[nodiscard]] std::string outside_text(const Json& outside) const {
    std::size_t i = 0;
    while (outside["state"] != grid_[i].name) ++i;
    const GridDimension& dimension = grid_[i];
    const std::string value = fmt::format("{} = {}", dimension.name, exact_or_short(state_[i]));
    if (outside["reason"] == "off_grid") {
      return fmt::format("no state of the system: {} is none of {} + k * {}", value,
                         exact_or_short(dimension.first), exact_or_short(dimension.step));
    }
    const std::string side = text_of(outside["side"]);
    if (!answer_["safe"].is_null()) {
      return fmt::format(
          "outside: {} has left {} the domain, where the spec says that the system is safe indefinitely",
          value, side);
    }
    const Rational low = dimension.first - dimension.radius();
    const Rational high = dimension.point(dimension.count - 1) + dimension.radius();
    return fmt::format("outside: {} lies {} the domain, {} in [{}, {}{}; the results do not cover it", value,
                       side, dimension.name, exact_or_short(low), exact_or_short(high),
                       dimension.discrete ? "]" : ")");
  }

  [[nodiscard]] std::string collision_text(const Json& time) const {
    if (time.is_null()) return "never, with coordination";
    if (time == 0) return "0 steps: not safe now";
    return "possibly within " + steps_text(time) + ", even with full coordination";
  }

  /// A value by its key, or the name that it stands for.
  [[nodiscard]] std::string value_text(const Field& field, const Json& of, const std::string& name) const {
    return value_text_of(field, of, name, [this](const Json& steps) { return steps_text(steps); });
  }

  /// The policies, before all others what the spec asks for.
  [[nodiscard]] std::vector<AnswerPolicy> lead_first() const {
    std::vector<AnswerPolicy> policies = form_.policies;
    const std::string lead = headline_policies(form_.spec()).front().name;
    std::stable_partition(policies.begin(), policies.end(),
                          [&lead](const AnswerPolicy& policy) { return policy.name == lead; });
    return policies;
  }

  /// For how long silence is safe at the best state, by what the spec asks for; nothing where there is none.
  [[nodiscard]] std::string best_text(std::size_t p) const {
    if (!is_looked_at(form_.results)) return "";
    const AnswerPolicy policy = headline_policies(form_.spec()).front();
    const StoredPartition sizes =
        read_partition_values(form_.spec(), form_.results, policy.kind->prefix())[p];
    const Json state = best_state_json(form_.results, policy, p, sizes);
    if (state.is_null()) return "";
    const std::size_t layers = sizes.layer_sizes.size();
    return fmt::format("{} at {}", layers < 3 ? "unbounded" : steps_text(layers - 2), values_text(state));
  }

  [[nodiscard]] std::string partition_text(std::size_t p) const {
    const Json& partition = answer_["partitions"][p];
    Facts facts;
    for (const AnswerPolicy& policy : lead_first()) {
      const Json& entry = policy.name.empty() ? partition : partition[policy.name];
      for (const auto& [key, path] : {std::pair("delay", policy.delay), {"countdown", policy.trigger}}) {
        if (path.empty()) continue;
        const Field& field = form_.results.field(path);
        facts.emplace_back("  " + field.display.query.label, value_text(field, entry, key));
      }
      add_classes(policy, entry["classes"], facts);
    }
    for (const Field* const field : form_.numbers) {
      if (QueryForm::is_of_partitions(*field))
        facts.emplace_back("  " + field->display.query.label,
                           value_text(*field, partition, field->display.query.name));
    }
    const std::string best = best_text(p);
    if (!best.empty()) facts.emplace_back("  best state", best);
    return fmt::format("\npartition {}\n{}", text_of(partition["name"]), facts_text(facts));
  }

  /// Adds the actions of the classes; none where a policy that does not hold everywhere leaves none.
  void add_classes(const AnswerPolicy& policy, const Json& classes, Facts& facts) const {
    for (const Json& entry : classes) {
      if (policy.name.empty() || policy.is_by_agent || !entry["actions"].empty())
        facts.emplace_back("  " + policy.label + " of " + text_of(entry["name"]), class_text(entry));
    }
  }

  [[nodiscard]] std::string class_text(const Json& entry) const {
    const std::size_t count = entry["actions"].size();
    if (count == 0) return "none";
    if (entry["total"] == count) return fmt::format("all {}", grouped(entry["total"]));
    const auto names = entry["inputs"].get<std::vector<std::string>>();
    const std::string name = names.size() == 1 ? names.front() : fmt::format("({})", fmt::join(names, ", "));
    return fmt::format("{} of {}: {} = {}", grouped(std::uint64_t{count}), grouped(entry["total"]), name,
                       actions_text(names, entry["actions"].get<std::vector<std::size_t>>()));
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
    const std::vector<InputSpec>& all = form_.spec().inputs;
    std::vector<std::int32_t> inputs;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (std::find(names.begin(), names.end(), all[i].name) != names.end())
        inputs.push_back(static_cast<std::int32_t>(i));
    }
    return inputs;
  }

  [[nodiscard]] std::string tuple_text(const std::vector<std::int32_t>& inputs, std::size_t action) const {
    std::string text;
    for (const Rational& value : values_of(form_.spec(), inputs, action))
      text += (text.empty() ? "" : ", ") + exact_or_short(value);
    return inputs.size() == 1 ? text : "(" + text + ")";
  }

  /// The choices, or the entries that hold. Fields of one group follow one another; if nothing is chosen the
  /// others are left out.
  [[nodiscard]] std::string sections_text() const {
    std::string text;
    Facts facts;
    bool is_displayed = true;
    for (std::size_t i = 0; i < form_.others.size(); ++i) {
      const Field& field = *form_.others[i];
      const FieldQuery& query = field.display.query;
      const Json& entry = query.group.empty() ? answer_ : answer_[query.group];
      const bool begins =
          i == 0 || query.group.empty() || query.group != form_.others[i - 1]->display.query.group;
      if (begins) {
        const std::string first = query.attribute.empty() ? "" : steps_text(entry[query.attribute]) + " ";
        if (i > 0) text += facts_text(std::exchange(facts, {}));
        text += "\n" + first + query.heading + "\n";
      }
      if (begins) is_displayed = true;
      if (is_displayed) facts.emplace_back("  " + query.label, section_text(field, entry, is_displayed));
    }
    return facts.empty() ? text : text + facts_text(facts);
  }

  /// @param is_chosen set to false where a partition is to be chosen and none is
  [[nodiscard]] std::string section_text(const Field& field, const Json& entry, bool& is_chosen) const {
    const FieldQuery& query = field.display.query;
    if (field.kind == FieldKind::probability) return probabilities_text(entry[query.name]);
    if (field.kind != FieldKind::choice)
      return names_text(field, entry[query.name].get<std::vector<std::string>>());
    is_chosen = entry["status"] == query.name;
    return is_chosen ? text_of(entry[query.name]) : status_text(field, text_of(entry["status"]));
  }

  /// "up 1.3e-07, down 0.002".
  [[nodiscard]] static std::string probabilities_text(const Json& of_entries) {
    std::string text;
    std::size_t listed = 0;
    for (const auto& [name, value] : of_entries.items()) {
      if (++listed > kMostNames) return text + " ...";
      text += (text.empty() ? "" : ", ") + name + " " + probability_text(value);
    }
    return text;
  }

  /// The entries of a set that hold, counted if the field says what they are called.
  [[nodiscard]] std::string names_text(const Field& field, std::vector<std::string> names) const {
    const std::string& entry = field.display.query.entry;
    if (entry.empty()) return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
    const std::size_t count = names.size(), all = form_.results.leading_length(field);
    if (count == 0) return "no " + entry;
    if (count == all) return fmt::format("all {} {}s", grouped(std::uint64_t{count}), entry);
    names.resize(std::min(kMostNames, count));
    return fmt::format("{} of {} {}s: {}{}", grouped(std::uint64_t{count}), grouped(std::uint64_t{all}),
                       entry, fmt::join(names, ", "), count > kMostNames ? " ..." : "");
  }

  const Json& answer_;
  const std::vector<Rational>& state_;
  const QueryForm& form_;
  const UniformGrid& grid_;
};

}  // namespace

std::string answer_text(const Json& answer, const std::vector<Rational>& state, const QueryForm& form) {
  return AnswerText(answer, state, form).all();
}

}  // namespace coordreq
