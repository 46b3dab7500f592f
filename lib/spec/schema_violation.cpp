#include "spec/schema_violation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <string_view>
#include <vector>

#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Json = nlohmann::json;
using Found = std::optional<SchemaViolation>;

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return value.is_null();
}

bool type_matches(const Json& schema, const Json& value) {
  const auto type = schema.find("type");
  if (type == schema.end()) return true;
  if (type->is_string()) return has_type(value, *type);
  return std::any_of(type->begin(), type->end(), [&](const Json& one) { return has_type(value, one); });
}

std::size_t code_points(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

bool string_matches(const Json& schema, const std::string& text) {
  const std::size_t length = code_points(text);
  if (schema.contains("minLength") && length < schema["minLength"].get<std::size_t>()) return false;
  // Before the pattern: the library's matcher needs stack in proportion to the length.
  if (schema.contains("maxLength") && length > schema["maxLength"].get<std::size_t>()) return false;
  return !schema.contains("pattern") ||
         std::regex_search(text, std::regex(schema["pattern"].get<std::string>()));
}

bool number_matches(const Json& schema, const Json& value) {
  return !(schema.contains("minimum") && value < schema["minimum"]) &&
         !(schema.contains("maximum") && value > schema["maximum"]);
}

bool size_matches(const Json& schema, std::size_t size) {
  return !(schema.contains("minItems") && size < schema["minItems"].get<std::size_t>()) &&
         !(schema.contains("maxItems") && size > schema["maxItems"].get<std::size_t>());
}

bool is_listed(const Json& schema, const Json& value) {
  if (schema.contains("const") && schema["const"] != value) return false;
  const auto list = schema.find("enum");
  return list == schema.end() || std::find(list->begin(), list->end(), value) != list->end();
}

/// Everything about the value itself, not about what it contains.
bool value_matches(const Json& schema, const Json& value) {
  return type_matches(schema, value) && is_listed(schema, value) &&
         (!value.is_string() || string_matches(schema, value.get_ref<const std::string&>())) &&
         (!value.is_number() || number_matches(schema, value)) &&
         (!value.is_array() || size_matches(schema, value.size()));
}

/// 'text' for a string, else JSON.
std::string shown_scalar(const Json& value) {
  return value.is_string() ? quote_text(value.get_ref<const std::string&>()) : value.dump();
}

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return value.empty() ? "an empty list" : fmt::format("a list of {}", value.size());
  return shown_scalar(value);
}

std::string type_in_words(const std::string& type) {
  if (type == "boolean") return "true or false";
  if (type == "null") return type;
  if (type == "array") return "a list";
  return (type == "object" || type == "integer" ? "an " : "a ") + type;
}

std::vector<std::string> texts(const Json& list) {
  std::vector<std::string> result;
  for (const Json& item : list) result.push_back(item.get<std::string>());
  return result;
}

