#pragma once

#include <string>
#include <vector>

#include "spec/set_value.hpp"

namespace coordreq {

/// A location in the spec and the values to try there: `--sweep PATH=V1,V2`.
struct Sweep {
  std::string path;
  std::vector<std::string> values;  ///< at least one
};

/// "states.0.step=0.02,0.01". Commas in brackets, parentheses and quotes belong to a value.
/// @throws UsageError
[[nodiscard]] Sweep parse_sweep(const std::string& text, const std::string& option);

/// "constants.R=0.7". @throws UsageError
[[nodiscard]] SpecSetting parse_setting(const std::string& text, const std::string& option);

/// Every combination of one value a sweep, in their order, that of the last sweep varying fastest; one empty
/// combination if there are none.
/// @throws UsageError if a path is swept twice or there are more than 10,000 combinations
[[nodiscard]] std::vector<std::vector<SpecSetting>> combinations(const std::vector<Sweep>& sweeps);

}  // namespace coordreq
