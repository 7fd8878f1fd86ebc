#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/houseexpo.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

using testing::HasSubstr;

std::string houseExpoErrorOf(const std::string& text) {
  return messageOf<FormatError>([&] { parseHouseExpo(text, "home.json"); });
}

TEST(HouseExpo, ReadsVertsAndIgnoresTheRest) {
  const RawMap map = parseHouseExpo(
      R"({"room_category": {"Kitchen": [[0, 0, 1, 1]]}, "bbox": {"max": [4, 3], "min": [0, 0]},
          "verts": [[0.0, 0.0], [4.0, 0.0], [4, 3], [0, 3], [0, 0]], "id": "abc", "room_num": 1})",
      "home.json");
  ASSERT_EQ(map.polygons.size(), 1U);
  EXPECT_EQ(map.polygons[0].outer.size(), 5U);
  EXPECT_TRUE(map.polygons[0].holes.empty());
  EXPECT_DOUBLE_EQ(repairMap(map).map.area(), 12.0);
}

TEST(HouseExpo, ErrorsNameThePlace) {
  EXPECT_EQ(houseExpoErrorOf(R"({"id": "abc"})"), "home.json: has no \"verts\"");
  EXPECT_THAT(houseExpoErrorOf(R"({"verts": 3})"),
              HasSubstr("home.json: verts: expected an array"));
  EXPECT_THAT(houseExpoErrorOf(R"({"verts": [[0, 0], [1, "a"]]})"),
              HasSubstr("home.json: verts[1][1]: expected a finite number"));
  EXPECT_THAT(houseExpoErrorOf(R"({"verts": [[0, 0], [1, 0)"),
              HasSubstr("home.json: line 1, column "));
  EXPECT_THAT(houseExpoErrorOf(""), HasSubstr("the file is empty"));
  EXPECT_THAT(houseExpoErrorOf("[]"), HasSubstr("expected an object"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
