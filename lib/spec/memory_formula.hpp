#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace coordreq {

/// A segment of the text of a formula in which calls of past operators are replaced by names that nothing
/// else has. As long as the formula, blank outside of the segment, so that errors name positions in the
/// formula.
struct FormulaSegment {
  std::string text;
  std::map<std::string, std::size_t, std::less<>> calls;  ///< by name: which of MemoryFormula::calls
  [[nodiscard]] const std::size_t* call(std::string_view name) const {
    const auto found = calls.find(name);
    return found == calls.end() ? nullptr : &found->second;
  }
};

/// The formula of a memory, taken apart at its past operators.
struct MemoryFormula {
  struct Call {
    std::string_view operation;  ///< "once", ...
    std::vector<FormulaSegment> arguments;
  };
  FormulaSegment whole;
  std::vector<Call> calls;  ///< in the order of the text, an outer one before its inner ones
};

/// @throws SpecError with the position in `where` for a wrong number of arguments, or too deep nesting. What
///   else is wrong shows when a segment is linked.
[[nodiscard]] MemoryFormula take_apart_formula(std::string_view text, std::string_view where);

}  // namespace coordreq
