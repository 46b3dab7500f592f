#include "spec/schema_violation.hpp"

#include <fmt/format.h>
#include <regex.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "spec/read_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

bool has_type(const SortedJson& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return value.is_null();
}

bool type_matches(const SortedJson& schema, const SortedJson& value) {
  const auto type = schema.find("type");
  if (type == schema.end()) return true;
  if (type->is_string()) return has_type(value, *type);
  return std::any_of(type->begin(), type->end(), [&](const SortedJson& one) { return has_type(value, one); });
}

std::size_t code_points(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// @param pattern of those that POSIX's extended expressions and the schema's mean alike
bool has_pattern(const std::string& pattern, const std::string& text) {
  regex_t compiled;
  if (regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0)
    throw std::logic_error("no regular expression: " + pattern);
  regmatch_t whole{.rm_so = 0, .rm_eo = static_cast<regoff_t>(text.size())};
  const bool is_match = regexec(&compiled, text.c_str(), 1, &whole, REG_STARTEND) == 0;
  regfree(&compiled);
  return is_match;
}

bool string_matches(const SortedJson& schema, const std::string& text) {
  const std::size_t length = code_points(text);
  if (schema.contains("minLength") && length < schema["minLength"].get<std::size_t>()) return false;
  if (schema.contains("maxLength") && length > schema["maxLength"].get<std::size_t>()) return false;
  return !schema.contains("pattern") || has_pattern(schema["pattern"].get<std::string>(), text);
}

bool number_matches(const SortedJson& schema, const SortedJson& value) {
  return !(schema.contains("minimum") && value < schema["minimum"]) &&
         !(schema.contains("maximum") && value > schema["maximum"]);
}

bool size_matches(const SortedJson& schema, std::size_t size) {
  return !(schema.contains("minItems") && size < schema["minItems"].get<std::size_t>()) &&
         !(schema.contains("maxItems") && size > schema["maxItems"].get<std::size_t>());
}

bool is_listed(const SortedJson& schema, const SortedJson& value) {
  if (schema.contains("const") && schema["const"] != value) return false;
  const auto list = schema.find("enum");
  return list == schema.end() || std::find(list->begin(), list->end(), value) != list->end();
}

/// Everything about the value itself, not about what it contains.
bool value_matches(const SortedJson& schema, const SortedJson& value) {
  return type_matches(schema, value) && is_listed(schema, value) &&
         (!value.is_string() || string_matches(schema, value.get_ref<const std::string&>())) &&
         (!value.is_number() || number_matches(schema, value)) &&
         (!value.is_array() || size_matches(schema, value.size()));
}

/// 'text' for a string, else JSON.
std::string scalar_text(const SortedJson& value) {
  return value.is_string() ? quote_text(value.get_ref<const std::string&>()) : value.dump();
}

std::string value_text(const SortedJson& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return value.empty() ? "an empty list" : fmt::format("a list of {}", value.size());
  return scalar_text(value);
}

std::string type_text(const std::string& type) {
  if (type == "boolean") return "true or false";
  if (type == "null") return type;
  if (type == "array") return "a list";
  return (type == "object" || type == "integer" ? "an " : "a ") + type;
}

std::vector<std::string> texts(const SortedJson& list) {
  std::vector<std::string> result;
  for (const SortedJson& item : list) result.push_back(item.get<std::string>());
  return result;
}

/// The kind of value that a schema allows, for "expected ...".
std::string wanted(const SortedJson& schema) {
  if (schema.contains("title")) return schema["title"].get<std::string>();
  if (schema.contains("enum")) return quote_list(texts(schema["enum"]), "or");
  if (schema.contains("const")) return scalar_text(schema["const"]);
  return type_text(schema["type"].get<std::string>());
}

std::vector<std::string> keys_of(const SortedJson& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

/// Notes violations while it walks, until there are as many as are wanted.
class Walk {
 public:
  Walk(const SortedJson& root, std::size_t most) : root_(root), most_(most) {}

  void value(const SortedJson& schema_or_reference, const SortedJson& value, const std::string& pointer) {
    if (is_full()) return;
    const SortedJson& schema = resolve(schema_or_reference);
    if (schema.contains("anyOf")) return alternatives(schema, value, pointer);
    if (!value_matches(schema, value)) return mismatch(schema, value, pointer);
    if (value.is_object()) return object(schema, value, pointer);
    if (value.is_array()) return array(schema, value, pointer);
  }

  std::vector<SchemaViolation> violations;

 private:
  [[nodiscard]] bool is_full() const { return violations.size() >= most_; }
  void add(std::string what, const std::string& pointer) {
    if (!is_full()) violations.push_back({std::move(what), pointer});
  }

  const SortedJson& resolve(const SortedJson& schema) const {
    if (!schema.contains("$ref")) return schema;
    // All references are "#/...".
    return root_.at(SortedJson::json_pointer(schema["$ref"].get<std::string>().substr(1)));
  }

  void mismatch(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    add(fmt::format("expected {}, found {}", wanted(schema), value_text(value)), pointer);
  }

  /// The alternative of the value's own type is the one the author intended.
  void alternatives(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    for (const SortedJson& branch : schema["anyOf"]) {
      const SortedJson& alternative = resolve(branch);
      const bool is_match =
          alternative.contains("type") ? type_matches(alternative, value) : value_matches(alternative, value);
      if (is_match) return this->value(alternative, value, pointer);
    }
    mismatch(schema, value, pointer);
  }

  void array(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    if (!schema.contains("items")) return;
    const SortedJson& items = schema["items"];  // one for all, or one for each
    for (std::size_t i = 0; i < value.size(); ++i)
      this->value(items.is_array() ? items[i] : items, value[i], pointer + "/" + std::to_string(i));
  }

  /// Where a key is not known, the intended one is missing: that is not reported as well.
  void object(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    const std::size_t before = violations.size();
    unknown_keys(schema, value, pointer);
    key_names(schema, value, pointer);
    if (violations.size() == before) missing_keys(schema, value, pointer);
    if (violations.size() == before) key_combination(schema, value, pointer);
    members(schema, value, pointer);
  }

  void unknown_keys(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    const SortedJson closed = false;
    if (!schema.contains("additionalProperties") || schema["additionalProperties"] != closed) return;
    const std::vector<std::string> known = keys_of(schema["properties"]);
    for (const auto& [key, member] : value.items()) {
      if (schema["properties"].contains(key) || is_full()) continue;
      std::string hint = suggestion(key, known);
      if (hint.empty()) hint = ", expected " + quote_list(known, "or");
      add("unknown key " + quote_text(key) + hint, pointer);
    }
  }

  void key_names(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    if (!schema.contains("propertyNames")) return;
    const SortedJson& names = resolve(schema["propertyNames"]);
    for (const auto& [key, member] : value.items()) {
      if (string_matches(names, key)) continue;
      add(fmt::format("expected {}, found the key {}", wanted(names), quote_text(key)), pointer);
    }
  }

  /// The values of a key, if they are a few words.
  [[nodiscard]] std::string choices(const SortedJson& schema, const std::string& key) const {
    if (!schema.contains("properties") || !schema["properties"].contains(key)) return "";
    const SortedJson& entry = resolve(schema["properties"][key]);
    return entry.contains("enum") ? ", expected " + wanted(entry) : "";
  }

  void missing_keys(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    if (schema.contains("required")) {
      for (const std::string& key : texts(schema["required"])) {
        if (!value.contains(key)) add("missing key " + quote_text(key) + choices(schema, key), pointer);
      }
    }
    if (!schema.contains("dependencies")) return;
    for (const auto& [key, needed] : schema["dependencies"].items()) {
      for (const std::string& other : texts(needed)) {
        if (!value.contains(key) || value.contains(other)) continue;
        add(fmt::format("{} needs {}", quote_text(key), quote_text(other)), pointer);
      }
    }
  }

  /// `oneOf` and `not` are used for keys that exclude each other.
  void key_combination(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    if (schema.contains("not")) excluded_keys(schema["not"], value, pointer);
    if (schema.contains("allOf")) {
      for (const SortedJson& subschema : schema["allOf"]) key_combination(subschema, value, pointer);
    }
    if (schema.contains("oneOf")) choice_of_keys(schema["oneOf"], value, pointer);
  }

  void excluded_keys(const SortedJson& excluded, const SortedJson& value, const std::string& pointer) {
    const std::vector<std::string> keys = texts(excluded["required"]);
    const bool has_all =
        std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return value.contains(key); });
    if (has_all) add(fmt::format("{} exclude each other", quote_list(keys, "and")), pointer);
  }

  void choice_of_keys(const SortedJson& branches, const SortedJson& value, const std::string& pointer) {
    std::vector<std::string> choices;
    std::vector<std::string> present;
    for (const SortedJson& branch : branches) {
      choices.push_back(branch["required"][0].get<std::string>());
      if (value.contains(choices.back())) present.push_back(choices.back());
    }
    if (present.empty()) add("missing key: one of " + quote_list(choices, "or"), pointer);
    if (present.size() > 1) add(fmt::format("{} exclude each other", quote_list(present, "and")), pointer);
  }

  void members(const SortedJson& schema, const SortedJson& value, const std::string& pointer) {
    const SortedJson none = SortedJson::object();
    const SortedJson& properties = schema.contains("properties") ? schema["properties"] : none;
    const auto others = schema.find("additionalProperties");
    for (const auto& [key, member] : value.items()) {
      const bool is_known = properties.contains(key);
      if (!is_known && (others == schema.end() || !others->is_object())) continue;  // noted already
      this->value(is_known ? properties[key] : *others, member, member_pointer(pointer, key));
    }
  }

  const SortedJson& root_;
  std::size_t most_;
};

}  // namespace

std::vector<SchemaViolation> find_violations(const SortedJson& schema, const SortedJson& document,
                                             std::size_t most) {
  Walk walk(schema, most);
  walk.value(schema, document, "");
  return walk.violations;
}

std::vector<SchemaViolation> find_spec_violations(const SortedJson& document, std::size_t most) {
  return find_violations(SortedJson::parse(spec_schema()), document, most);
}

}  // namespace coordreq
