#pragma once

#include <string>
#include <string_view>

namespace coordreq {

/// What a function of another language is called here, for the end of a message: ", did you mean 'log'?";
/// empty if nothing is known.
[[nodiscard]] std::string meant_function(std::string_view name);

/// The same of a constant, or of a truth value.
[[nodiscard]] std::string meant_constant(std::string_view name);

}  // namespace coordreq
