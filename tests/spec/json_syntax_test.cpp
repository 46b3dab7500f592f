#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using test::error_of_text;
using test::example;

struct SyntaxCase {
  std::string text;
  std::string what;
};

TEST(JsonSyntax, ErrorsNameLineColumnFoundAndExpected) {
  const std::vector<SyntaxCase> cases{
      {"", "the file is empty, expected a spec (test.json)"},
      {"\x89HDF\r\n\x1A\n", "is HDF5 as results are, expected a spec (test.json)"},
      {" \n\t ", "the file is empty, expected a spec (test.json)"},
      {"// nothing\n", "expected a value, found the end of the file (test.json, line 2, column 1)"},
      {"{\n  \"name\": \"a\"\n  \"states\": []\n}",
       "expected ',' or '}', found '\"states\"' (test.json, line 3, column 3)"},
      {"{ \"a\": 1, }", "expected no comma before '}', found a trailing one (test.json, line 1, column 9)"},
      {"{ a: 1 }", "expected a key in double quotes, found 'a' (test.json, line 1, column 3)"},
      {"{ 'a': 1 }", "expected a key in double quotes, found ''' (test.json, line 1, column 3)"},
      {"{ 12: 1 }", "expected a key in double quotes, found '12' (test.json, line 1, column 3)"},
      {"{ \"a\" 1 }", "expected ':', found '1' (test.json, line 1, column 7)"},
      {"{ \"a\": }", "expected a value, found '}' (test.json, line 1, column 8)"},
      {"[1, 2", "expected ',' or ']', found the end of the file (test.json, line 1, column 6)"},
      {"[1 true]", "expected ',' or ']', found 'true' (test.json, line 1, column 4)"},
      {"[1,]", "expected no comma before ']', found a trailing one (test.json, line 1, column 3)"},
      {"[1, // two\n /* three */ ]",
       "expected no comma before ']', found a trailing one (test.json, line 1, column 3)"},
      {"[\",\" : ]", "expected ',' or ']', found ':' (test.json, line 1, column 6)"},
      {"{} {}", "expected the end of the file, found '{' (test.json, line 1, column 4)"},
      {"{\"a\": 1", "expected ',' or '}', found the end of the file (test.json, line 1, column 8)"},
      {"{\"a\": NaN}", "expected a value, found 'NaN' (test.json, line 1, column 7)"},
      {"{\"a\": nan}", "expected a value, found 'nan' (test.json, line 1, column 7)"},
      {"{\"a\": Infinity}", "expected a value, found 'Infinity' (test.json, line 1, column 7)"},
      {"{\"a\": -Infinity}",
       "expected a number such as 10, 0.5 or 1e-3, found '-Infinity' (test.json, line 1, column 7)"},
      {"{\"a\": 1.}", "expected a number such as 10, 0.5 or 1e-3, found '1.' (test.json, line 1, column 7)"},
      {"{\"a\": 01}", "expected a number such as 10, 0.5 or 1e-3, found '01' (test.json, line 1, column 7)"},
      {"[1.5 2.5]", "expected ',' or ']', found '2.5' (test.json, line 1, column 6)"},
      {"{\"a\": .5}", "expected a value, found '.5' (test.json, line 1, column 7)"},
      {"{\"a\": 1e400}", "number beyond the range of a double: '1e400' (test.json, line 1, column 7)"},
      {"{\"a\": \"b}",
       "expected '\"' at the end of a string, found the end of the file (test.json, line 1, column 10)"},
      {"{\"a\": \"b\n\"}",
       "expected '\"' at the end of a string, found the end of the line (test.json, line 1, column 9)"},
      {"{\"a\": \"b\t\"}",
       "expected \\u0009 in a string, found the character U+0009 itself (test.json, line 1, column 9)"},
      {"{\"a\": \"b\\q\"}",
       "expected an escape such as \\n, \\\\ or \\u00E9, found '\\q' (test.json, line 1, column 9)"},
      {"{\"a\": \"\\u00g9\"}",
       "expected an escape such as \\n, \\\\ or \\u00E9, found '\\u00g' (test.json, line 1, column 8)"},
      {"{\"a\": \"\\ud800x\"}",
       "expected an escape such as \\n, \\\\ or \\u00E9, found '\\ud800x' (test.json, line 1, column 8)"},
      {"{\"a\": \"b\\",
       "expected '\"' at the end of a string, found the end of the file (test.json, line 1, column 10)"},
      {"{\"a\": 1 /* open",
       "expected '*/' at the end of this comment, found the end of the file (test.json, line 1, column 9)"},
      {"{\"a\": 1 /* one *//* two",
       "expected '*/' at the end of this comment, found the end of the file (test.json, line 1, column 18)"},
      {"{\"a\": \"/*\" // /*",
       "expected ',' or '}', found the end of the file (test.json, line 1, column 17)"},
      {"[1, /x]", "expected a value, found '/' (test.json, line 1, column 5)"},
      {"[1, 2] 3", "expected the end of the file, found '3' (test.json, line 1, column 8)"},
      {"{\"a\": {\"b\" , 1}}", "expected ':', found ',' (test.json, line 1, column 12)"},
      {"{\"a\": 1, , \"b\": 2}", "expected a key in double quotes, found ',' (test.json, line 1, column 10)"},
      {"{\"\xC3\xA9\xC3\xA9\": ?}", "expected a value, found '?' (test.json, line 1, column 8)"},
      {"{\n\"a\": \"\xE9\"}", "expected UTF-8 text, found the byte 0xE9 (test.json, line 2, column 7)"},
      {"// \xC0\x80\n{}", "expected UTF-8 text, found the byte 0xC0 (test.json, line 1, column 4)"},
      {std::string("\xFF\xFE{\0}\0", 6),
       "expected UTF-8 text, found the byte 0xFF (test.json, line 1, column 1)"},
      {std::string("{}\0", 3), "expected text, found a NUL byte (test.json, line 1, column 3)"},
  };
  for (const SyntaxCase& one : cases) EXPECT_EQ(error_of_text(one.text), one.what) << one.text;
}

