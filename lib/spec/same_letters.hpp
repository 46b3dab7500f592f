#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace coordreq {

/// ", did you mean 'v1'?" if a known name differs from `name` in capitals only, else an empty text.
[[nodiscard]] std::string same_letters(std::string_view name, const std::vector<std::string>& known);

}  // namespace coordreq
