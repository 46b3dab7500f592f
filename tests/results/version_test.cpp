#include "results/version.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "results/sha256.hpp"

namespace coordreq {
namespace {

TEST(ProgramVersion, HasThreeNumbers) {
  EXPECT_EQ(std::count(program_version().begin(), program_version().end(), '.'), 2);
}

TEST(ProgramGitSha1, IsACommitOrUnknown) {
  const std::string_view sha1 = program_git_sha1();
  const bool hexadecimal =
      std::all_of(sha1.begin(), sha1.end(), [](unsigned char c) { return std::isxdigit(c); });
  EXPECT_TRUE(sha1 == "unknown" || (hexadecimal && sha1.size() == 40)) << sha1;
}

// The examples of FIPS 180-4.
TEST(Sha256, KnownDigests) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace coordreq
