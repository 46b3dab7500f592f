#include "spec/spec_location.hpp"

#include <gtest/gtest.h>

#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

const std::string kPlacedText = R"({ // "a": 0
  "b": [1, {"c": "x, ]}", "a/b": [], "d~": 2}, /* ] */ [3, 4]],
  "a": {"\u0062": {"b": 7}}, "e": -1.5e3
})";

std::string rest_from(std::string_view pointer) {
  const auto offset = offset_of_value(kPlacedText, pointer);
  return offset ? kPlacedText.substr(*offset, 3) : "nothing";
}

TEST(OffsetOfValue, FindsMembersAndElements) {
  EXPECT_EQ(rest_from(""), "{ /");
  EXPECT_EQ(rest_from("/b"), "[1,");
  EXPECT_EQ(rest_from("/b/0"), "1, ");
  EXPECT_EQ(rest_from("/b/1"), "{\"c");
  EXPECT_EQ(rest_from("/b/2/1"), "4]]");
  EXPECT_EQ(rest_from("/e"), "-1.");
}

TEST(OffsetOfValue, TakesNoValueForAKey) {
  EXPECT_EQ(rest_from("/a"), "{\"\\");  // not the one in the comment
  EXPECT_EQ(rest_from("/a/b/b"), "7}}");
  EXPECT_EQ(rest_from("/b/1/c"), "\"x,");
}

TEST(OffsetOfValue, ReadsEscapesOfPointersAndKeys) {
  EXPECT_EQ(rest_from("/b/1/a~1b"), "[],");
  EXPECT_EQ(rest_from("/b/1/d~0"), "2},");
  EXPECT_EQ(rest_from("/a/b"), "{\"b");
}

TEST(OffsetOfValue, OfWhatIsNotThereIsNothing) {
  for (const char* pointer : {"/c", "/b/3", "/b/x", "/b/0/0", "/b/1/a~1b/0", "/e/0", "/b/1/d~2", "b"})
    EXPECT_EQ(rest_from(pointer), "nothing") << pointer;
}

TEST(WithPlace, NamesLineAndColumn) {
  const WrittenSpec written{kPlacedText, {}};
  EXPECT_EQ(with_location("bad (/b/2/1)", written), "bad (/b/2/1; line 2, column 60)");
  EXPECT_EQ(with_location("bad (/e, column 3)", written), "bad (/e, column 3; line 3, column 35)");
  EXPECT_EQ(with_location("bad (very) (/e)", written), "bad (very) (/e; line 3, column 35)");
}

TEST(WithPlace, LeavesOtherErrorsAsTheyAre) {
  const WrittenSpec written{kPlacedText, {}};
  for (const char* error :
       {"bad", "bad (top level)", "bad (/c)", "bad (file.json, line 1, column 2)", "bad ()"})
    EXPECT_EQ(with_location(error, written), error);
  EXPECT_EQ(with_location("bad (/e)", {}), "bad (/e)");
  EXPECT_EQ(with_location("bad (/e)", {"{ \"e\": ", {}}), "bad (/e)");
}

TEST(WithPlace, NamesTheLastSettingThatMadeTheValue) {
  const WrittenSpec written{kPlacedText, {{"e", "1"}, {"b.2", "[3, 5]"}, {"e", "2"}, {"refine", "2"}}};
  EXPECT_EQ(with_location("bad (/e)", written), "bad (/e; set by e=2)");
  EXPECT_EQ(with_location("bad (/b/2/1)", written), "bad (/b/2/1; set by b.2=[3, 5])");
  EXPECT_EQ(with_location("bad (/b)", written), "bad (/b; line 2, column 8)");
  EXPECT_EQ(with_location("bad (/b/1/c)", written), "bad (/b/1/c; line 2, column 18)");
}

TEST(WithPlaces, KeepsTheNumberOfErrors) {
  const WrittenSpec written{kPlacedText, {}};
  const auto several = [&] { with_locations(written, [] { throw SpecErrors({"one (/a)", "two (/e)"}); }); };
  try {
    several();
    FAIL();
  } catch (const SpecErrors& errors) {
    EXPECT_EQ(errors.lines(),
              (std::vector<std::string>{"one (/a; line 3, column 8)", "two (/e; line 3, column 35)"}));
  }
  EXPECT_THROW(with_locations(written, [] { throw SpecError("one", "/a"); }), SpecError);
  EXPECT_EQ(with_locations(written, [] { return 3; }), 3);
}

}  // namespace
}  // namespace coordreq
