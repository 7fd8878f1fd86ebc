#include "apps/common/parsing.h"

#include "apps/common/Cli.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc::apps {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Parsing, NumbersAreFiniteAndWhole) {
  EXPECT_EQ(parseFinite("-2.5e1"), -25.0);
  EXPECT_EQ(parseFinite("0"), 0.0);
  for (const char* bad : {"", " 1", "1 ", "1m", "inf", "nan", "1e999", "--1", "0x10"}) {
    EXPECT_EQ(parseFinite(bad), std::nullopt) << "'" << bad << "'";
  }
}

TEST(Parsing, RowsAreInclusiveAscendingAndClippedAtTheEnd) {
  EXPECT_THAT(selectRows(parseRows("7,0-2,2,9-20"), 12), ElementsAre(0, 1, 2, 7, 9, 10, 11));
  EXPECT_THAT(selectRows(parseRows("3-18446744073709551615"), 5), ElementsAre(3, 4));
  EXPECT_THAT(selectRows(parseRows("5"), 5), IsEmpty());
}

TEST(Parsing, RowsRefuseEverythingElse) {
  for (const char* bad : {"", ",", "1,", "a", "3-1", "1-2-3", "-1", "1-", "1.0", " 1"}) {
    EXPECT_THROW(parseRows(bad), UsageError) << "'" << bad << "'";
  }
}

TEST(Parsing, DiskAndTolerance) {
  const PosePrior::Disk disk = parseDisk("-1.5,2,0.5");
  EXPECT_EQ(disk.x, -1.5);
  EXPECT_EQ(disk.y, 2.0);
  EXPECT_EQ(disk.radius, 0.5);
  const Tolerance tolerance = parseTolerance("0.3,180");
  EXPECT_EQ(tolerance.distance, 0.3);
  EXPECT_DOUBLE_EQ(tolerance.angle, M_PI);
  EXPECT_EQ(parsePoint("--view", "-1.5,2"), mrpt::math::TPoint2D(-1.5, 2.0));
  for (const char* bad : {"", "1", "1,2,3", "1,inf"}) {
    EXPECT_THROW(parsePoint("--view", bad), UsageError) << "'" << bad << "'";
  }
  for (const char* bad : {"", "1,2", "1,2,-1", "1,2,3,4", "1;2;3", "1,nan,3"}) {
    EXPECT_THROW(parseDisk(bad), UsageError) << "'" << bad << "'";
  }
  for (const char* bad : {"", "1", "0,5", "-1,5", "1,0", "1,180.1", "1,2,3"}) {
    EXPECT_THROW(parseTolerance(bad), UsageError) << "'" << bad << "'";
  }
}

}  // namespace
}  // namespace mrpt_polyloc::apps
