#include "spec/scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "spec/dependency_order.hpp"
#include "spec/spec_errors.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// Twice what the least double has, and all digits that anyone types; everything that is computed exactly
/// takes time and memory in proportion.
constexpr std::size_t kMostBits = 4096;

void check_size(const Rational& value, const std::string& pointer) {
  const std::size_t bits =
      mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
  if (bits > kMostBits) throw SpecError(fmt::format("number of more than {} bits", kMostBits), pointer);
}

/// Named expressions of one JSON object and who mentions whom.
struct MentionGraph {
  std::vector<std::string> names;
  std::map<std::string, std::size_t> index_of;
  std::vector<std::vector<std::size_t>> mentions;

  explicit MentionGraph(const Node& object) : names(object.keys()) {
    for (std::size_t i = 0; i < names.size(); ++i) index_of[names[i]] = i;
    ErrorList errors;
    for (const std::string& name : names)
      errors.attempt([&] { mentions.push_back(mentioned_in(object[name])); });
    errors.raise();
  }

  [[nodiscard]] std::vector<std::size_t> mentioned_in(const Node& node) const {
    std::vector<std::size_t> found;
    if (!node.is_text()) return found;
    for (const std::string& name : mentioned_names(node.text(), node.pointer())) {
      const auto known = index_of.find(name);
      if (known != index_of.end()) found.push_back(known->second);
    }
    return found;
  }
};

/// Adds each name after those that it mentions. What mentions one that is wrong is left alone: nothing can be
/// said of it.
template <class Add>
void add_in_order(const MentionGraph& graph, const std::vector<std::size_t>& order, const Add& add) {
  ErrorList errors;
  std::vector<bool> is_known(graph.names.size(), false);
  for (const std::size_t i : order) {
    const bool can_be_read = std::all_of(graph.mentions[i].begin(), graph.mentions[i].end(),
                                         [&](std::size_t mentioned) { return is_known[mentioned]; });
    is_known[i] = can_be_read && errors.attempt([&] { add(graph.names[i]); });
  }
  errors.raise();
}

}  // namespace

Scope::Scope(const Node& root) {
  if (root.has("goal")) names_.reserve_goal_names();
  add_names(root);
  if (root.has("constants")) evaluate_constants(root["constants"]);
  definitions_ = Definitions(static_cast<std::uint32_t>(slot_names_.size()));
  if (root.has("definitions")) link_definitions(root["definitions"]);
}

void Scope::add_names(const Node& root) {
  ErrorList errors;
  for (const auto& [list, kind] : {std::pair("states", NameKind::state), std::pair("inputs", NameKind::input),
                                   std::pair("disturbances", NameKind::disturbance)}) {
    errors.attempt([&, list = list, kind = kind] { add_variables(root, list, kind); });
  }
  const auto add_keys = [&](const std::string& object, NameKind kind) {
    if (!root.has(object)) return;
    for (const std::string& key : root[object].keys())
      errors.attempt([&] { names_.add(key, kind, root[object][key].pointer()); });
  };
  add_keys("constants", NameKind::constant);
  add_keys("definitions", NameKind::definition);
  errors.raise();
}

void Scope::add_variables(const Node& root, const std::string& list, NameKind kind) {
  for (const Node& variable : root.elements(list)) {
    const Node name = variable["name"];
    names_.add(name.text(), kind, name.pointer());
    slots_[name.text()] = static_cast<std::uint32_t>(slot_names_.size());
    slot_names_.push_back(name.text());
  }
}

void Scope::evaluate_constants(const Node& constants) {
  const MentionGraph graph(constants);
  add_in_order(graph, dependency_order(graph.mentions, graph.names, "constants", constants.pointer()),
               [&](const std::string& name) { constants_[name] = number(constants[name]); });
}

void Scope::link_definitions(const Node& object) {
  const MentionGraph graph(object);
  add_in_order(
      graph, dependency_order(graph.mentions, graph.names, "definitions", object.pointer()),
      [&](const std::string& name) { definitions_.add(name, link_text(object[name], ExpectedType::any)); });
}

Rational Scope::number(const Node& node) const {
  if (node.is_text()) return constant_expression(node);
  const std::optional<Rational> value = parse_decimal(node.token());
  if (!value)
    throw SpecError("number with an exponent beyond 5000: " + quote_text(node.token()), node.pointer());
  check_size(*value, node.pointer());
  return *value;
}

Rational Scope::constant_expression(const Node& node) const {
  for (const std::string& name : mentioned_names(node.text(), node.pointer())) {
    const std::optional<NameKind> kind = names_.find(name);
    if (kind && *kind != NameKind::constant) {
      throw SpecError(
          fmt::format("expected constants only, found the {} {}", kind_in_words(*kind), quote_text(name)),
          node.pointer());
    }
  }
  const Program program = link_text(node, ExpectedType::number);
  const Rational value = constant_value(program, node.pointer());
  check_size(value, node.pointer());
  return value;
}

Program Scope::expression(const Node& node, ExpectedType expected, Over over) const {
  Program program = definitions_.expand(link_text(node, expected));
  check_dependence(program, over, node.pointer());
  return program;
}

Program Scope::link_text(const Node& node, ExpectedType expected) const {
  constexpr std::size_t kTooShort = 2;  // such names differ by a letter anyway
  const auto lookup = [&](std::string_view name) {
    Binding binding = find(name);
    if (std::holds_alternative<NotDefined>(binding) && name.size() > kTooShort)
      binding = NotDefined{suggestion(name, names_.all())};
    return binding;
  };
  return link(node.text(), lookup, expected, node.pointer());
}

void Scope::check_dependence(const Program& program, Over over, const std::string& pointer) const {
  for (const std::uint32_t slot : program.variables()) {
    const std::string& name = slot_names_[slot];
    const NameKind kind = names_.find(name).value();
    const bool is_allowed = over == Over::everything || kind == NameKind::state ||
                            (over == Over::states_and_inputs && kind == NameKind::input);
    if (is_allowed) continue;
    throw SpecError(fmt::format("expected an expression over {}, found the {} {}",
                                over == Over::states ? "states" : "states and inputs", kind_in_words(kind),
                                quote_text(name)),
                    pointer);
  }
}

Binding Scope::find(std::string_view name) const {
  if (const auto slot = slots_.find(name); slot != slots_.end()) return slot->second;
  if (const auto constant = constants_.find(name); constant != constants_.end()) return constant->second;
  return definitions_.find(name);
}

}  // namespace coordreq
