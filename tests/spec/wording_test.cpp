#include "spec/wording.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace coordreq {
namespace {

TEST(QuoteText, CutsBetweenCharacters) {
  EXPECT_EQ(quote_text(std::string(60, 'x')), fmt::format("'{:x>60}'", ""));
  EXPECT_EQ(quote_text(std::string(61, 'x')), fmt::format("'{:x>57}...'", ""));
  EXPECT_EQ(quote_text(fmt::format("{:x>56}\u00e4{:x>9}", "", "")), fmt::format("'{:x>56}...'", ""));
}

TEST(QuoteText, CutsWhatIsNoTextSomewhere) {
  const std::string continued(100, '\xb7');
  EXPECT_EQ(quote_text(continued), fmt::format("'{}...'", continued.substr(0, 54)));
}

}  // namespace
}  // namespace coordreq
