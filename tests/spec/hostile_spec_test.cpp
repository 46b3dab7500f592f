#include <gtest/gtest.h>

#include <string>

#include "base/json.hpp"
#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

// Short specs that ask for much. What counts is that an answer comes at all, and soon: the tests have a time
// limit and little memory.
namespace coordreq {
namespace {

/// What reading says, of specs of at most 64 KiB.
std::string outcome(const SortedJson& spec) {
  const std::string text = spec.dump();
  EXPECT_LE(text.size(), 65'536U);
  try {
    static_cast<void>(read_spec(text, "test.json"));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string outcome_of_constants(const std::string& first, const std::string& others, int count) {
  SortedJson spec = test::example();
  for (int i = 0; i < count; ++i) spec["constants"]["c" + std::to_string(i)] = i == 0 ? first : others;
  return outcome(spec);
}

TEST(HostileSpec, IrrationalFunctionsOfLongNumbersAreRefused) {
  for (const std::string call :
       {"sin(1e4999)", "tan(1e4999^6)", "log(1 + 1e-4999)", "acos(1 - 1e-4999)",
        "sqrt((1 + 2^-53)^2 + (1e-4999)^6)", "(1 + 1e-4999)^0.1", "2^(0.1 + 1e-4999)"}) {
    EXPECT_EQ(outcome_of_constants(call, call, 1200),
              "'" + call + "' is too large to be computed exactly (/constants/c0)");
  }
}

TEST(HostileSpec, IrrationalFunctionsOfNumbersThatAreNotTooLongAreQuick) {
  for (const std::string call : {"sin(1e1200)", "log(1 + 1e-1200)", "exp(1e-1200)", "(1 + 1e-1200)^0.1",
                                 "sqrt((1 + 2^-53)^2 + 1e-1200)"}) {
    EXPECT_EQ(outcome_of_constants(call, call, 1200), "") << call;
  }
}

TEST(HostileSpec, ConstantsThatSquareEachOtherEnd) {
  SortedJson spec = test::example();
  spec["constants"]["c0"] = "1 + 1e-9";
  for (int i = 1; i < 1500; ++i) {
    const std::string before = "c" + std::to_string(i - 1);
    spec["constants"]["c" + std::to_string(i)] = before + "*" + before;
  }
  EXPECT_EQ(outcome(spec), "number of more than 4096 bits (/constants/c7)");
}

TEST(HostileSpec, DefinitionsThatDoubleStaySmall) {
  SortedJson spec = test::example();
  spec["definitions"] = {{"d0", "x1"}, {"r2", "x1^2 + x2^2"}};
  for (int i = 1; i < 2000; ++i) {
    const std::string before = "d" + std::to_string(i - 1);
    spec["definitions"]["d" + std::to_string(i)] = before + "*" + before + "+x2";
  }
  spec["safe"] = "d1999 < 1";
  EXPECT_EQ(outcome(spec), "");
}

TEST(HostileSpec, ManyValuesOfManyDigitsAreRefused) {
  const SortedJson long_step = {{"name", "u1"}, {"lower", 0}, {"upper", 1048574}, {"step", "1 + 1e-500"}};
  EXPECT_EQ(outcome(test::example_with("/inputs/0", long_step.dump())),
            "3485459976 bits of 1048574 values of one input, at most 268435456 are possible (/inputs/0)");
}

TEST(HostileSpec, OperationsOfLongNumbersEnd) {
  std::string product = "x1 < 1e-4999";
  for (int i = 0; i < 3000; ++i) product += "*(1+1e-4999)^6";
  EXPECT_EQ(outcome(test::example_with("/safe", SortedJson(product).dump())), "");
  std::string sum = "x1 < 0";
  for (int i = 0; i < 4000; ++i) sum += "+1e-" + std::to_string(4999 - i);
  EXPECT_EQ(outcome(test::example_with("/safe", SortedJson(sum).dump())), "");
}

TEST(HostileSpec, ManyOfEverythingIsReadOrRefused) {
  SortedJson spec = test::example();
  for (int i = 0; i < 3000; ++i) spec["constants"]["c" + std::to_string(i)] = 1;
  spec["safe"] = "ccccc < 1";
  EXPECT_EQ(outcome(spec), "'ccccc' is not defined (/safe, column 1)");
  spec = test::example();
  spec["network"] = {{"weakly_hard", {{"misses", 1}, {"window", 2147483646}}}};
  EXPECT_EQ(outcome(spec), "more than 4096 modes, the most that are possible (/network/weakly_hard)");
  spec["network"] = {{"burst", {{"length", 1}, {"gap", 2147483646}}}};
  EXPECT_EQ(outcome(spec), "more than 4096 modes, the most that are possible (/network/burst)");
}

}  // namespace
}  // namespace coordreq
