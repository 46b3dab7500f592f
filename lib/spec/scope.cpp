#include "spec/scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "expression/tape_builder.hpp"
#include "spec/read_tables.hpp"
#include "spec/spec_errors.hpp"
#include "spec/spec_parts.hpp"
#include "spec/units.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// Twice what the least double has, and all digits that anyone types; everything that is computed exactly
/// takes time and memory in proportion.
constexpr std::size_t kMostBits = 4096;

/// Slots from here on stand for the cells of states; no slot of a spec is as large.
constexpr std::uint32_t kSeenCell = 1U << 25U;

void check_size(const Rational& value, const std::string& pointer) {
  const std::size_t bits =
      mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
  if (bits > kMostBits) throw SpecError(fmt::format("number of more than {} bits", kMostBits), pointer);
}

/// Adds each name after those that it mentions. What mentions one that is wrong is left alone: nothing can be
/// said of it.
template <class Graph, class Add>
void add_in_order(const Graph& graph, const std::vector<std::size_t>& order, const Add& add) {
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

/// Named expressions and who mentions whom.
struct Scope::MentionGraph {
  std::vector<std::string> names;
  std::vector<std::string> pointers;
  std::map<std::string, std::size_t> index_of;
  std::vector<std::vector<std::string>> mentioned;  ///< names of any kind
  std::vector<std::vector<std::size_t>> mentions;   ///< of those, which are of the graph

  void add(const std::string& name, const std::string& pointer) {
    index_of[name] = names.size();
    names.push_back(name);
    pointers.push_back(pointer);
  }
  void add_members(const Node& object) {
    for (const std::string& name : object.keys()) add(name, object[name].pointer());
  }
  /// @param mentioned_by the names that one mentions
  template <class MentionedBy>
  void find_mentions(const MentionedBy& mentioned_by) {
    ErrorList errors;
    for (const std::string& name : names) {
      errors.attempt([&] {
        mentioned.push_back(mentioned_by(name));
        std::vector<std::size_t>& dependencies = mentions.emplace_back();
        for (const std::string& other : mentioned.back()) {
          if (const auto known = index_of.find(other); known != index_of.end())
            dependencies.push_back(known->second);
        }
      });
    }
    errors.raise();
  }
  [[nodiscard]] std::vector<std::size_t> order(const std::string& kind) const {
    return dependency_order(mentions, names, kind, pointers);
  }
};

Scope::Scope(const Node& root, MemoryReader& memory) : names_(dataset_names(root)) {
  add_names(root, memory);
  for (const Node& state : root.elements("states")) is_box_.push_back(!state.flag("discrete"));
  if (root["dynamics"].has("unit")) time_unit_ = root["dynamics"]["unit"].text();
  centres_ = read_abstraction(root).safe == Membership::center;
  if (root.has("constants")) evaluate_constants(root["constants"]);
  if (root.has("tables")) read_tables(root["tables"]);
  definitions_ = Definitions(static_cast<std::uint32_t>(slot_names_.size()));
  link_definitions(root, memory);
}

void Scope::add_names(const Node& root, const MemoryReader& memory) {
  ErrorList errors;
  errors.attempt([&] { add_variables(root, "states", NameKind::state); });
  for (const std::string& name : memory.names()) {
    const std::string pointer = root["memory"][name].pointer();
    errors.attempt([&] { names_.add(name, NameKind::memory, pointer); });
    for (const std::string& kept : memory.kept_by(name)) {
      errors.attempt([&] { names_.add(kept, NameKind::state, pointer); });
      slots_[kept] = static_cast<std::uint32_t>(slot_names_.size());
      slot_names_.push_back(kept);
      memories_in_[kept] = {name};
    }
  }
  errors.attempt([&] { add_variables(root, "inputs", NameKind::input); });
  inputs_end_ = static_cast<std::uint32_t>(slot_names_.size());
  errors.attempt([&] { add_variables(root, "disturbances", NameKind::disturbance); });
  const auto add_keys = [&](const std::string& object, NameKind kind) {
    if (!root.has(object)) return;
    for (const std::string& key : root[object].keys())
      errors.attempt([&] { names_.add(key, kind, root[object][key].pointer()); });
  };
  add_keys("constants", NameKind::constant);
  add_keys("definitions", NameKind::definition);
  add_keys("tables", NameKind::table);
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
  MentionGraph graph;
  graph.add_members(constants);
  graph.find_mentions([&](const std::string& name) {
    const Node node = constants[name];
    return node.is_text() ? mentioned_in(node) : std::vector<std::string>();
  });
  add_in_order(graph, graph.order("constants"),
               [&](const std::string& name) { constants_[name] = number(constants[name]); });
}

void Scope::read_tables(const Node& tables) {
  ErrorList errors;
  std::map<std::string, TableFunction, std::less<>> found;
  for (const std::string& name : tables.keys()) {
    errors.attempt(
        [&] { found[name] = read_table(tables[name], [&](const Node& node) { return number(node); }); });
  }
  errors.raise();
  tables_ = std::move(found);
}

TableLookup Scope::tables_for(const std::string& pointer) const {
  const auto find = [this, pointer](std::string_view name) -> const TableFunction* {
    const auto table = tables_.find(name);
    if (table != tables_.end()) return &table->second;
    if (names_.find(std::string(name)) != NameKind::table) return nullptr;
    throw SpecError(fmt::format("expected constants only, found the table {}", quote_text(name)), pointer);
  };
  return {find, [this](std::string_view name) {
            std::vector<std::string> known;
            for (const auto& [table_name, table] : tables_) known.push_back(table_name);
            return suggestion(name, known);
          }};
}

std::vector<std::string> Scope::mentioned_in(const Node& expression) const {
  return mentioned_names(expression.text(), tables_for(expression.pointer()), expression.pointer());
}

/// Definitions and memories may mention each other.
void Scope::link_definitions(const Node& root, MemoryReader& memory) {
  MentionGraph graph;
  if (root.has("definitions")) graph.add_members(root["definitions"]);
  for (const std::string& name : memory.names()) graph.add(name, root["memory"][name].pointer());
  const auto is_memory = [&](const std::string& name) { return names_.find(name) == NameKind::memory; };
  graph.find_mentions([&](const std::string& name) {
    if (is_memory(name)) return memory.mentioned(name, tables_for(root["memory"][name].pointer()));
    return mentioned_in(root["definitions"][name]);
  });
  const std::string kind = memory.names().empty() ? "definitions" : "definitions and memories";
  add_in_order(graph, graph.order(kind), [&](const std::string& name) {
    const std::size_t index = graph.index_of.at(name);
    note_memories(name, graph.mentioned[index]);
    if (!is_memory(name)) {
      definitions_.add(name, link_text(root["definitions"][name], ExpectedType::any));
      return;
    }
    const auto find = [&](std::string_view mention) {
      return find_for_memory(mention, graph.pointers[index]);
    };
    Program truth = memory.linked(name, find, tables_for(graph.pointers[index]));
    for (Program::Node& node : truth.nodes) {
      if (node.op == Operator::variable && node.a < is_box_.size() && is_box_[node.a]) node.a += kSeenCell;
    }
    memories_[name] = std::make_shared<const Program>(std::move(truth));
  });
}

/// Which memories a name is, or rests on by what its text mentions.
void Scope::note_memories(const std::string& name, const std::vector<std::string>& mentioned) {
  std::set<std::string> all;
  if (names_.find(name) == NameKind::memory) all.insert(name);
  for (const std::string& mention : mentioned) {
    if (const auto known = memories_in_.find(mention); known != memories_in_.end())
      all.insert(known->second.begin(), known->second.end());
  }
  if (!all.empty()) memories_in_[name] = std::move(all);
}

/// Formulas are over states, constants, definitions over these, and other memories.
Binding Scope::find_for_memory(std::string_view name, const std::string& pointer) const {
  const std::optional<NameKind> kind = names_.find(std::string(name));
  const auto refuse = [&](const std::string& found, NameKind its_kind) {
    throw SpecError(fmt::format("expected an expression over states, found the {} {}", kind_name(its_kind),
                                quote_text(found)),
                    pointer);
  };
  if (kind == NameKind::input || kind == NameKind::disturbance) refuse(std::string(name), *kind);
  if (kind == NameKind::memory) {
    return std::make_shared<const Program>(seen_as(*memories_.find(name)->second, 0));
  }
  if (kind != NameKind::definition) {
    Binding binding = find(name);
    if (std::holds_alternative<NotDefined>(binding)) binding = NotDefined{suggestion(name, names_.all())};
    return binding;
  }
  Program program = definitions_.expand(link(
      name, [this](std::string_view mention) { return find(mention); }, ExpectedType::any, pointer));
  for (const std::uint32_t slot : program.variables()) {
    if (slot >= slot_names_.size()) continue;  // a memory's, for now
    const NameKind its_kind = names_.find(slot_names_[slot]).value();
    if (its_kind != NameKind::state) refuse(slot_names_[slot], its_kind);
  }
  return std::make_shared<const Program>(seen_as(program, 0));
}

Rational Scope::number(const Node& node) const {
  if (node.is_text()) return constant_expression(node);
  const std::optional<Rational> value = parse_decimal(node.token());
  if (!value)
    throw SpecError("number with an exponent beyond 5000: " + quote_text(node.token()), node.pointer());
  check_size(*value, node.pointer());
  return *value;
}

Rational Scope::time(const Node& node) const {
  if (node.is_text()) {
    if (const std::optional<Rational> value = time_in(node.text(), time_unit_)) {
      check_size(*value, node.pointer());
      return *value;
    }
    if (time_in(node.text(), "s")) {
      throw SpecError(
          fmt::format("found {}, expected a number: \"unit\" of \"dynamics\" is {}", quote_text(node.text()),
                      time_unit_.empty() ? "not given" : quote_text(time_unit_)),
          node.pointer());
    }
  }
  return number(node);
}

namespace {

/// "2 s", "30 km/h": a number with a unit of the usual ones behind it.
bool has_unit(std::string_view text) {
  const std::size_t end = text.find_first_not_of("+-.0123456789");
  if (end == std::string_view::npos || !parse_decimal(text.substr(0, end))) return false;
  const std::size_t unit = text.find_first_not_of(' ', end);
  return unit != std::string_view::npos && unit_value(text.substr(unit)).has_value();
}

}  // namespace

Rational Scope::constant_expression(const Node& node) const {
  if (has_unit(node.text())) {
    throw SpecError(
        fmt::format("expected a number, found {}: units are separate, in \"unit\"", quote_text(node.text())),
        node.pointer());
  }
  for (const std::string& name : mentioned_in(node)) {
    const std::optional<NameKind> kind = names_.find(name);
    if (kind && *kind != NameKind::constant) {
      throw SpecError(
          fmt::format("expected constants only, found the {} {}", kind_name(*kind), quote_text(name)),
          node.pointer());
    }
  }
  const Program program = link_text(node, ExpectedType::number);
  const Rational value = constant_value(program, node.pointer());
  check_size(value, node.pointer());
  return value;
}

Program Scope::expression(const Node& node, ExpectedType expected, Dependence dependence) const {
  if (expected == ExpectedType::number) refuse_memories(node);
  Program program = definitions_.expand(link_text(node, expected));
  check_dependence(program, dependence, node.pointer());
  if (memories_.empty()) return program;
  return seen_as(program, dependence == Dependence::states_and_inputs && !centres_ ? inputs_end_ : 0);
}

/// Only conditions may mention memories: other expressions say how states move or what agents prefer, and
/// memories follow from these.
void Scope::refuse_memories(const Node& node) const {
  if (memories_in_.empty()) return;
  for (const std::string& name : mentioned_in(node)) {
    const auto found = memories_in_.find(name);
    if (found == memories_in_.end()) continue;
    const std::string& memory = *found->second.begin();
    const std::string through = memory == name ? "" : " through " + quote_text(name);
    throw SpecError(
        "expected no memory but in conditions such as 'safe', found " + quote_text(memory) + through,
        node.pointer());
  }
}

/// With the slots that stand for the cell of a state moved to `first` and the following.
Program Scope::seen_as(const Program& program, std::uint32_t first) const {
  Program moved = program;
  for (Program::Node& node : moved.nodes) {
    if (node.op == Operator::variable && node.a >= kSeenCell) node.a = first + (node.a - kSeenCell);
  }
  TapeBuilder tape;
  moved = tape.extract(tape.merge(moved));
  moved.text = program.text;
  return moved;
}

bool Scope::is_disturbance(std::uint32_t slot) const {
  return names_.find(slot_names_[slot]) == NameKind::disturbance;
}

Program Scope::link_text(const Node& node, ExpectedType expected) const {
  constexpr std::size_t kTooShort = 2;  // such names differ by a letter anyway
  const auto lookup = [&](std::string_view name) {
    Binding binding = find(name);
    if (std::holds_alternative<NotDefined>(binding)) {
      const std::vector<std::string> known = names_.all();
      binding = NotDefined{name.size() > kTooShort ? suggestion(name, known) : same_letters(name, known)};
    }
    return binding;
  };
  return link(node.text(), lookup, tables_for(node.pointer()), expected, node.pointer());
}

void Scope::check_dependence(const Program& program, Dependence dependence,
                             const std::string& pointer) const {
  for (const std::uint32_t slot : program.variables()) {
    if (slot >= slot_names_.size()) continue;  // a memory's
    const std::string& name = slot_names_[slot];
    const NameKind kind = names_.find(name).value();
    const bool is_allowed = dependence == Dependence::everything || kind == NameKind::state ||
                            (dependence == Dependence::states_and_inputs && kind == NameKind::input);
    if (is_allowed) continue;
    throw SpecError(fmt::format("expected an expression over {}, found the {} {}",
                                dependence == Dependence::states ? "states" : "states and inputs",
                                kind_name(kind), quote_text(name)),
                    pointer);
  }
}

Binding Scope::find(std::string_view name) const {
  if (const auto slot = slots_.find(name); slot != slots_.end()) return slot->second;
  if (const auto constant = constants_.find(name); constant != constants_.end()) return constant->second;
  if (const auto memory = memories_.find(name); memory != memories_.end()) return memory->second;
  return definitions_.find(name);
}

}  // namespace coordreq
