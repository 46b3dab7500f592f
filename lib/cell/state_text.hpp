#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/csv.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The exact value of a decimal such as "-0.25" or of a constant expression such as "1/3" or "pi/4"
/// (irrational values are their correctly rounded doubles).
/// @param where for the message. @throws UsageError
[[nodiscard]] Rational parse_value(std::string_view text, const std::string& where);

/// A state of a problem as people and files name it.
struct StateNames {
  StateNames(std::vector<std::string> all) : names(std::move(all)), needed(names.size()) {}
  StateNames(std::initializer_list<std::string> all) : StateNames(std::vector<std::string>(all)) {}

  std::vector<std::string> names;
  std::size_t needed;  ///< so many need a value; the others, which memories keep, are 0 at first
};
[[nodiscard]] StateNames state_names(const SystemSpec& spec);

/// "x1=0.1,x2=1/3": one value a name, in any order. Commas in parentheses belong to a value.
/// @returns the values in the order of the names
/// @throws UsageError naming what is unknown, missing, given twice or no number
[[nodiscard]] std::vector<Rational> parse_state(std::string_view text, const StateNames& states,
                                                const std::string& where);

/// The text cut at commas that stand in no parentheses.
[[nodiscard]] std::vector<std::string_view> split_at_commas(std::string_view text);

/// Position of a state in `names`. @throws UsageError with a suggestion if there is none of this name
[[nodiscard]] std::size_t state_number(std::string_view name, const std::vector<std::string>& names,
                                       const std::string& where);

}  // namespace coordreq
