#pragma once

#include "spec/json_document.hpp"

namespace coordreq {

/// Validates the document with spec_schema().
/// @throws SpecError that names the JSON pointer, what was found and what was expected
void check_schema(const JsonDocument& document);

}  // namespace coordreq
