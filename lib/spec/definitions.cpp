#include "spec/definitions.hpp"

#include <memory>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
void Definitions::add(const std::string& name, Program program) {
  REQUIRES(!index_of_.contains(name));
  index_of_[name] = programs_.size();
  programs_.push_back(std::move(program));
}

Binding Definitions::find(std::string_view name) const {
  const auto found = index_of_.find(name);
  if (found == index_of_.end()) return NotDefined{};
  const std::uint32_t slot = first_slot_ + static_cast<std::uint32_t>(found->second);
  if (!programs_[found->second].is_condition()) return slot;
  // No variable is a condition, so a comparison of the slot with itself stands for one.
  Program stand_in;
  stand_in.nodes = {{Operator::variable, slot}, {Operator::equal, 0, 0}};
  return std::make_shared<const Program>(std::move(stand_in));
}

Program Definitions::expand(const Program& program) const {
  std::vector<bool> needed(programs_.size(), false);
  mark_mentioned(program, needed);
  for (std::size_t i = programs_.size(); i-- > 0;) {
    if (needed[i]) mark_mentioned(programs_[i], needed);
  }
  TapeBuilder tape;
  std::vector<Index> values(programs_.size(), 0);
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    if (needed[i]) values[i] = copy(programs_[i], values, tape);
  }
  Program expanded = tape.extract(copy(program, values, tape));
  expanded.text = program.text;
  return expanded;
}

bool Definitions::is_definition(const Program::Node& node) const {
  return node.op == Operator::variable && node.a >= first_slot_ && definition_at(node) < programs_.size();
}

bool Definitions::stands_for_condition(const Program& program, const Program::Node& node) const {
  if (node.op != Operator::equal || node.a != node.b) return false;
  const Program::Node& operand = program.nodes[node.a];
  return is_definition(operand) && programs_[definition_at(operand)].is_condition();
}

void Definitions::mark_mentioned(const Program& program, std::vector<bool>& needed) const {
  for (const Program::Node& node : program.nodes) {
    if (is_definition(node)) needed[definition_at(node)] = true;
  }
}

TapeBuilder::Index Definitions::copy(const Program& program, const std::vector<Index>& values,
                                     TapeBuilder& tape) const {
  std::vector<Index> here;
  here.reserve(program.nodes.size());
  for (const Program::Node& node : program.nodes) {
    if (is_definition(node)) {
      here.push_back(values[definition_at(node)]);
    } else if (stands_for_condition(program, node)) {
      here.push_back(here[node.a]);
    } else {
      here.push_back(tape.copy(program, node, here));
    }
  }
  return here.back();
}

}  // namespace coordreq
