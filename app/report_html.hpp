#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// Pieces of HTML. Parameters called `html` and the like are HTML already.
namespace coordreq {

/// User text on one line as HTML.
[[nodiscard]] std::string html_line(const std::string& text);
/// User text on one line in a `code` element of HTML.
[[nodiscard]] std::string html_code(const std::string& text);

/// "0.5 m". @param unit user text
[[nodiscard]] std::string with_unit(const std::string& html, const std::string& unit);

/// A row of a table; the first cell is its heading.
[[nodiscard]] std::string html_row(const std::vector<std::string>& cells);
/// @param kind class of the style sheet, if there is one
[[nodiscard]] std::string html_table(const std::string& caption, const std::vector<std::string>& heads,
                                     const std::string& rows, const std::string& kind = "");

/// The first rows in the open, all others where one can unfold them.
[[nodiscard]] std::string html_long_table(const std::vector<std::string>& heads,
                                          const std::vector<std::string>& rows, const std::string& kind = "",
                                          std::size_t open = 12);

/// "3.3 %" of what; never 0 or 100 unless it is none or all.
[[nodiscard]] std::string share_text(std::uint64_t count, std::uint64_t whole);

/// The text with a capital letter in front.
[[nodiscard]] std::string capital(std::string text);

/// "1 state", "1,234 states".
[[nodiscard]] std::string states_text(std::uint64_t count);

}  // namespace coordreq