/// What a schema asks for, for "expected ...".
std::string wanted(const Json& schema) {
  if (schema.contains("title")) return schema["title"].get<std::string>();
  if (schema.contains("enum")) return quote_list(texts(schema["enum"]), "or");
  if (schema.contains("const")) return shown_scalar(schema["const"]);
  return type_in_words(schema["type"].get<std::string>());
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

class Walk {
 public:
  explicit Walk(const Json& root) : root_(root) {}

  Found value(const Json& schema_or_reference, const Json& value, const std::string& pointer) const {
    const Json& schema = resolve(schema_or_reference);
    if (schema.contains("anyOf")) return alternatives(schema, value, pointer);
    if (!value_matches(schema, value)) return mismatch(schema, value, pointer);
    if (value.is_object()) return object(schema, value, pointer);
    if (value.is_array()) return array(schema, value, pointer);
    return std::nullopt;
  }

 private:
  const Json& resolve(const Json& schema) const {
    if (!schema.contains("$ref")) return schema;
    // All references are "#/...".
    return root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
  }

  static SchemaViolation mismatch(const Json& schema, const Json& value, const std::string& pointer) {
    return {fmt::format("expected {}, found {}", wanted(schema), shown(value)), pointer};
  }

  /// The alternative of the value's own type is the one the author meant.
  Found alternatives(const Json& schema, const Json& value, const std::string& pointer) const {
    for (const Json& branch : schema["anyOf"]) {
      const Json& alternative = resolve(branch);
      const bool is_meant =
          alternative.contains("type") ? type_matches(alternative, value) : value_matches(alternative, value);
      if (is_meant) return this->value(alternative, value, pointer);
    }
    return mismatch(schema, value, pointer);
  }

  Found array(const Json& schema, const Json& value, const std::string& pointer) const {
    if (!schema.contains("items")) return std::nullopt;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (Found found = this->value(schema["items"], value[i], pointer + "/" + std::to_string(i)))
        return found;
    }
    return std::nullopt;
  }

  Found object(const Json& schema, const Json& value, const std::string& pointer) const {
    if (Found found = unknown_key(schema, value, pointer)) return found;
    if (Found found = key_name(schema, value, pointer)) return found;
    if (Found found = missing_key(schema, value, pointer)) return found;
    if (Found found = key_combination(schema, value, pointer)) return found;
    return members(schema, value, pointer);
  }

  Found unknown_key(const Json& schema, const Json& value, const std::string& pointer) const {
    const Json closed = false;
    if (!schema.contains("additionalProperties") || schema["additionalProperties"] != closed)
      return std::nullopt;
    const std::vector<std::string> known = keys_of(schema["properties"]);
    for (const auto& [key, member] : value.items()) {
      if (schema["properties"].contains(key)) continue;
      std::string hint = suggestion(key, known);
      if (hint.empty()) hint = ", expected " + quote_list(known, "or");
      return SchemaViolation{"unknown key " + quote_text(key) + hint, pointer};
    }
    return std::nullopt;
  }

  Found key_name(const Json& schema, const Json& value, const std::string& pointer) const {
    if (!schema.contains("propertyNames")) return std::nullopt;
    const Json& names = resolve(schema["propertyNames"]);
    for (const auto& [key, member] : value.items()) {
      if (!string_matches(names, key)) {
        return SchemaViolation{fmt::format("expected {}, found the key {}", wanted(names), quote_text(key)),
                               pointer};
      }
    }
    return std::nullopt;
  }

  static Found missing_key(const Json& schema, const Json& value, const std::string& pointer) {
    if (schema.contains("required")) {
      for (const std::string& key : texts(schema["required"])) {
        if (!value.contains(key)) return SchemaViolation{"missing key " + quote_text(key), pointer};
      }
    }
    if (!schema.contains("dependencies")) return std::nullopt;
    for (const auto& [key, needed] : schema["dependencies"].items()) {
      for (const std::string& other : texts(needed)) {
        if (!value.contains(key) || value.contains(other)) continue;
        return SchemaViolation{fmt::format("{} needs {}", quote_text(key), quote_text(other)), pointer};
      }
    }
    return std::nullopt;
  }

  /// `oneOf` and `not` are used for keys that exclude each other.
  static Found key_combination(const Json& schema, const Json& value, const std::string& pointer) {
    if (schema.contains("not")) {
      if (Found found = excluded_keys(schema["not"], value, pointer)) return found;
    }
    if (schema.contains("allOf")) {
      for (const Json& part : schema["allOf"]) {
        if (Found found = key_combination(part, value, pointer)) return found;
      }
    }
    return schema.contains("oneOf") ? choice_of_keys(schema["oneOf"], value, pointer) : std::nullopt;
  }

  static Found excluded_keys(const Json& excluded, const Json& value, const std::string& pointer) {
    const std::vector<std::string> keys = texts(excluded["required"]);
    const bool has_all =
        std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return value.contains(key); });
    if (!has_all) return std::nullopt;
    return SchemaViolation{fmt::format("{} exclude each other", quote_list(keys, "and")), pointer};
  }

  static Found choice_of_keys(const Json& branches, const Json& value, const std::string& pointer) {
    std::vector<std::string> choices;
    std::vector<std::string> present;
    for (const Json& branch : branches) {
      choices.push_back(branch["required"][0].get<std::string>());
      if (value.contains(choices.back())) present.push_back(choices.back());
    }
    if (present.size() == 1) return std::nullopt;
    if (present.empty()) return SchemaViolation{"missing key: one of " + quote_list(choices, "or"), pointer};
    return SchemaViolation{fmt::format("{} exclude each other", quote_list(present, "and")), pointer};
  }

  Found members(const Json& schema, const Json& value, const std::string& pointer) const {
    const Json none = Json::object();
    const Json& properties = schema.contains("properties") ? schema["properties"] : none;
    for (const auto& [key, member] : value.items()) {
      const std::string where = member_pointer(pointer, key);
      const Json& of_member = properties.contains(key) ? properties[key] : schema["additionalProperties"];
      if (Found found = this->value(of_member, member, where)) return found;
    }
    return std::nullopt;
  }

  const Json& root_;
};

}  // namespace

std::optional<SchemaViolation> find_violation(const nlohmann::json& schema, const nlohmann::json& document) {
  return Walk(schema).value(schema, document, "");
}

}  // namespace coordreq
