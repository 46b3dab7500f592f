#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

#include "example_spec.hpp"
#include "maximal_spec.hpp"

namespace coordreq {
namespace {

using Json = nlohmann::json;

void collect(const Json& value, const Json::json_pointer& pointer, std::vector<Json::json_pointer>& all) {
  if (!pointer.empty()) all.push_back(pointer);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) collect(member, pointer / key, all);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], pointer / i, all);
  }
}

void remove(Json& document, const Json::json_pointer& pointer) {
  Json& parent = document.at(pointer.parent_pointer());
  if (parent.is_array()) {
    parent.erase(std::stoul(pointer.back()));
  } else {
    parent.erase(pointer.back());
  }
}

void rename(Json& document, const Json::json_pointer& pointer) {
  Json& parent = document.at(pointer.parent_pointer());
  if (!parent.is_object()) return;
  Json value = parent[pointer.back()];
  parent.erase(pointer.back());
  std::string name = pointer.back();
  name[*rc::gen::inRange<std::size_t>(0, name.size())] = *rc::gen::inRange('!', '~');
  parent[name] = std::move(value);
}

/// What a slip of the hand or a wrong idea of the format could put there.
Json other_value(const Json& document, const std::vector<Json::json_pointer>& nodes) {
  const std::vector<std::string> values{"null",
                                        "true",
                                        "false",
                                        "0",
                                        "-1",
                                        "1",
                                        "2.5",
                                        "1e-320",
                                        "123456789012345678901234567890",
                                        "1e300",
                                        "[]",
                                        "{}",
                                        "\"\"",
                                        "\"x1\"",
                                        "\"all\"",
                                        "\"1/0\"",
                                        "\"x1 <\"",
                                        "\"r2 < 1\"",
                                        "\"u1\"",
                                        "\"stop\"",
                                        "[[]]",
                                        "[\"\"]",
                                        "\"a|b+c\"",
                                        "[{}]",
                                        "{\"a\": 1}",
                                        "\"\\u00e9\\n\"",
                                        "\"2^(2^70)\""};
  if (*rc::gen::inRange(0, 4) == 0) return document.at(*rc::gen::elementOf(nodes));
  return Json::parse(*rc::gen::elementOf(values));
}

void mutate(Json& document) {
  std::vector<Json::json_pointer> nodes;
  collect(document, Json::json_pointer(), nodes);
  const Json::json_pointer pointer = *rc::gen::elementOf(nodes);
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return remove(document, pointer);
    case 1:
      return rename(document, pointer);
    default: {
      const Json value = other_value(document, nodes);
      document.at(pointer) = value;
    }
  }
}

/// An error of ours says where: "WHAT (WHERE)" on one line.
void expect_placed(const Error& error) {
  const std::string what = error.what();
  RC_ASSERT(what.back() == ')');
  RC_ASSERT(what.find(" (/") != std::string::npos || what.find("(top level") != std::string::npos);
  RC_ASSERT(what.find('\n') == std::string::npos);
  RC_ASSERT(what.find("does not follow the schema") == std::string::npos);
}

TEST(MutatedSpec, ReadsOrNamesThePlace) {
  const Json valid = Json::parse(test::kMaximalSpec, nullptr, true, true);
  EXPECT_TRUE(rc::check("a changed spec reads or its error names a place", [&] {
    Json document = valid;
    const int changes = *rc::gen::inRange(1, 3);
    for (int i = 0; i < changes; ++i) mutate(document);
    const std::string text = document.dump();
    RC_LOG() << text;
    try {
      static_cast<void>(read_spec(text, "test.json"));
    } catch (const SpecError& error) {
      expect_placed(error);
    } catch (const LimitError& error) {
      expect_placed(error);
    }
  }));
}

TEST(MutatedSpec, BrokenTextIsASpecError) {
  const std::string valid(test::kMaximalSpec);
  EXPECT_TRUE(rc::check("a text with changed bytes reads or gives one line", [&] {
    std::string text = valid;
    const auto changes = *rc::gen::inRange(1, 4);
    for (int i = 0; i < changes; ++i) {
      const auto place = *rc::gen::inRange<std::size_t>(0, text.size());
      text[place] = static_cast<char>(*rc::gen::arbitrary<std::uint8_t>());
    }
    if (*rc::gen::arbitrary<bool>()) text.resize(*rc::gen::inRange<std::size_t>(0, text.size()));
    try {
      static_cast<void>(read_spec(text, "test.json"));
    } catch (const SpecError& error) {
      const std::string what = error.what();
      RC_ASSERT(what.back() == ')');
      RC_ASSERT(what.find('\n') == std::string::npos);
    } catch (const LimitError&) {
    }
  }));
}

}  // namespace
}  // namespace coordreq
