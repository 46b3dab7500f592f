#pragma once

#include <string_view>

// The parts of the page, files of lib/export/report that the program carries.
namespace coordreq {

/// HTML with places "{{name}}".
[[nodiscard]] std::string_view report_html();
[[nodiscard]] std::string_view report_style();
[[nodiscard]] std::string_view report_script();

}  // namespace coordreq
