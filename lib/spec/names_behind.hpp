#pragma once

#include <set>
#include <string>

#include "base/json.hpp"

namespace coordreq {

/// The names that an expression mentions, of functions and keywords too.
[[nodiscard]] std::set<std::string> names_in(const std::string& expression);

/// These, and what constants, definitions and memories among them mention in turn. @param spec the document
[[nodiscard]] std::set<std::string> with_names_behind(const Json& spec, std::set<std::string> names);

}  // namespace coordreq
