#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "answers/step_codes.hpp"
#include "numeric/rational.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The value of a field of steps for a state of a pair in a fleet (contract, "Fleets"): -2 beyond an unsafe
/// side of the domain; else kUnbounded beyond a `safe` or `goal` side; else that of its cell, or beyond a
/// `saturate` or `stop` side of the boundary cell. @pre the field is of steps by partition
/// @throws UsageError where a discrete state is not one of its values. @param where for the message
[[nodiscard]] std::int32_t steps_of_pair(const ResultsReader& results, const Field& field,
                                         std::size_t partition, const std::vector<Rational>& state,
                                         const std::string& where);

/// The least of many pairs.
struct LeastSteps {
  std::int64_t pairs = 0;
  std::int32_t least = kUnbounded;    ///< as the field has it: below 0 a flag
  std::string pair;                   ///< its label, else the number of its row; of equals the first
  std::optional<std::int64_t> below;  ///< pairs with less than `at_least`, if there is one
};

/// Reads pairs as StateReader reads states; a column (of JSON lines a key) `pair` that is no state is a
/// label.
/// @param source for messages @param report is given the names of other columns, as often as they may change
/// @throws UsageError; where there are no pairs, too
[[nodiscard]] LeastSteps least_steps(const ResultsReader& results, const Field& field, std::size_t partition,
                                     std::istream& pairs, const std::string& source,
                                     std::optional<std::int32_t> at_least,
                                     const std::function<void(const std::vector<std::string>&)>& report);

}  // namespace coordreq
