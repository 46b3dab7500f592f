#pragma once

#include <cstddef>

#include "spec/json_text.hpp"

namespace coordreq {

/// Where a parser stands.
enum class JsonLevel { kOutermost, kObject, kList };

/// Says in one line what is wrong with a text that the parser gave up.
/// @param read bytes that it has read, the first wrong one among them; more than there are at the end of the
/// text
/// @throws SpecError with what was expected, what was found, line and column
[[noreturn]] void fail_syntax(const JsonText& json, std::size_t read, JsonLevel level);

}  // namespace coordreq
