#include "export/report_page.hpp"

#include <charconv>
#include <cstddef>
#include <map>
#include <vector>

#include "export/base64.hpp"
#include "results/sha256.hpp"

namespace coordreq {
namespace {

using Values = std::map<std::string_view, std::string_view>;

/// The template with each "{{name}}" replaced; what is put in is not looked at again.
std::string filled(std::string_view form, const Values& values) {
  std::string page;
  while (true) {
    const std::size_t open = form.find("{{");
    page += form.substr(0, open);
    if (open == std::string_view::npos) return page;
    const std::size_t close = form.find("}}", open);
    page += values.at(form.substr(open + 2, close - open - 2));
    form.remove_prefix(close + 2);
  }
}

/// The digest of an inline element as a Content Security Policy names it.
std::string policy_hash(std::string_view text) {
  const std::string digits = sha256_hex(text);
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    unsigned value = 0;
    std::from_chars(digits.data() + i, digits.data() + i + 2, value, 16);
    bytes.push_back(static_cast<std::byte>(value));
  }
  return "'sha256-" + base64(bytes) + "'";
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string report_page(const ReportPage& page) {
  const std::string title = html_text(page.title);
  const std::string style_hash = policy_hash(report_style()), script_hash = policy_hash(report_script());
  return filled(report_html(), {{"title", title},
                                {"style", report_style()},
                                {"style_hash", style_hash},
                                {"script", report_script()},
                                {"script_hash", script_hash},
                                {"summary", page.summary},
                                {"details", page.details},
                                {"data", page.data}});
}

}  // namespace coordreq
