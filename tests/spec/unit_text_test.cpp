#include "spec/units.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

TEST(UdunitsSpelling, TimeWordsBecomeSymbols) {
  for (const char* name : {"s", "sec", "second", "seconds"}) EXPECT_EQ(udunits_spelling(name), "s");
  for (const char* name : {"min", "minute", "minutes"}) EXPECT_EQ(udunits_spelling(name), "min");
  for (const char* name : {"h", "hr", "hour", "hours"}) EXPECT_EQ(udunits_spelling(name), "h");
  EXPECT_EQ(udunits_spelling("days"), "d");
  EXPECT_EQ(udunits_spelling("milliseconds"), "ms");
}

TEST(UdunitsSpelling, TimeWordsInsideCompoundsToo) {
  EXPECT_EQ(udunits_spelling("m/second"), "m/s");
  EXPECT_EQ(udunits_spelling("m/second^2"), "m/s^2");
  EXPECT_EQ(udunits_spelling("m seconds-1"), "m s-1");
  EXPECT_EQ(udunits_spelling("km.hour-1"), "km.h-1");
}

TEST(UdunitsSpelling, OtherTextStaysAsWritten) {
  EXPECT_EQ(udunits_spelling("arc_second"), "arc_second");
  EXPECT_EQ(udunits_spelling("arcsecond"), "arcsecond");
  EXPECT_EQ(udunits_spelling("secondary"), "secondary");
  EXPECT_EQ(udunits_spelling("\xC2\xB0"
                             "C"),
            "\xC2\xB0"
            "C");
  EXPECT_EQ(udunits_spelling("m/s"), "m/s");
}

TEST(UdunitsSpelling, NoUnitIsAPlainNumber) {
  EXPECT_EQ(udunits_spelling(""), "1");
}

}  // namespace
}  // namespace coordreq
