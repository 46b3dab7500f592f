#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

#include "example_spec.hpp"
#include "mutated_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// An error of ours says where: "WHAT (WHERE)" on one line.
void expect_placed(const Error& error) {
  const std::string what = error.what();
  RC_ASSERT(what.back() == ')');
  RC_ASSERT(what.find(" (/") != std::string::npos || what.find("(top level") != std::string::npos);
  RC_ASSERT(what.find('\n') == std::string::npos);
}

TEST(MutatedSpec, ReadsOrNamesThePlace) {
  EXPECT_TRUE(rc::check("a changed spec reads or its error names a place", [&] {
    const std::string text = test::mutated_spec().dump();
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
      const auto position = *rc::gen::inRange<std::size_t>(0, text.size());
      text[position] = static_cast<char>(*rc::gen::arbitrary<std::uint8_t>());
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
