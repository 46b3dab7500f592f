#pragma once

#include <string>
#include <string_view>

#include "app/program_help.hpp"

namespace coordreq {

/// The page coordreq(1) for man: roff with the macros of man(7), from the same descriptions as `--help`.
[[nodiscard]] std::string man_page(const ProgramHelp& help, std::string_view version);

}  // namespace coordreq
