#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "expression/table_function.hpp"
#include "spec/json_document.hpp"
#include "spec/memory_formula.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

/// Turns the formulas of `memory` into discrete states that keep what must be remembered, and into conditions
/// over the states and those (contract, section 6).
///
/// The states stand between the spec's own and the inputs, but how many there are follows from the formulas.
/// So a spec with memories is linked three times: for what its states are; with provisional numbers, by which
/// it is found out what can be undecided and so how many values each operator keeps; and with the final ones.
class MemoryReader {
 public:
  /// @pre unchecked: the document outlives this object.
  /// @throws SpecError if a formula cannot be taken apart
  explicit MemoryReader(const JsonDocument::Node& root);

  /// In the order of the spec.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// The names that a formula mentions.
  [[nodiscard]] std::vector<std::string> mentioned(const std::string& name, const TableLookup& tables) const;

  /// From now on names stand for provisional numbers of variables.
  void look_at(const std::vector<StateSpec>& states, Membership membership);
  /// From now on names stand for final numbers of variables. @pre all formulas have been linked since
  /// look_at()
  void settle();

  /// The condition that the name of a memory stands for; before look_at() a placeholder.
  /// @param find finds the meaning of other names; throws for those that are not for formulas
  /// @pre unchecked: what the formula mentions has been linked before.
  [[nodiscard]] Program linked(const std::string& name, const Lookup& find, const TableLookup& tables);

  /// The names of the states that keep it; none until settle().
  [[nodiscard]] std::vector<std::string> kept_by(const std::string& name) const;
  /// Adds those states and how they are kept. @pre all formulas have been linked since settle()
  void add_to(ProblemSpec& spec) const;

 private:
  enum class Phase : std::uint8_t { names, provisional, final };
  struct Call {
    PastOperator past;
    bool always = false;  ///< of `once`: not once(not c)
    [[nodiscard]] std::size_t kept() const {
      if (!past.is_counted()) return 1;
      return past.samples == 1 ? 0 : past.three_valued ? 2 : 1;
    }
  };
  struct Formula {
    std::string text;
    std::string pointer;
    MemoryFormula structure;
    std::vector<Call> calls;
    Program truth;
  };

  [[nodiscard]] Program link_segment(Formula& formula, const FormulaSegment& segment, ExpectedType expected,
                                     const Lookup& find, const TableLookup& tables);
  /// This is the phase, and all formulas have been linked.
  [[nodiscard]] bool are_linked(Phase phase) const;
  void link_call(Formula& formula, std::size_t number, const Lookup& find, const TableLookup& tables);
  [[nodiscard]] std::int64_t read_samples(Formula& formula, const FormulaSegment& segment, const Lookup& find,
                                          const TableLookup& tables);
  [[nodiscard]] bool can_be_undecided(const Program& condition) const;

  std::vector<std::string> names_;
  std::map<std::string, Formula> formulas_;
  std::vector<StateSpec> states_;
  Membership membership_ = Membership::inner;
  Phase phase_ = Phase::names;
  std::uint32_t next_slot_ = 0;                   ///< of the provisional ones
  std::map<std::uint32_t, std::int64_t> values_;  ///< [provisional slot] how many there are
};

}  // namespace coordreq