TEST(JsonSyntax, ByteOrderMarkIsSkipped) {
  const std::string text = "\xEF\xBB\xBF" + example().dump();
  EXPECT_EQ(read_spec(text, "test.json").text, text);
  EXPECT_EQ(error_of_text("\xEF\xBB\xBF?"), "expected a value, found '?' (test.json, line 1, column 1)");
}

TEST(JsonSyntax, CommentsAreAllowed) {
  const std::string text = "// one\n/* two */" + example().dump() + "/* three\n */ // four";
  EXPECT_EQ(error_of_text(text), "");
}

TEST(JsonSyntax, RepeatedKeysAreErrors) {
  EXPECT_EQ(error_of_text(R"({"name": "a", "name": "b"})"), "repeated key 'name' (top level)");
  EXPECT_EQ(error_of_text(R"({"states": [{}, {"a/b": {"x": 1, "\u0078": 2}}]})"),
            "repeated key 'x' (/states/1/a~1b)");
}

TEST(JsonSyntax, NestingIsLimited) {
  const std::string deep(100'000, '[');
  EXPECT_EQ(error_of_text("{\"a\": " + deep),
            "nested deeper than 200 levels (test.json, line 1, column 206)");
  EXPECT_EQ(error_of_text("// [[\n/* [ \" */ {\"[\": [{}, \"\\\"[\"],\n\"b\": " + deep),
            "nested deeper than 200 levels (test.json, line 3, column 205)");
  EXPECT_EQ(error_of_text(std::string(199, '[') + std::string(199, ']')),
            "expected an object that describes a problem, found a list of 1 (top level)");
}

TEST(JsonSyntax, OddStringsAndKeysStayOneLine) {
  EXPECT_EQ(error_of_text("{\"a\\nb\": 1, \"a\\nb\": 1}"), "repeated key 'a\\u000Ab' (top level)");
  EXPECT_EQ(error_of_text(R"({"name": "a\u0000"})"), "a string may not contain the character U+0000 (/name)");
  EXPECT_EQ(error_of_text("{\"" + std::string(201, 'k') + "\": 1}"),
            "key longer than 200 bytes: '" + std::string(57, 'k') + "...' (top level)");
}

TEST(JsonSyntax, LongTextsAreCutBetweenCharacters) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += "\xC3\xA9";
  std::string start = text.substr(0, 56);
  EXPECT_EQ(error_of_text("{ \"a\" " + text),
            "expected ':', found '" + start + "...' (test.json, line 1, column 7)");
}

}  // namespace
}  // namespace coordreq
