#include "export/base64.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string_view>

namespace coordreq {
namespace {

std::string encoded(std::string_view text) {
  return base64(std::as_bytes(std::span<const char>(text.data(), text.size())));
}

TEST(Base64, HasTheVectorsOfRfc4648) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Base64, HasLettersForAllBits) {
  EXPECT_EQ(encoded(std::string_view("\x00\x10\x83\xfb\xff\xff", 6)), "ABCD+///");
}

}  // namespace
}  // namespace coordreq
