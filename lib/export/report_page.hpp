#pragma once

#include <string>
#include <string_view>

// The templates of the page, files of lib/export/report that the program carries.
namespace coordreq {

/// `text` as HTML or XML text or attribute value: & < > " ' as entities.
[[nodiscard]] std::string html_text(std::string_view text);

/// The contents of a page.
struct ReportPage {
  std::string title;    ///< plain text
  std::string summary;  ///< HTML: what stands before the pictures
  std::string details;  ///< HTML: what stands after them
  std::string data;     ///< JSON of report_data()
};

/// The page, complete in itself: it may load nothing and run no other script than its own (Content Security
/// Policy by hash).
[[nodiscard]] std::string report_page(const ReportPage& page);

/// HTML with places "{{name}}".
[[nodiscard]] std::string_view report_html();
[[nodiscard]] std::string_view report_style();
[[nodiscard]] std::string_view report_script();

}  // namespace coordreq
