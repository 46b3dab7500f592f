#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "numeric/rational.hpp"

// How messages spell what a user typed. Everything fits one line of a terminal: control characters are
// escaped, long texts are cut.
namespace coordreq {

/// Control characters as "\u000A"; everything else, UTF-8 included, as it is.
[[nodiscard]] std::string one_line(std::string_view text);

/// 'text', one line, at most about 60 characters.
[[nodiscard]] std::string quote_text(std::string_view text);

/// A number rounded to six digits.
[[nodiscard]] std::string short_number(const Rational& value);

/// "'a'", "'a' or 'b'", "'a', 'b' or 'c'" with `joiner` "or".
[[nodiscard]] std::string quote_list(const std::vector<std::string>& names, std::string_view joiner);

/// ", did you mean 'step'?" if a known name is spelt almost like `name`, else an empty text.
[[nodiscard]] std::string suggestion(std::string_view name, const std::vector<std::string>& known);

/// The JSON pointer for messages: "top level" for the whole document.
[[nodiscard]] std::string pointer_text(std::string_view pointer);

/// The JSON pointer of a member of the object at `pointer`.
[[nodiscard]] std::string member_pointer(std::string_view pointer, std::string_view key);

/// ", did you mean 'v1'?" if a known name differs from `name` in capitals only, else an empty text.
[[nodiscard]] std::string same_letters(std::string_view name, const std::vector<std::string>& known);

}  // namespace coordreq
