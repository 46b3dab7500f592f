#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace coordreq {

/// Where an error in an expression is: turns byte offsets into what a user can find in an editor.
struct SourceText {
  std::string_view text;   ///< the expression
  std::string_view where;  ///< its JSON pointer

  /// "WHERE, column 6", or "WHERE, line 2, column 3" if the text has several lines. Both count from 1;
  /// columns count Unicode code points.
  [[nodiscard]] std::string at(std::size_t offset) const;

  /// @throws SpecError always
  [[noreturn]] void fail(std::string_view what, std::size_t offset) const;
};

/// `text` in quotes and on one line for a message, shortened if long. @pre ASCII, no control characters but
/// white space; what the grammar accepts is that
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The character at the start of `text` as a message may show it: printable ASCII in quotes, anything else by
/// its code point ("U+00E9") or, in broken UTF-8, by its byte; a terminal never gets to see control
/// characters.
[[nodiscard]] std::string character_text(std::string_view text);

/// Bytes of the code point at the start of `text`, 1 for broken UTF-8. @pre text is not empty
[[nodiscard]] std::size_t code_point_size(std::string_view text);

}  // namespace coordreq
