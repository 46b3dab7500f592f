#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Where the values of a JSON text stand in it, for edits that leave everything else as it was typed:
// comments, digits, the order of keys. All functions REQUIRE a text that JsonDocument::parse() has accepted.
namespace coordreq {

/// The bytes begin, ..., end - 1 of a text.
struct JsonSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// A key, spelt out, and its value.
struct JsonMember {
  std::string key;
  JsonSpan value;
};

/// The value that the whole text is.
[[nodiscard]] JsonSpan root_span(std::string_view text);

/// The members of the object at `object`, in the order of the text.
[[nodiscard]] std::vector<JsonMember> member_spans(std::string_view text, JsonSpan object);

/// The elements of the list at `list`.
[[nodiscard]] std::vector<JsonSpan> element_spans(std::string_view text, JsonSpan list);

}  // namespace coordreq
