// Lines of tables as CSV.

#include "base/csv.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

using Texts = std::vector<std::string>;

/// What is said of a line that is refused; empty if it is not.
std::string refusal(const std::function<void(const RefuseLine&)>& read) {
  try {
    read([](const std::string& what) { throw std::runtime_error(what); });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

const RefuseLine kFails = [](const std::string& what) { FAIL() << what; };

TEST(Csv, NamesHaveNoBlanksAroundThem) {
  EXPECT_EQ(csv_columns(" x , speed limit,\"a,b\"\r", kFails), (Texts{"x", "speed limit", "a,b"}));
  EXPECT_EQ(csv_columns("x", kFails), Texts{"x"});
}

TEST(Csv, QuotationMarksKeepCommasAndDoubledMarks) {
  EXPECT_EQ(csv_values("1,\"2,5\",\"say \"\"no\"\"\"", 3, kFails), (Texts{"1", "2,5", "say \"no\""}));
  EXPECT_EQ(csv_values(",", 2, kFails), (Texts{"", ""}));
}

TEST(Csv, WhatIsNoSuchTableIsRefused) {
  EXPECT_EQ(refusal([](const RefuseLine& refuse) { static_cast<void>(csv_columns("x;y", refuse)); }),
            "expected commas between columns and points in numbers, found semicolons");
  EXPECT_EQ(refusal([](const RefuseLine& refuse) { static_cast<void>(csv_columns("x\ty", refuse)); }),
            "expected commas between columns and points in numbers, found tabs");
  EXPECT_EQ(refusal([](const RefuseLine& refuse) { static_cast<void>(csv_columns("x,\"y", refuse)); }),
            "a quotation mark is not closed");
  EXPECT_EQ(refusal([](const RefuseLine& refuse) { static_cast<void>(csv_values("1", 2, refuse)); }),
            "expected 2 values, found 1");
  EXPECT_EQ(refusal([](const RefuseLine& refuse) { static_cast<void>(csv_values("1,5,2", 2, refuse)); }),
            "expected 2 values, found 3; numbers need a decimal point, not a comma");
}

}  // namespace
}  // namespace coordreq
