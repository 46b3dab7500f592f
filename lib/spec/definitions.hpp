#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "expression/program.hpp"
#include "expression/tape_builder.hpp"

namespace coordreq {

/// The named sub-expressions of a spec.
///
/// Each is kept with the others as variables of their own, and put together only where an expression is used:
/// were each one linked with a copy of all below it, a chain of n would cost n^2.
class Definitions {
 public:
  /// @param first_slot the first slot that no variable of the spec has
  explicit Definitions(std::uint32_t first_slot = 0) : first_slot_(first_slot) {}

  /// @pre a new name. @pre unchecked: `program` was linked with what find() gave for the definitions added
  /// before
  void add(const std::string& name, Program program);

  /// The meaning of a name of a definition in an expression; NotDefined if there is none of that name.
  [[nodiscard]] Binding find(std::string_view name) const;

  /// `program` with every definition it mentions put in. Cost: linear in the size of all that it needs.
  /// @pre unchecked: `program` was linked with what find() gave.
  [[nodiscard]] Program expand(const Program& program) const;

 private:
  using Index = TapeBuilder::Index;

  /// Slots beyond those of the definitions are provisional ones of memories.
  [[nodiscard]] bool is_definition(const Program::Node& node) const;
  [[nodiscard]] bool stands_for_condition(const Program& program, const Program::Node& node) const;
  [[nodiscard]] std::size_t definition_at(const Program::Node& node) const { return node.a - first_slot_; }
  void mark_mentioned(const Program& program, std::vector<bool>& needed) const;
  [[nodiscard]] Index copy(const Program& program, const std::vector<Index>& values, TapeBuilder& tape) const;

  std::uint32_t first_slot_;
  std::vector<Program> programs_;  // each mentions only those before it
  std::map<std::string, std::size_t, std::less<>> index_of_;
};

}  // namespace coordreq
