#include "spec/json_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "spec/json_text.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kDeepestNesting = 200;
constexpr std::size_t kLongestKey = 200;

/// Receives the parser's events and builds the document.
class Builder : public nlohmann::json_sax<SortedJson> {
 public:
  using Keys = std::unordered_map<std::string, std::vector<std::string>>;

  Builder(const JsonText& json, SortedJson& root, std::unordered_map<std::string, std::string>& tokens,
          Keys& keys)
      : json_(json), root_(root), tokens_(tokens), keys_(keys) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& token) override {
    add(value);
    tokens_.emplace(last_pointer_, token);
    return true;
  }
  bool string(string_t& value) override {
    const bool has_nul = value.find('\0') != string_t::npos;
    add(std::move(value));
    if (has_nul) {
      throw SpecError("a string may not contain the character U+0000", pointer_text(last_pointer_));
    }
    return true;
  }
  bool binary(binary_t& /*value*/) override { return false; }  // JSON text has none

  bool start_object(std::size_t /*count*/) override { return open(SortedJson::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*count*/) override { return open(SortedJson::array()); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    const Level& level = levels_.back();
    const std::string where = pointer_text(level.pointer);
    if (name.size() > kLongestKey) throw SpecError("key longer than 200 bytes: " + quote_text(name), where);
    if (level.value->contains(name)) throw SpecError("repeated key " + quote_text(name), where);
    key_ = name;
    if (levels_.size() == 2) keys_[level.pointer].push_back(name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const SortedJson::exception& error) override {
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow) {
      json_.fail("number beyond the range of a double: " + quote_text(token), position - token.size());
    }
    if (levels_.empty()) fail_syntax(json_, position, JsonLevel::kOutermost);
    fail_syntax(json_, position, levels_.back().value->is_array() ? JsonLevel::kList : JsonLevel::kObject);
  }

 private:
  struct Level {
    SortedJson* value;
    std::string pointer;
  };

  /// Puts a value where the document is being written.
  bool add(SortedJson value) {
    insert(std::move(value));
    return true;
  }

  SortedJson* insert(SortedJson value) {
    if (levels_.empty()) {
      last_pointer_.clear();
      root_ = std::move(value);
      return &root_;
    }
    const Level& level = levels_.back();
    if (level.value->is_array()) {
      last_pointer_ = level.pointer + "/" + std::to_string(level.value->size());
      level.value->push_back(std::move(value));
      return &level.value->back();
    }
    last_pointer_ = member_pointer(level.pointer, key_);
    SortedJson& member = (*level.value)[key_];
    member = std::move(value);
    return &member;
  }

  bool open(SortedJson container) {
    ++opened_;
    SortedJson* const value = insert(std::move(container));
    if (levels_.size() == kDeepestNesting) {
      // Not the pointer: that of a deep place would fill a screen.
      json_.fail(fmt::format("nested deeper than {} levels", kDeepestNesting), json_.bracket(opened_));
    }
    levels_.push_back({value, last_pointer_});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  const JsonText& json_;
  SortedJson& root_;
  std::unordered_map<std::string, std::string>& tokens_;
  Keys& keys_;
  std::vector<Level> levels_;
  std::size_t opened_ = 0;  ///< objects and lists so far
  std::string key_;
  std::string last_pointer_;
};

}  // namespace

JsonDocument JsonDocument::parse(std::string_view text, std::string_view source) {
  const JsonText json{without_byte_order_mark(text), source};
  check_encoding(json);
  const auto value = std::make_shared<SortedJson>();
  JsonDocument document;
  document.value_ = value;
  Builder builder(json, *value, document.number_tokens_, document.keys_);
  constexpr bool kStrict = true;
  constexpr bool kIgnoreComments = true;
  // The builder throws on every error, so the result says nothing new.
  static_cast<void>(SortedJson::sax_parse(json.text.begin(), json.text.end(), &builder,
                                          SortedJson::input_format_t::json, kStrict, kIgnoreComments));
  return document;
}

JsonDocument::Node JsonDocument::root() const {
  return {*this, *value_, ""};
}

bool JsonDocument::Node::is_null() const {
  return value_->is_null();
}

bool JsonDocument::Node::is_object() const {
  return value_->is_object();
}

bool JsonDocument::Node::is_number() const {
  return value_->is_number();
}

bool JsonDocument::Node::is_text() const {
  return value_->is_string();
}

bool JsonDocument::Node::has(const std::string& key) const {
  return value_->contains(key);
}

std::size_t JsonDocument::Node::size() const {
  return value_->size();
}

const std::string& JsonDocument::Node::text() const {
  REQUIRES(is_text());
  return value_->get_ref<const std::string&>();
}

std::int64_t JsonDocument::Node::integer() const {
  REQUIRES(value_->is_number_integer());
  return value_->get<std::int64_t>();
}

JsonDocument::Node JsonDocument::Node::operator[](const std::string& key) const {
  REQUIRES(is_object() && has(key));
  return {*document_, value_->at(key), member_pointer(pointer_, key)};
}

JsonDocument::Node JsonDocument::Node::operator[](std::size_t index) const {
  REQUIRES(value_->is_array() && index < size());
  return {*document_, value_->at(index), pointer_ + "/" + std::to_string(index)};
}

std::vector<JsonDocument::Node> JsonDocument::Node::elements(const std::string& key) const {
  return has(key) ? (*this)[key].elements() : std::vector<Node>();
}

std::vector<JsonDocument::Node> JsonDocument::Node::elements() const {
  REQUIRES(value_->is_array());
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < size(); ++i) nodes.push_back((*this)[i]);
  return nodes;
}

std::vector<std::string> JsonDocument::Node::keys() const {
  REQUIRES(is_object());
  std::vector<std::string> names;
  for (const auto& [name, value] : value_->items()) names.push_back(name);
  return names;
}

std::vector<std::string> JsonDocument::Node::keys_as_written() const {
  REQUIRES(is_object() && pointer_.rfind('/') == 0);
  const auto found = document_->keys_.find(pointer_);
  return found == document_->keys_.end() ? std::vector<std::string>() : found->second;
}

std::string JsonDocument::Node::text_or(const std::string& key, std::string_view fallback) const {
  return has(key) ? (*this)[key].text() : std::string(fallback);
}

bool JsonDocument::Node::flag(const std::string& key) const {
  return has(key) && (*this)[key].value_->get<bool>();
}

std::string JsonDocument::Node::json() const {
  return value_->dump();
}

std::string JsonDocument::Node::token() const {
  REQUIRES(is_number());
  const auto typed = document_->number_tokens_.find(pointer_);
  return typed == document_->number_tokens_.end() ? value_->dump() : typed->second;
}

}  // namespace coordreq
