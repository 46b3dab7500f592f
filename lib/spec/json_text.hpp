#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// The text of a JSON document as its author sees it: lines, columns, words.
namespace coordreq {

/// A text and what messages call it.
struct JsonText {
  std::string_view text;    ///< without a byte order mark
  std::string_view source;  ///< file name

  /// "line 3, column 5" for the byte at `offset`; both count from 1, columns in code points.
  [[nodiscard]] std::string position(std::size_t offset) const;
  /// "circle.json, line 3, column 5".
  [[nodiscard]] std::string at(std::size_t offset) const;

  /// The token that starts at `offset`, quoted for a message; "the end of the file" behind the last byte.
  [[nodiscard]] std::string found_at(std::size_t offset) const;

  /// The token that starts at `offset`, a string to the end of its line at most; empty behind the last byte.
  [[nodiscard]] std::string_view token(std::size_t offset) const;

  /// Where the first token at `offset` or behind it starts, comments left out.
  [[nodiscard]] std::size_t token_from(std::size_t offset) const;
  /// Where a comment starts that has no end, though it needs one; nothing if there is none.
  [[nodiscard]] std::optional<std::size_t> open_comment() const;

  /// Where the `number`-th bracket (from 1) stands that opens an object or a list.
  /// @pre unchecked: the text is well-formed up to there.
  [[nodiscard]] std::size_t bracket(std::size_t number) const;

  /// Where the last token before `offset` starts, comments left out; behind the text if there is none.
  [[nodiscard]] std::size_t token_before(std::size_t offset) const;

  /// @throws SpecError with the place
  [[noreturn]] void fail(std::string_view what, std::size_t offset) const;
};

/// `text` without a UTF-8 byte order mark.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

/// @throws SpecError if the text is blank, is not UTF-8, or contains a NUL byte.
void check_encoding(const JsonText& json);

/// Where a parser stands.
enum class JsonLevel { kOutermost, kObject, kList };

/// Says in one line what is wrong with a text that the parser gave up.
/// @param read bytes that it has read, the first wrong one among them; more than there are at the end of the
/// text
/// @throws SpecError with what was expected, what was found, line and column
[[noreturn]] void fail_syntax(const JsonText& json, std::size_t read, JsonLevel level);

}  // namespace coordreq
