#include "cell/state_reader.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "base/error.hpp"

namespace coordreq {
namespace {

using States = std::vector<std::vector<Rational>>;

States read(const std::string& text) {
  std::istringstream stream(text);
  StateReader reader(stream, {"x", "y"}, "input");
  States states;
  while (std::optional<std::vector<Rational>> state = reader.next()) states.push_back(*state);
  return states;
}

std::string defect(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

const States kExpected = {{1, Rational(1) / 10}, {-2, Rational(1) / 3}};

TEST(StateReader, Csv) {
  EXPECT_EQ(read("x,y\n1,0.1\n-2,1/3\n"), kExpected);
  EXPECT_EQ(read("y, x\r\n0.1,1\r\n\r\n 1/3 , -2"), kExpected);
  EXPECT_EQ(read("\xEF\xBB\xBF\"x\",y\n\"max(0,1)\",0.1\n-2,1/3\n"), kExpected);
  EXPECT_TRUE(read("x,y\n").empty());
  EXPECT_TRUE(read("").empty());
}

TEST(StateReader, JsonLines) {
  EXPECT_EQ(read("{\"y\": 0.1, \"x\": 1}\n\n{\"x\": \"-2\", \"y\": \"1/3\"}\n"), kExpected);
  EXPECT_EQ(read("{\"x\":10000000000000000001,\"y\":1e-1}"),
            (States{{Rational("10000000000000000001"), Rational(1) / 10}}));
}

std::string extra(const StateReader& reader) {
  std::string text;
  for (const StateReader::Extra& own : reader.extra()) text += own.name + "=" + own.value + ";";
  return text;
}

TEST(StateReader, KeepsWhatNamesNoState) {
  std::istringstream csv("time,y,note,x,\n 0.50 ,0.1,\"a, \"\"b\"\"\",1,\n1,1/3,,-2,z\n");
  StateReader reader(csv, {"x", "y"}, "input");
  EXPECT_EQ(reader.extra_names(), (std::vector<std::string>{"time", "note", ""}));
  EXPECT_EQ(reader.next(), kExpected[0]);
  EXPECT_EQ(extra(reader), "time= 0.50 ;note=a, \"b\";=;");
  EXPECT_EQ(reader.next(), kExpected[1]);
  EXPECT_EQ(extra(reader), "time=1;note=;=z;");
  std::istringstream lines("{\"y\":0.1,\"x\":1,\"t\":[1,\"a\"]}\n{\"x\":-2,\"y\":\"1/3\"}\n");
  StateReader other(lines, {"x", "y"}, "input");
  EXPECT_EQ(other.next(), kExpected[0]);
  EXPECT_EQ(extra(other), "t=[1,\"a\"];");
  EXPECT_EQ(other.next(), kExpected[1]);
  EXPECT_EQ(extra(other), "");
}

TEST(StateReader, ErrorsOfCsvNameTheLine) {
  EXPECT_EQ(defect("x,z,\"a,b\"\n"), "no column for the state 'y'; no state is 'z', 'a,b' (input, line 1)");
  EXPECT_EQ(defect("\nx\n"), "no column for the state 'y' (input, line 2)");
  EXPECT_EQ(defect("x,y,x\n"), "'x' is given twice (input, line 1)");
  EXPECT_EQ(defect("x,y\n1,2\n\n3\n"), "expected 2 values, found 1 (input, line 4)");
  EXPECT_EQ(defect("x,y\n1,\n"), "expected a number, found nothing (input, line 2, y)");
  EXPECT_EQ(defect("x,y\n1,2 3\n"),
            "expected an operator or the end, found '3' (input, line 2, y, column 3)");
  EXPECT_EQ(defect("x,y\n1,\"2\n"), "a quotation mark is not closed (input, line 2)");
}

TEST(StateReader, TablesWithDecimalCommasAreNamed) {
  const std::string expected = "expected commas between columns and points in numbers, found ";
  EXPECT_EQ(defect("x;y\n1,5;2\n"), expected + "semicolons (input, line 1)");
  EXPECT_EQ(defect("x\ty\n1\t2\n"), expected + "tabs (input, line 1)");
  EXPECT_EQ(defect("x,y\n1,5,2,5\n"),
            "expected 2 values, found 4; numbers need a decimal point, not a comma (input, line 2)");
  EXPECT_EQ(defect("x,y\n\"1,5\",2\n"), "expected a decimal point, found '1,5' (input, line 2, x)");
}

TEST(StateReader, ErrorsOfJsonNameTheLine) {
  EXPECT_EQ(defect("{\"x\": 1}\n"), "no value for the state 'y' (input, line 1)");
  EXPECT_EQ(defect("{\"x\":1,\"y\":2}\n[1, 2]\n"), "expected a JSON object a line (input, line 2)");
  EXPECT_EQ(defect("{\"x\":1,\"z\":3}\n"), "no value for the state 'y'; no state is 'z' (input, line 1)");
  EXPECT_EQ(defect("{\"x\":true,\"y\":2}\n"), "expected a number or a string (input, line 1, x)");
  EXPECT_EQ(defect("{\"x\":1,\"y\":2}\n{\"x\":1,\"y\":}\n"),
            "expected a value, found '}' (input, line 2, column 12)");
  EXPECT_EQ(defect("{\"x\":1,\"y\":2}\n\n{\"x\":1,\"x\":2}\n"), "repeated key 'x' (input, line 3)");
}

}  // namespace
}  // namespace coordreq
