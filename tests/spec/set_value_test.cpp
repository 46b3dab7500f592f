#include "spec/set_value.hpp"
#include "base/json.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "spec/json_document.hpp"

namespace coordreq {
namespace {

std::string set(const std::string& text, const std::string& path, const std::string& value) {
  return with_setting(text, "test", {path, value});
}

std::string error_of(const std::string& text, const std::string& path, const std::string& value) {
  try {
    return "none: " + set(text, path, value);
  } catch (const UsageError& error) {
    return error.what();
  }
}

constexpr const char* kText = R"({ // the head
  "constants": { "R": 0.80 /* [m] */, "two": 2e0 },
  "states": [ { "name": "x1", "step": 0.1 }, /* } */ { "step": "R/4", "name": "x\u0032" } ], // ]
  "name": "a", "dots": { "a.b": [1, [2, {}]] }
} // end )";

TEST(SetValue, OnlyTheValueChanges) {
  SortedJson expected = SortedJson::parse(kText, nullptr, true, true);
  expected["constants"]["R"] = 0.7;
  EXPECT_EQ(SortedJson::parse(set(kText, "constants.R", "0.7")), expected);
  EXPECT_EQ(set(R"({"b": 1, "a": [2.50]})", "b", "3"), "{\n  \"b\": 3,\n  \"a\": [\n    2.5\n  ]\n}\n");
}

TEST(Refinement, DividesStepsAndKeepsAllPoints) {
  const SortedJson refined = SortedJson::parse(with_refinement(R"({"states": [
      {"step": 0.01, "origin": 0.3}, {"step": 1, "discrete": true}, {"step": "R/4"}, {"step": 2},
      {"count": 24, "outside": "periodic"}, {"count": 7, "outside": {"below": "periodic", "above": "periodic"}},
      {"count": 5, "outside": "safe"}, {"count": 5}], "inputs": [{"step": 1}]})",
                                                               "test", 2));
  EXPECT_EQ(refined["states"], SortedJson::parse(R"([
      {"step": 0.005, "origin": 0.3}, {"step": 1, "discrete": true}, {"step": "(R/4)/2"}, {"step": 1},
      {"count": 48, "outside": "periodic"}, {"count": 14, "outside": {"below": "periodic", "above": "periodic"}},
      {"count": 9, "outside": "safe"}, {"count": 9}])"));
  EXPECT_EQ(refined["inputs"][0]["step"], 1);
}

TEST(Refinement, IsExact) {
  const auto step = [](const std::string& old, std::int64_t factor) {
    return SortedJson::parse(
        with_refinement(R"({"states": [{"step": )" + old + "}]}", "test", factor))["states"][0]["step"];
  };
  EXPECT_EQ(step("0.1", 3), "1/30");
  EXPECT_EQ(step("0.30000000000000004", 1), 0.30000000000000004);
  EXPECT_EQ(step("0.10", 4), 0.025);
}

TEST(Refinement, LeavesWhatIsWrongToTheReader) {
  for (const char* const text :
       {R"({"states": 3})", R"([])",
        R"({"states": [1, {"step": true, "count": "x", "outside": {"below": 3}}]})",
        R"({"states": [{"count": -3}, {"count": 1.5}, {"count": 9223372036854775807}]})"})
    EXPECT_EQ(SortedJson::parse(with_refinement(text, "test", 2)), SortedJson::parse(text)) << text;
}

TEST(SetValue, ElementsGoByNumberOrName) {
  const SortedJson by_number = SortedJson::parse(set(kText, "states.1.step", "3"), nullptr, true, true);
  EXPECT_EQ(by_number["states"][1]["step"], 3);
  EXPECT_EQ(set(kText, "states.x2.step", "3"), set(kText, "states.1.step", "3"));
  EXPECT_EQ(set(kText, "/states/1/step", "3"), set(kText, "states.1.step", "3"));
}

