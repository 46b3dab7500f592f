#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/report_html.hpp"
#include "app/report_text.hpp"
#include "app/text.hpp"
#include "base/json.hpp"
#include "export/report_page.hpp"
#include "spec/names_behind.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

/// "The agents a and b", "The 12 agents".
std::string agents_text(const ProblemSpec& spec) {
  constexpr std::size_t kMostNamed = 5;
  const std::size_t count = spec.agents.size();
  if (count > kMostNamed) return fmt::format("The {} agents", grouped(static_cast<std::uint64_t>(count)));
  std::string text = count == 1 ? "The agent " : "The agents ";
  for (std::size_t i = 0; i < count; ++i)
    text += (i == 0           ? ""
             : i + 1 == count ? " and "
                              : ", ") +
            ("<em>" + html_line(spec.agents[i].name) + "</em>");
  return text;
}

/// "-1 to 1 m/s, 41 values".
std::string input_values(const InputSpec& input) {
  const auto [low, high] = std::minmax_element(input.values.begin(), input.values.end());
  if (input.values.size() == 1) return with_unit(short_number(*low), input.unit);
  return fmt::format("{}, {} values",
                     with_unit(short_number(*low) + " to " + short_number(*high), input.unit),
                     grouped(static_cast<std::uint64_t>(input.values.size())));
}

std::string agents_table(const ProblemSpec& spec) {
  std::string rows;
  for (const AgentSpec& agent : spec.agents) {
    std::string inputs;
    for (const std::int32_t i : agent.inputs) {
      const InputSpec& input = spec.inputs[static_cast<std::size_t>(i)];
      inputs +=
          fmt::format("{}{}: {}", inputs.empty() ? "" : "<br>", html_code(input.name), input_values(input));
    }
    rows += html_row({html_line(agent.name), inputs});
  }
  return html_table("Agents", {"agent", "chooses"}, rows);
}

std::string states_table(const ProblemSpec& spec) {
  const bool continuous = spec.dynamics.time == Time::continuous;
  std::string rows;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    rows += html_row(
        {html_code(state.name),
         with_unit(short_number(state.grid.first) + " to " + short_number(state.grid.last()), state.unit),
         with_unit(short_number(state.grid.step), state.unit), grouped(state.grid.count),
         html_code(spec.dynamics.equations[i].text)});
  }
  return html_table("State",
                    {"state", "grid", "step", "points", continuous ? "rate of change" : "next value"}, rows);
}

std::string disturbances_table(const ProblemSpec& spec) {
  if (spec.disturbances.empty()) return "";
  std::string rows;
  for (const DisturbanceSpec& disturbance : spec.disturbances) {
    rows += html_row({html_code(disturbance.name),
                      with_unit(short_number(disturbance.lower) + " to " + short_number(disturbance.upper),
                                disturbance.unit)});
  }
  return html_table("Disturbances", {"disturbance", "anything from"}, rows);
}

/// The names that the safe set and `allow` mention.
std::set<std::string> names_of_safety(const ProblemSpec& spec) {
  std::set<std::string> names = names_in(spec.safe.text);
  if (spec.controller.allow) names.merge(names_in(spec.controller.allow->text));
  return names;
}

/// The meanings of definitions, memories and constants, as a list of code: those among the names, and those
/// that these mention in turn. @param said names that are left out, with the names that they mention
std::string meanings(const ProblemSpec& spec, const std::set<std::string>& names,
                     const std::set<std::string>& said) {
  const Json text = parse_json(spec.text, JsonComments::skipped);
  const std::set<std::string> used = with_names_behind(text, names);
  const std::set<std::string> before = with_names_behind(text, said);
  std::string html;
  for (const char* const key : {"definitions", "memory", "constants"}) {
    if (!text.contains(key)) continue;
    for (const auto& [name, value] : text.at(key).items()) {
      if (!used.contains(name) || before.contains(name)) continue;
      const std::string definition = value.is_string() ? value.get<std::string>() : compact_json(value);
      html += fmt::format("{}{}", html.empty() ? "" : ", ", html_code(name + " = " + definition));
    }
  }
  return html;
}

std::string safe_text(const ProblemSpec& spec) {
  std::string html = "<p>A state is safe if " + html_code(spec.safe.text);
  if (const std::string definitions = meanings(spec, names_of_safety(spec), {}); !definitions.empty())
    html += ", where " + definitions;
  html += ".";
  if (spec.controller.allow)
    html += " The agents may only choose joint inputs with " + html_code(spec.controller.allow->text) + ".";
  return html + "</p>\n";
}

}  // namespace

std::string report_title(const ProblemSpec& spec) {
  constexpr std::size_t kLongestTitle = 100;
  const std::string& text = spec.description;
  const bool is_title = !text.empty() && text.size() <= kLongestTitle && text.find('\n') == std::string::npos;
  return is_title ? text : spec.name;
}

std::string report_task(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  const std::string every =
      spec.dynamics.unit.empty() ? "step" : with_unit(short_number(spec.dynamics.period), spec.dynamics.unit);
  std::string html;
  if (report_title(spec) != spec.name)
    html += fmt::format("<p class=\"lead\">{}</p>\n", html_code(spec.name));
  else if (!spec.description.empty())
    html += fmt::format("<p class=\"lead\">{}</p>\n", html_text(spec.description));
  return html +
         fmt::format(
             "<p>{} keep a system safe together and choose new actions every {}. While they are connected "
             "they coordinate; during silence each chooses alone.</p>\n",
             agents_text(spec), every) +
         safe_text(spec);
}

std::string report_names_of_regions(const ProblemSpec& spec) {
  std::set<std::string> names;
  for (const RequirementSpec& requirement : spec.requirements) names.merge(names_in(requirement.where.text));
  const std::string definitions = meanings(spec, names, names_of_safety(spec));
  return definitions.empty() ? "" : "<p>Here " + definitions + ".</p>\n";
}

std::string report_details(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  return "<section aria-labelledby=\"question-title\">\n<h2 id=\"question-title\">The problem in "
         "detail</h2>\n" +
         agents_table(spec) + states_table(spec) + disturbances_table(spec) +
         fmt::format(
             "<details><summary>The whole spec</summary>\n<pre "
             "tabindex=\"0\">{}</pre></details>\n</section>\n",
             html_text(spec.text));
}

}  // namespace coordreq
