#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "expression/program.hpp"
#include "expression/table_function.hpp"
#include "numeric/rational.hpp"
#include "spec/definitions.hpp"
#include "spec/json_document.hpp"
#include "spec/names.hpp"
#include "spec/read_memory.hpp"

namespace coordreq {

/// The vertices 0, ..., n - 1 ordered so that each stands after all it depends on.
/// @param dependencies for each vertex those it depends on
/// @param names what to call the vertices in the error
/// @param kind "definitions", for the error
/// @param pointers JSON pointers of the vertices, for the error
/// @throws SpecError naming a cycle, "a -> b -> a"
/// Iterative, so that a chain may be as long as memory allows. Cost: linear.
[[nodiscard]] std::vector<std::size_t> dependency_order(
    const std::vector<std::vector<std::size_t>>& dependencies, const std::vector<std::string>& names,
    const std::string& kind, const std::vector<std::string>& pointers);

/// The variables that an expression of the spec may depend on.
enum class Dependence : std::uint8_t { states, states_and_inputs, everything };

/// Everything that expressions of one spec can name, and the way to read numbers and expressions with it.
class Scope {
 public:
  /// Registers all names, evaluates the constants, reads the tables, links the definitions and the memories.
  /// @param memory of the same document
  /// @pre unchecked: the document follows the schema.
  /// @throws SpecError for names that clash, cycles, and anything wrong in a constant, definition or memory
  Scope(const JsonDocument::Node& root, MemoryReader& memory);

  /// The exact value of a number or of a string with a constant expression.
  /// @throws SpecError if it has none that is finite as a double, or one of more than 4096 bits
  [[nodiscard]] Rational number(const JsonDocument::Node& node) const;

  /// The same of a time in the unit of the spec, `dynamics.unit`; also "500 ms", "10min", where that is a
  /// unit of time. @throws SpecError
  [[nodiscard]] Rational time(const JsonDocument::Node& node) const;

  /// The linked expression in a string. Conditions may name memories, numbers may not.
  /// @throws SpecError for errors in it, and if it depends on more than `dependence`
  [[nodiscard]] Program expression(const JsonDocument::Node& node, ExpectedType expected,
                                   Dependence dependence) const;

  /// The slot is one of a disturbance.
  [[nodiscard]] bool is_disturbance(std::uint32_t slot) const;

 private:
  struct MentionGraph;

  void add_names(const JsonDocument::Node& root, const MemoryReader& memory);
  void add_variables(const JsonDocument::Node& root, const std::string& list, NameKind kind);
  void evaluate_constants(const JsonDocument::Node& constants);
  void read_tables(const JsonDocument::Node& tables);
  void link_definitions(const JsonDocument::Node& root, MemoryReader& memory);
  void note_memories(const std::string& name, const std::vector<std::string>& mentioned);
  void refuse_memories(const JsonDocument::Node& node) const;
  [[nodiscard]] Binding find_for_memory(std::string_view name, const std::string& pointer) const;
  void check_dependence(const Program& program, Dependence dependence, const std::string& pointer) const;
  [[nodiscard]] Rational constant_expression(const JsonDocument::Node& node) const;
  [[nodiscard]] Program link_text(const JsonDocument::Node& node, ExpectedType expected) const;
  [[nodiscard]] Binding find(std::string_view name) const;
  /// The tables that an expression at `pointer` can call.
  [[nodiscard]] TableLookup tables_for(const std::string& pointer) const;
  [[nodiscard]] std::vector<std::string> mentioned_in(const JsonDocument::Node& expression) const;

  [[nodiscard]] Program seen_as(const Program& program, std::uint32_t first) const;

  NameTable names_;
  std::string time_unit_;     ///< as written; empty if none was given
  std::vector<bool> is_box_;  ///< [slot] of the spec's own states: not discrete
  std::uint32_t inputs_end_ = 0;
  bool centres_ = false;  ///< memories are evaluated at the centres of cells
  std::vector<std::string> slot_names_;
  std::map<std::string, std::uint32_t, std::less<>> slots_;
  std::map<std::string, Rational, std::less<>> constants_;
  /// Over slots of their own for states that are not discrete, until it is known who asks.
  std::map<std::string, std::shared_ptr<const Program>, std::less<>> memories_;
  std::map<std::string, std::set<std::string>> memories_in_;  ///< the memories that a name is or rests on
  std::map<std::string, TableFunction, std::less<>> tables_;
  Definitions definitions_;
};

}  // namespace coordreq
