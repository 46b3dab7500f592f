#pragma once

#include <optional>
#include <string>

namespace coordreq {

/// The file that was installed with this program, at `installed` below the same prefix; for a program that
/// was built and not installed, the one at `in_sources`. Nothing if it is not there. An installed program
/// does not know its prefix: it looks around from where it is.
[[nodiscard]] std::optional<std::string> file_beside_program(const std::string& installed,
                                                             const std::string& in_sources);

}  // namespace coordreq
