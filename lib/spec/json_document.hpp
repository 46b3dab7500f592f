#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/json.hpp"

namespace coordreq {

/// A parsed JSON text that still knows how its numbers were typed.
///
/// The values hold doubles, which is enough to check types; code that needs a number reads its token.
/// Immutable after parsing; a node must not outlive its document.
class JsonDocument {
 public:
  class Node;

  /// Parses JSON with comments.
  /// @param source the file name for messages
  /// @throws SpecError naming line and column for broken syntax, the JSON pointer for a repeated key; also
  ///   for nesting deeper than 200, keys longer than 200 bytes, numbers beyond a double, and U+0000 in a
  ///   string.
  [[nodiscard]] static JsonDocument parse(std::string_view text, std::string_view source);

  [[nodiscard]] const SortedJson& value() const { return *value_; }
  [[nodiscard]] Node root() const;

  /// Numbers as they were typed, by JSON pointer; integers that the values hold are not among them.
  [[nodiscard]] const std::unordered_map<std::string, std::string>& number_tokens() const {
    return number_tokens_;
  }

 private:
  std::shared_ptr<const SortedJson> value_;
  std::unordered_map<std::string, std::string> number_tokens_;
  std::unordered_map<std::string, std::vector<std::string>> keys_;  // of the objects in the outermost one
};

/// A value in the document and where it is.
class JsonDocument::Node {
 public:
  Node(const JsonDocument& document, const SortedJson& value, std::string pointer)
      : document_(&document), value_(&value), pointer_(std::move(pointer)) {}

  [[nodiscard]] const std::string& pointer() const { return pointer_; }

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] bool is_text() const;

  [[nodiscard]] bool has(const std::string& key) const;
  /// @pre an object that has the key
  [[nodiscard]] Node operator[](const std::string& key) const;
  /// @pre an array with more than `index` elements
  [[nodiscard]] Node operator[](std::size_t index) const;
  [[nodiscard]] std::size_t size() const;
  /// Elements of the array under `key`; none if there is no such key.
  [[nodiscard]] std::vector<Node> elements(const std::string& key) const;
  /// Elements of this array. @pre an array
  [[nodiscard]] std::vector<Node> elements() const;
  /// Keys of this object, sorted. @pre an object
  [[nodiscard]] std::vector<std::string> keys() const;
  /// In the order of the text. @pre a member of the document's object, an object itself
  [[nodiscard]] std::vector<std::string> keys_as_written() const;

  /// @pre a string
  [[nodiscard]] const std::string& text() const;
  /// The string under `key`, `fallback` if there is none.
  [[nodiscard]] std::string text_or(const std::string& key, std::string_view fallback) const;
  /// The boolean under `key`, false if there is none.
  [[nodiscard]] bool flag(const std::string& key) const;
  /// @pre a whole number
  [[nodiscard]] std::int64_t integer() const;
  /// The number as it was typed. @pre a number
  [[nodiscard]] std::string token() const;
  /// The value as JSON on one line, keys sorted.
  [[nodiscard]] std::string json() const;

 private:
  const JsonDocument* document_;
  const SortedJson* value_;
  std::string pointer_;
};

}  // namespace coordreq
