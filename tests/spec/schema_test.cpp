#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/json.hpp"
#include "example_spec.hpp"

namespace coordreq {
namespace {

/// The keywords that error messages know about; another one would fail without a word.
const std::set<std::string> kKeywords{"$ref",          "$schema",      "additionalProperties",
                                      "allOf",         "anyOf",        "const",
                                      "definitions",   "dependencies", "description",
                                      "enum",          "items",        "maxItems",
                                      "maxLength",     "maximum",      "minItems",
                                      "minLength",     "minimum",      "not",
                                      "oneOf",         "pattern",      "properties",
                                      "propertyNames", "required",     "title",
                                      "type"};

void check_schema_object(const SortedJson& schema, const std::string& pointer);

void check_members(const SortedJson& object, const std::string& pointer, bool need_description) {
  for (const auto& [key, member] : object.items()) {
    EXPECT_TRUE(!need_description || member.contains("description")) << pointer << "/" << key;
    check_schema_object(member, pointer + "/" + key);
  }
}

void check_schema_object(const SortedJson& schema, const std::string& pointer) {
  if (!schema.is_object()) return;
  for (const auto& [keyword, value] : schema.items()) {
    const std::string where = pointer + "/" + keyword;
    EXPECT_EQ(kKeywords.count(keyword), 1U) << where;
    if (keyword == "properties" || keyword == "definitions") {
      check_members(value, where, keyword == "properties");
    } else if (keyword == "items" || keyword == "additionalProperties" || keyword == "propertyNames") {
      check_schema_object(value, where);
    } else if (keyword == "anyOf") {
      for (const SortedJson& branch : value) check_schema_object(branch, where);
    }
  }
  if (schema.value("type", SortedJson()) == "object") {
    EXPECT_TRUE(schema.contains("additionalProperties")) << pointer;
  }
}

TEST(Schema, IsDraft7AndSelfDescribing) {
  const SortedJson schema = SortedJson::parse(spec_schema());
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_EQ(spec_schema().back(), '\n');
  check_schema_object(schema, "");
}

TEST(Schema, EveryReferenceResolves) {
  const SortedJson schema = SortedJson::parse(spec_schema());
  const SortedJson flat = schema.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (pointer.size() < 5 || pointer.substr(pointer.size() - 5) != "/$ref") continue;
    EXPECT_TRUE(schema.contains(SortedJson::json_pointer(value.get<std::string>().substr(1)))) << value;
  }
}

}  // namespace
}  // namespace coordreq
