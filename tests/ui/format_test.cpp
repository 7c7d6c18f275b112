#include "ui/format.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

TEST(Format, NumbersCarryTheirSignAndNeverAMinusZero) {
  EXPECT_EQ(signedNumber(0.6004, 3), "+0.600");
  EXPECT_EQ(signedNumber(-1.25, 1), QStringLiteral("\u22121.3"));
  EXPECT_EQ(signedNumber(-0.0004, 3), "+0.000");
  EXPECT_EQ(plainNumber(-0.1, 1), "0.0");
}

TEST(Format, WhatIsNotThereIsADash) {
  EXPECT_EQ(milliseconds(0, 2), kNoValue);
  EXPECT_EQ(milliseconds(1'234'000, 2), "1.23");
}

TEST(Format, ClockCountsMinutesSecondsTenths) {
  EXPECT_EQ(clockText(0), "00:00.0");
  EXPECT_EQ(clockText(fromSeconds(67.39)), "01:07.3");
  EXPECT_EQ(clockText(fromSeconds(3600.0)), "60:00.0");
  EXPECT_EQ(clockText(-5), "00:00.0");
}

}  // namespace
}  // namespace helical
