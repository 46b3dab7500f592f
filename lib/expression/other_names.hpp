#pragma once

#include <string>
#include <string_view>

namespace coordreq {

/// The name here of a function of other languages, for the end of a message: ", did you mean 'log'?"; empty
/// if none is known.
[[nodiscard]] std::string suggested_function(std::string_view name);

/// suggested_function() for a sign beyond ASCII, in UTF-8: ", did you mean '<='?".
[[nodiscard]] std::string suggested_sign(std::string_view sign);

/// suggested_function() for constants and truth values.
[[nodiscard]] std::string suggested_constant(std::string_view name);

}  // namespace coordreq