TEST(SetValue, PointersReachKeysWithDots) {
  const SortedJson json = SortedJson::parse(set(kText, "/dots/a.b/1/0", "5"), nullptr, true, true);
  EXPECT_EQ(json["dots"]["a.b"], SortedJson::parse("[1, [5, {}]]"));
}

TEST(SetValue, JsonIsTakenAsJsonAndTheRestAsText) {
  const auto value = [](const std::string& typed) {
    return SortedJson::parse(set(kText, "name", typed), nullptr, true, true)["name"].dump();
  };
  EXPECT_EQ(value("0.5"), "0.5");
  EXPECT_EQ(value("true"), "true");
  EXPECT_EQ(value("[1, \"a\"]"), R"([1,"a"])");
  EXPECT_EQ(value("\"true\""), R"("true")");
  EXPECT_EQ(value("2*pi // turn"), R"("2*pi // turn")");
  EXPECT_EQ(value("say \"x\""), R"("say \"x\"")");
  EXPECT_EQ(value(""), R"("")");
}

TEST(SetValue, NumbersKeepTheirDigits) {
  const char* const kMany = "0.10000000000000000000001";
  const SortedJson set_there = SortedJson::parse(set(kText, "constants.R", kMany));
  EXPECT_EQ(set_there["constants"]["R"], kMany);
  const SortedJson was_there = SortedJson::parse(
      set(fmt::format(R"({{"a": {}, "b": 12345678901234567890123, "c": 0.1}})", kMany), "d", "1"));
  EXPECT_EQ(was_there, (SortedJson{{"a", kMany}, {"b", "12345678901234567890123"}, {"c", 0.1}, {"d", 1}}));
}

TEST(SetValue, WhatIsMissingIsNoList) {
  EXPECT_EQ(SortedJson::parse(set("{}", "a.4000000000", "1")),
            SortedJson::parse(R"({"a": {"4000000000": 1}})"));
  EXPECT_EQ(SortedJson::parse(set("{}", "//", "1")), SortedJson::parse(R"({"": {"": 1}})"));
}

TEST(SetValue, MissingKeysAreAdded) {
  const auto after = [](const char* text, const char* path, const char* value) {
    return SortedJson::parse(set(text, path, value)).dump();
  };
  EXPECT_EQ(after(R"({"a": {}})", "a.b", "1"), R"({"a":{"b":1}})");
  EXPECT_EQ(after("{\"a\": 1 // one\n}", "b", "2"), R"({"a":1,"b":2})");
  EXPECT_EQ(after(R"({"a": 1})", "b.c.d", "2"), R"({"a":1,"b":{"c":{"d":2}}})");
  EXPECT_EQ(after("\xEF\xBB\xBF{}", "a", "x"), R"({"a":"x"})");
}

TEST(SetValue, PathsThatLeadNowhereAreErrors) {
  EXPECT_EQ(error_of(kText, "states.2.step", "1"),
            "no '2' in states, expected 'x1' or 'x2', or a number from 0 to 1 (states.2.step)");
  EXPECT_EQ(error_of(kText, "/dots/a.b/x", "1"),
            "no 'x' in dots.a.b, expected a number from 0 to 1 (/dots/a.b/x)");
  EXPECT_EQ(error_of(kText, "constants.R.x", "1"), "no 'x' in constants.R: it is '0.8' (constants.R.x)");
  EXPECT_EQ(error_of(R"({"a": []})", "a.0", "1"), "no '0' in a: it is empty (a.0)");
  EXPECT_EQ(error_of("[1]", "a", "1"), "no 'a' in the spec, expected a number from 0 to 0 (a)");
}

TEST(SetValue, ConstantsAreNotAdded) {
  EXPECT_EQ(error_of(kText, "constants.tow", "1"),
            "'tow' is not one of the constants, did you mean 'two'? (constants.tow)");
  EXPECT_EQ(error_of(kText, "constants.Radius", "1"),
            "'Radius' is not one of the constants, expected 'R' or 'two' (constants.Radius)");
  EXPECT_EQ(error_of(R"({"definitions": {}})", "definitions.r", "1"),
            "'r' is not one of the definitions: there are none (definitions.r)");
  EXPECT_EQ(error_of("{}", "constants.q", "1"),
            "'q' is not one of the constants: there are none (constants.q)");
  EXPECT_EQ(SortedJson::parse(set("{}", "constants", R"({"q": 1})")).dump(), R"({"constants":{"q":1}})");
}

TEST(SetValue, BrokenPathsAndValuesAreErrors) {
  EXPECT_EQ(error_of(kText, "a..b", "1"),
            "expected keys with dots between, e.g. states.0.step, found 'a..b'");
  EXPECT_EQ(error_of(kText, "", "1"), "expected keys with dots between, e.g. states.0.step, found ''");
  EXPECT_EQ(error_of(kText, "name", "[1,"), "expected JSON, since it starts like it, found '[1,' (name)");
  EXPECT_EQ(error_of(kText, "name", "\xff"), "expected UTF-8 text as the value (name)");
  EXPECT_EQ(error_of(kText, "constants.\xff", "1"),
            "expected UTF-8 text as the path, found 'constants.\xff'");
  EXPECT_EQ(error_of(kText, "/\xff", "1"), "expected UTF-8 text as the path, found '/\xff'");
  EXPECT_THROW(static_cast<void>(set(kText, "name", std::string(300, '[') + std::string(300, ']'))),
               SpecError);
}

TEST(SetValue, BrokenSpecsAreTheirOwnErrors) {
  EXPECT_THROW(static_cast<void>(set("{", "a", "1")), SpecError);
}

/// A random value, at most `depth` levels deep.
SortedJson any_json(int depth) {
  const int kind = *rc::gen::inRange(0, depth == 0 ? 4 : 6);
  if (kind == 0) return *rc::gen::arbitrary<int>();
  if (kind == 1)
    return *rc::gen::elementOf(std::vector<std::string>{"", "a\"b", "\\", "// no", "/* } */", "]"});
  if (kind == 2) return *rc::gen::arbitrary<bool>();
  if (kind == 3) return nullptr;
  SortedJson json = kind == 4 ? SortedJson::array() : SortedJson::object();
  for (int i = *rc::gen::inRange(0, 4); i > 0; --i) {
    if (kind == 4) {
      json.push_back(any_json(depth - 1));
    } else {
      json["k" + std::to_string(i) + *rc::gen::elementOf(std::vector<std::string>{"", "/", "~", "\"", "."})] =
          any_json(depth - 1);
    }
  }
  return json;
}

/// The JSON text with a comment at each place where there may be one and no string is around.
std::string with_comments(const SortedJson& json) {
  std::string result;
  bool quoted = false;
  const std::string text = json.dump();
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!quoted && std::string("{}[],:\"").find(c) != std::string::npos) {
      result += *rc::gen::elementOf(std::vector<std::string>{"", " ", "/* ]\" */", "// }\n"});
    }
    result += c;
    if (quoted && c == '\\') result += text[++i];
    if (c == '"') quoted = !quoted;
  }
  return result;
}

RC_GTEST_PROP(SetValue, IsWhatThePointerOfTheDocumentSets, ()) {
  const SortedJson json = SortedJson{{"a", any_json(3)}, {"b", any_json(2)}};
  const SortedJson flat = json.flatten();
  std::vector<std::string> pointers = {"/a", "/b"};
  for (const auto& [pointer, value] : flat.items()) pointers.push_back(pointer);
  const std::string pointer = *rc::gen::elementOf(pointers);
  const SortedJson value = any_json(1);

  SortedJson expected = json;
  expected[SortedJson::json_pointer(pointer)] = value;
  const std::string text = set(with_comments(json), pointer, value.dump());
  RC_ASSERT(JsonDocument::parse(text, "test").value() == expected);
}

}  // namespace
}  // namespace coordreq
