#pragma once

#include <functional>
#include <string>

#include "app/options.hpp"
#include "base/json.hpp"

namespace coordreq {

/// Prints what a command has found: as it is with --json, else in words, which are made of nothing but it,
/// unless --quiet.
void print_answer(const CommonOptions& asked, const Json& answer,
                  const std::function<std::string(const Json&)>& in_words);

}  // namespace coordreq
