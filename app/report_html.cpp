#include "app/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/text.hpp"
#include "export/report_page.hpp"

namespace coordreq {

std::string html_line(const std::string& text) {
  return html_text(printable(text));
}

std::string html_code(const std::string& text) {
  return "<code>" + html_line(text) + "</code>";
}

std::string with_unit(const std::string& html, const std::string& unit) {
  return unit.empty() ? html : html + " " + html_line(unit);
}

std::string html_row(const std::vector<std::string>& cells) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    html += i == 0 ? "<th scope=\"row\">" + cells[i] + "</th>" : "<td>" + cells[i] + "</td>";
  return html + "</tr>\n";
}

std::string html_table(const std::string& caption, const std::vector<std::string>& heads,
                       const std::string& rows, const std::string& kind) {
  std::string html = "<div class=\"scroll\"><table";
  html += kind.empty() ? ">" : " class=\"" + kind + "\">";
  if (!caption.empty()) html += "<caption>" + caption + "</caption>";
  html += "<thead><tr>";
  for (const std::string& head : heads) html += "<th scope=\"col\">" + head + "</th>";
  return html + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string html_long_table(const std::vector<std::string>& heads, const std::vector<std::string>& rows,
                            const std::string& kind, std::size_t open) {
  const auto joined = [&rows](std::size_t first, std::size_t last) {
    std::string text;
    for (std::size_t i = first; i < last; ++i) text += rows[i];
    return text;
  };
  open = std::min(rows.size(), open);
  std::string html = html_table("", heads, joined(0, open), kind);
  if (open < rows.size()) {
    html += fmt::format("<details><summary>{} more</summary>\n{}</details>\n", grouped(rows.size() - open),
                        html_table("", heads, joined(open, rows.size()), kind));
  }
  return html;
}

std::string share_text(std::uint64_t count, std::uint64_t whole) {
  const double percent = 100 * static_cast<double>(count) / static_cast<double>(whole);
  if (count == 0) return "none";
  if (count == whole) return "all";
  if (percent < 0.1) return "less than 0.1 %";
  if (percent > 99.9) return "more than 99.9 %";
  return fmt::format("{:.{}f} %", percent, percent < 10 || percent > 90 ? 1 : 0);
}

std::string capital(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

std::string states_text(std::uint64_t count) {
  return grouped(count) + (count == 1 ? " state" : " states");
}

}  // namespace coordreq
