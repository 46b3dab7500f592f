#pragma once

#include <string>
#include <string_view>

#include "spec/json_document.hpp"

namespace coordreq {

/// The document with what `silence.hold` stands for: inputs that keep their last value during silence.
///
/// For each such input u it adds, after all others, a discrete state `u_held` with the input's values and the
/// next value u, which the agent of u sees; and to the communication-loss rule of that agent, with `and`, the
/// condition `u == u_held`. Where the values of u are not evenly spaced, u_held is the number of the value in
/// the list, from 0. Without `hold` the document stays as it is.
/// @param text, source what the document was parsed from
/// @pre unchecked: the document follows the schema.
/// @throws SpecError naming an input that is unknown or listed twice, or a name that is taken; SpecError and
///   SpecErrors about constants and inputs
[[nodiscard]] JsonDocument with_held_inputs(const JsonDocument& document, const std::string& text,
                                            std::string_view source);

}  // namespace coordreq
