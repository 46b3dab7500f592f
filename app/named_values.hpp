#pragma once

#include <string>

#include "cell/simulate.hpp"

namespace coordreq {

/// "w1=0.1,w2=1/3": values by name, in the order given; each once.
/// @throws UsageError with `option` as the place
[[nodiscard]] NamedValues parse_named_values(const std::string& text, const std::string& option);

/// A whole number from `lowest` to `highest`. @throws UsageError with `option` as the place
[[nodiscard]] std::uint64_t parse_whole_number(const std::string& text, std::uint64_t lowest,
                                               std::uint64_t highest, const std::string& option);

}  // namespace coordreq
