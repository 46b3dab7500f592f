#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "analysis/advice.hpp"
#include "base/grouped.hpp"
#include "base/json.hpp"
#include "spec/names_behind.hpp"
#include "spec/problem_spec.hpp"
#include "spec/scope.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// Whether points from first to last, a step apart, are what somebody means by the domain [lower, upper]:
/// they meet its ends, or the cells around them do.
bool covers(const GridSpec& grid, const Rational& lower, const Rational& upper, const Rational& margin) {
  const Rational last = grid.last();
  const auto meets = [&](const Rational& by) { return grid.first == lower + by && last == upper - by; };
  return meets(0) || meets(margin);
}

void advise_on_grid(const std::string& points, const GridSpec& grid, const Rational& lower,
                    const Rational& upper, const std::string& pointer, Warnings& found) {
  const Rational last = grid.last();
  const char* const reason =
      is_integer(Rational((upper - lower) / grid.step)) ? "" : ", because the step does not divide that";
  found.push_back({"grid", pointer,
                   fmt::format("{} go from {} to {} in steps of {}, not from {} to {}{}", points,
                               short_number(grid.first), short_number(last), short_number(grid.step),
                               short_number(lower), short_number(upper), reason)});
}

void advise_on_state_grids(const ProblemSpec& spec, Warnings& found) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    const bool is_ring = state.below == Outside::periodic;
    if (is_ring || covers(state.grid, state.lower, state.upper, state.grid.step / 2)) continue;
    advise_on_grid("the grid points of " + state.name, state.grid, state.lower, state.upper,
                   fmt::format("/states/{}", i), found);
  }
}

void advise_on_input_grids(const ProblemSpec& spec, const Node& root, Warnings& found) {
  MemoryReader memory(root);
  const Scope scope(root, memory);
  const std::vector<Node> objects = root.elements("inputs");
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    const InputSpec& input = spec.inputs[i];
    if (!input.grid) continue;
    const Rational lower = scope.number(objects[i]["lower"]);
    const Rational upper = scope.number(objects[i]["upper"]);
    if (covers(*input.grid, lower, upper, 0)) continue;
    advise_on_grid("the values of " + input.name, *input.grid, lower, upper, objects[i].pointer(), found);
  }
}

using Names = std::set<std::string>;

/// Adds the names in all texts below a value that may be expressions. A text that only looks like one hides
/// at most a warning.
void add_names(const Json& value, Names& names) {
  static const Names kPlain = {"name", "unit", "description", "$schema", "file"};
  if (value.is_string()) names.merge(names_in(value.get<std::string>()));
  if (value.is_array())
    for (const auto& element : value) add_names(element, names);
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items())
    if (!kPlain.contains(key)) add_names(member, names);
}

/// The names that a spec uses, directly or through definitions.
Names used_names(const Json& root) {
  Names used;
  for (const auto& [key, member] : root.items()) {
    if (key == "constants" || key == "definitions" || key == "memory") continue;
    if (key != "agents") {
      add_names(member, used);
      continue;
    }
    for (const auto& agent : member)
      if (agent.contains("prefer")) add_names(agent["prefer"], used);
  }
  return with_names_behind(root, std::move(used));
}

void advise_on_names(const Node& root, const Json& document, Warnings& found) {
  const Names used = used_names(document);
  const auto look = [&](const char* kind, const std::string& name, const std::string& pointer) {
    if (used.contains(name)) return;
    found.push_back({"unused", pointer, fmt::format("nothing depends on the {} {}", kind, name)});
  };
  for (const auto& [list, kind] : {std::pair("constants", "constant"), std::pair("definitions", "definition"),
                                   std::pair("memory", "memory")}) {
    if (!root.has(list)) continue;
    for (const std::string& name : root[list].keys()) look(kind, name, root[list][name].pointer());
  }
  for (const auto& [list, kind] : {std::pair("inputs", "input"), std::pair("disturbances", "disturbance")})
    for (const Node& object : root.elements(list)) look(kind, object["name"].text(), object.pointer());
}

/// States that jump at samples and decide what is safe between them.
void advise_on_jumps(const ProblemSpec& spec, Warnings& found) {
  if (spec.dynamics.time == Time::discrete || !spec.abstraction.between_samples) return;
  std::vector<std::string> names;
  for (const std::uint32_t slot : spec.safe.variables()) {
    if (slot < spec.states.size() && spec.dynamics.update(slot) != nullptr)
      names.push_back(spec.states[slot].name);
  }
  if (names.empty()) return;
  const bool is_one = names.size() == 1;
  found.push_back(
      {"jump", "/safe",
       fmt::format("'safe' depends on {}, which {} at the sampling instants: between two samples "
                   "{} as at the first of them, so that motion with {} between the samples is not covered; "
                   "a continuous state with an equation moves all the time",
                   list_text(names), is_one ? "jumps" : "jump", is_one ? "it counts" : "they count",
                   is_one ? "it" : "them")});
}

}  // namespace

Warnings advise_on_spec(const ProblemSpec& spec) {
  constexpr std::size_t kLongText = std::size_t{1} << 20;  // it would take memory that is not counted
  if (spec.text.size() > kLongText) return {};
  const JsonDocument document = JsonDocument::parse(spec.text, "the spec");
  Warnings found;
  advise_on_state_grids(spec, found);
  advise_on_input_grids(spec, document.root(), found);
  advise_on_jumps(spec, found);
  advise_on_names(document.root(), parse_json(spec.text, JsonComments::skipped), found);
  return found;
}

}  // namespace coordreq
