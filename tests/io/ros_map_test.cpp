#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/ros_map.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mrpt_polyloc {
namespace {

using test::formatErrorOf;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kYaml =
    "image: map.pgm\nresolution: 0.05\norigin: [-1.5, 2.25, 0.5]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// A binary PGM of one row.
std::string pgmRow(const std::vector<int>& levels, int max_value = 255) {
  std::string bytes =
      "P5\n" + std::to_string(levels.size()) + " 1\n" + std::to_string(max_value) + "\n";
  for (const int level : levels) {
    if (max_value > 255) bytes += static_cast<char>(level / 256);
    bytes += static_cast<char>(level % 256);
  }
  return bytes;
}

/// The cells as text: '#' occupied, '.' free, '?' unknown.
std::string drawing(const OccupancyBitmap& bitmap) {
  std::string text;
  for (const CellState cell : bitmap.cells) text += "?.#"[static_cast<std::size_t>(cell)];
  return text;
}

class RosMap : public test::QuietTest {
 protected:
  OccupancyBitmap load(const std::string& yaml, const std::string& image,
                       const std::string& name = "map.pgm") {
    test::writeFile(dir_.file(name), image);
    test::writeFile(path_, yaml);
    return loadRosMap(path_);
  }
  std::string draw(const std::string& yaml, const std::vector<int>& levels, int max_value = 255) {
    return drawing(load(yaml, pgmRow(levels, max_value)));
  }
  std::string errorOf(const std::string& yaml, const std::string& image = pgmRow({0, 255}),
                      const std::string& name = "map.pgm") {
    return formatErrorOf([&] { load(yaml, image, name); });
  }

  /// Draws, and keeps the notes in `notes_`.
  std::string drawNoted(const std::string& yaml, const std::vector<int>& levels) {
    test::writeFile(dir_.file("map.pgm"), pgmRow(levels));
    test::writeFile(path_, yaml);
    notes_.clear();
    return drawing(loadRosMap(path_, &notes_));
  }

  std::string path_ = dir_.file("map.yaml");
  Notes notes_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(RosMap, KeepsThePlaceExactly) {
  const auto bitmap = load(replaced(kYaml, "[-1.5, 2.25, 0.5]", "[-13.9155, -10.99537, 0.7]"),
                           pgmRow({0, 255, 205}));
  EXPECT_EQ(bitmap.width, 3);
  EXPECT_EQ(bitmap.height, 1);
  EXPECT_EQ(bitmap.resolution, 0.05);
  EXPECT_EQ(bitmap.pose_map_bitmap.x, -13.9155);
  EXPECT_EQ(bitmap.pose_map_bitmap.y, -10.99537);
  EXPECT_EQ(bitmap.pose_map_bitmap.phi, 0.7);
  EXPECT_EQ(drawing(bitmap), "#.?");
}

TEST_F(RosMap, TopRowOfTheImageIsTheHighestRow) {
  const auto bitmap = load(kYaml, std::string("P5 2 3 255\n") + "\x01\xfe\xfe\xfe\xcd\x01");
  EXPECT_EQ(bitmap.at(0, 2), CellState::occupied);
  EXPECT_EQ(bitmap.at(1, 2), CellState::free);
  EXPECT_EQ(bitmap.at(0, 0), CellState::unknown);
  EXPECT_EQ(bitmap.at(1, 0), CellState::occupied);
}

// p = (255 - v) / 255: 205 is 0.19608, 89 is 0.65098, 90 is 0.64706, 206 is 0.19216.
TEST_F(RosMap, ThresholdsAreStrict) {
  EXPECT_EQ(draw(kYaml, {89, 90, 205, 206}), "#??.");
  EXPECT_EQ(draw(replaced(kYaml, "0.196", "0.25"), {89, 90, 205, 206}), "#?..");
  const std::string fifth = replaced(replaced(kYaml, "0.196", "0.2"), "0.65", "0.8");
  EXPECT_EQ(draw(fifth, {50, 51, 204, 205}), "#??.");  // 51 and 204 are exactly 0.8 and 0.2
}

TEST_F(RosMap, Negates) {
  for (const char* yes : {"1", "true", "True"}) {
    EXPECT_EQ(draw(replaced(kYaml, "negate: 0", std::string("negate: ") + yes), {0, 49, 50, 166}),
              "..?#");
  }
  EXPECT_EQ(draw(replaced(kYaml, "negate: 0", "negate: false"), {0, 255}), "#.");
  EXPECT_THAT(errorOf(replaced(kYaml, "negate: 0", "negate: 2")),
              AllOf(HasSubstr("map.yaml: line 4: "), HasSubstr("'negate'")));
}

TEST_F(RosMap, Modes) {
  EXPECT_EQ(draw(kYaml + "mode: trinary\n", {0, 128, 254}), "#?.");
  EXPECT_EQ(draw(kYaml + "mode: scale\n", {0, 128, 254}), "#?.");
  EXPECT_EQ(draw(kYaml + "mode: raw\n", {0, 19, 20, 65, 66, 100, 101, 255}), "..??##??");
  EXPECT_EQ(draw(replaced(kYaml, "negate: 0", "negate: 1") + "mode: raw\n", {255, 155, 154, 0}),
            ".#??");
  EXPECT_THAT(errorOf(kYaml + "mode: fancy\n"),
              AllOf(HasSubstr("line 7: "), HasSubstr("fancy"), HasSubstr("trinary")));
}

TEST_F(RosMap, DefaultsAreThoseOfNav2) {
  EXPECT_EQ(draw("image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n", {89, 90, 191, 192}),
            "#??.");
}

TEST_F(RosMap, ReadsTheWaysOfWritingYaml) {
  const std::string expected = "#.?";
  const std::vector<int> levels = {0, 255, 205};
  EXPECT_EQ(draw("---\nimage: 'map.pgm'   # the picture\n\n# comment\nresolution: 5.0e-2\norigin:\n"
                 "- -1.5\n- 2.25\n- +0.5\nfree_thresh: \"0.196\"\nextra: [a, b]\n...\nnonsense",
                 levels),
            expected);
  EXPECT_EQ(draw("\xEF\xBB\xBFimage: map.pgm\r\nresolution: 1\r\norigin: [0,\r\n   0,\r\n  0]\r\n"
                 "free_thresh: 0.196\r\n",
                 levels),
            expected);
  EXPECT_EQ(draw("image: map.pgm\nresolution: 1\norigin:\n  - 0\n  - 0\n  - 0\nmode:\n"
                 "free_thresh: 0.9\nfree_thresh: 0.196\n",
                 levels),
            expected);  // an empty value is a default, the last of two counts
}

TEST_F(RosMap, ReadsTheImageFromTheYamlsFolder) {
  test::writeFile(dir_.file("a b#c.pgm"), pgmRow({0, 255}));
  test::writeFile(path_, replaced(kYaml, "map.pgm", "a b#c.pgm"));
  EXPECT_EQ(drawing(loadRosMap(path_)), "#.");
  test::writeFile(path_, replaced(kYaml, "map.pgm", "\"" + dir_.file("a b#c.pgm") + "\""));
  EXPECT_EQ(drawing(loadRosMap(path_)), "#.");
}

TEST_F(RosMap, NamesTheKeyThatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"image: map.pgm", "image"},
      {"resolution: 0.05", "resolution"},
      {"origin: [-1.5, 2.25, 0.5]", "origin"}};
  for (const auto& [line, key] : cases) {
    EXPECT_THAT(errorOf(replaced(kYaml, line, "other: 1")),
                AllOf(HasSubstr("map.yaml: "), HasSubstr("'" + key + "' is missing")));
  }
  for (const std::string bad : {"0", "-0.05", "nan", "inf", "wide", "[0.05]", "0.05 m"}) {
    EXPECT_THAT(errorOf(replaced(kYaml, "0.05", bad)),
                AllOf(HasSubstr("map.yaml: line 2: "), HasSubstr("'resolution'")))
        << bad;
  }
  for (const std::string bad : {"[0, 0]", "[0, 0, 0, 0]", "[0, 0, x]", "[0, nan, 0]", "3", "[]"}) {
    EXPECT_THAT(errorOf(replaced(kYaml, "[-1.5, 2.25, 0.5]", bad)),
                AllOf(HasSubstr("map.yaml: line 3: "), HasSubstr("'origin'")))
        << bad;
  }
  EXPECT_THAT(errorOf(replaced(kYaml, "0.65", "high")), HasSubstr("'occupied_thresh'"));
}

TEST_F(RosMap, NamesTheLineThatIsNoYaml) {
  for (const std::string bad : {"origin: [1, 2\n", "key\n", "  indented: 1\n", "a: 'x\n",
                                "a: 'x' y\n", "a: [1] 2\n", "a: [1]\n- 2\n", "a: 1\n- 2\n"}) {
    EXPECT_THAT(errorOf(kYaml + bad), testing::MatchesRegex(".*map.yaml: line [789]: .*")) << bad;
  }
  EXPECT_THAT(errorOf("- 1\n"), HasSubstr("line 1: "));
  EXPECT_THAT(errorOf(pgmRow({0, 1, 2})), HasSubstr("map.yaml: line "));
  EXPECT_THAT(errorOf(""), HasSubstr("empty file"));
}

TEST_F(RosMap, NamesYamlAndImageIfTheImageIsMissingOrBad) {
  EXPECT_THAT(errorOf(replaced(kYaml, "map.pgm", "gone.pgm")),
              AllOf(HasSubstr("map.yaml: "), HasSubstr("/gone.pgm")));
  EXPECT_THAT(errorOf(replaced(kYaml, "map.pgm", ".")), HasSubstr("map.yaml: "));
  EXPECT_THAT(errorOf(kYaml, "hello"), AllOf(HasSubstr("map.yaml: "), HasSubstr("map.pgm"),
                                             HasSubstr(".pgm, .ppm, .png, .bmp")));
  EXPECT_THAT(errorOf(kYaml, "BM"), HasSubstr("map.pgm: truncated"));
  EXPECT_THAT(errorOf(kYaml, "P4 1 1\na"), HasSubstr("map.pgm: a netpbm image that is not"));
}

TEST_F(RosMap, WhatMapSaverLeavesUnknownStaysUnknown) {
  const std::string fourth = replaced(kYaml, "0.196", "0.25");
  for (const std::string& yaml : {fourth, replaced(kYaml, "free_thresh: 0.196\n", "")}) {
    EXPECT_EQ(drawNoted(yaml, {0, 205, 254, 255}), "#?..");
    EXPECT_THAT(notes_, ElementsAre(AllOf(HasSubstr("'free_thresh' 0.25"), HasSubstr("205"))));
  }
  EXPECT_EQ(drawNoted(kYaml, {0, 205, 254}), "#?.");
  EXPECT_THAT(notes_, IsEmpty());
  // Of an image with other levels, or another mode, the thresholds are meant.
  EXPECT_EQ(drawNoted(fourth, {0, 205, 254, 100}), "#..?");
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_EQ(drawNoted(fourth + "mode: scale\n", {0, 205, 254}), "#..");
}

TEST_F(RosMap, TellsWhereNearlyNothingIsUnknown) {
  EXPECT_EQ(drawNoted(replaced(kYaml, "0.196", "0.3"), {0, 200, 254}), "#..");
  EXPECT_THAT(notes_, ElementsAre(AllOf(HasSubstr("66.7 % is free, 33.3 % occupied, 0 % unknown"),
                                        HasSubstr("0 to 254"), HasSubstr("'free_thresh' 0.3"))));
}

TEST_F(RosMap, AsksForOccupiedFirstWhereThresholdsAreCrossed) {
  const std::string crossed = replaced(replaced(kYaml, "0.196", "0.9"), "0.65", "0.1");
  EXPECT_EQ(drawNoted(crossed, {0, 205, 254}), "##.");
  EXPECT_THAT(notes_.front(), AllOf(HasSubstr("crossed"), HasSubstr("0.9"), HasSubstr("0.1")));
}

TEST_F(RosMap, TakesAYawThatIsNanForNone) {
  for (const char* nan : {"nan", "-nan", ".nan", "NaN"}) {
    const auto bitmap = load(replaced(kYaml, "0.5]", std::string(nan) + "]"), pgmRow({0, 255, 90}));
    EXPECT_EQ(bitmap.pose_map_bitmap.phi, 0.0);
    drawNoted(replaced(kYaml, "0.5]", std::string(nan) + "]"), {0, 205, 254});
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("taken for 0")));
  }
  EXPECT_THAT(errorOf(replaced(kYaml, "0.5]", "banana]")), HasSubstr("line 3: "));
}

TEST_F(RosMap, PassesOverWhatOtherProgramsWriteIntoTheYaml) {
  EXPECT_EQ(drawNoted("%YAML 1.2\n---\n" + kYaml + "extra:\n  nested: {a: [1, [2]]}\n", {0, 254}),
            "#.");
  EXPECT_THAT(errorOf(replaced(kYaml, "0.05", "{a: 1}")), HasSubstr("line 2: 'resolution'"));
  EXPECT_THAT(errorOf(replaced(kYaml, "[-1.5, 2.25, 0.5]", "[[1], 2, 3]")),
              HasSubstr("line 3: 'origin'"));
}

TEST_F(RosMap, FindsTheImageOfAnotherMachine) {
  const std::string far = replaced(kYaml, "map.pgm", "/no/such/folder/map.pgm");
  EXPECT_EQ(drawNoted(far, {0, 254}), "#.");
  EXPECT_THAT(notes_.front(), AllOf(HasSubstr("/no/such/folder/map.pgm"), HasSubstr("taken is")));
  EXPECT_EQ(drawNoted(replaced(kYaml, "map.pgm", "~/no/map.pgm"), {0, 254}), "#.");
  EXPECT_THAT(errorOf(replaced(kYaml, "map.pgm", "/no/such/file.pgm")),
              HasSubstr("no file /no/such/file.pgm"));
  EXPECT_THAT(errorOf(replaced(kYaml, "map.pgm", "sub/map.pgm")), HasSubstr("there is no file"));
}

TEST_F(RosMap, ExpandsTheHomeFolder) {
  const char* const home = std::getenv("HOME");
  const std::string before = home == nullptr ? "" : home;
  setenv("HOME", dir_.file("").c_str(), 1);
  EXPECT_EQ(drawNoted(replaced(kYaml, "map.pgm", "~/map.pgm"), {0, 205, 254}), "#?.");
  EXPECT_THAT(notes_, IsEmpty());
  setenv("HOME", before.c_str(), 1);
}

TEST_F(RosMap, TellsTheKindOfImageByItsFirstBytes) {
  EXPECT_EQ(drawing(load(kYaml, test::pngFile(2, 1, 8, 0, std::string("\0\xff", 2)))), "#.");
  EXPECT_EQ(drawing(load(kYaml, std::string("P6 3 1 255\n\0\0\0\xfe\xfe\xfe\xff\0\0", 20))), "#.#");
  EXPECT_EQ(drawing(load(kYaml, "P3 2 1 9 0 0 0 9 9 9")), "#.");
  const std::string cases = std::string(POLYLOC_SOURCE_DIR) + "/tests/io/cases/map.";
  const std::string png = drawing(load(kYaml, test::readFile(cases + "png")));
  EXPECT_GT(std::count(png.begin(), png.end(), '.'), 10000);
  EXPECT_EQ(drawing(load(kYaml, test::readFile(cases + "bmp"))), png);
  const std::string jpg = drawing(load(kYaml, test::readFile(cases + "jpg")));
  ASSERT_EQ(jpg.size(), png.size());
  std::size_t free_taken_for_wall = 0, free = 0;
  for (std::size_t i = 0; i < png.size(); ++i) {
    free += png[i] == '.';
    free_taken_for_wall += png[i] == '.' && jpg[i] == '#';
  }
  EXPECT_LT(100 * free_taken_for_wall, free);
}

TEST_F(RosMap, SaysWhatItSawOfAGreyMap) {
  drawNoted(kYaml, {128, 128, 128, 90, 190});
  EXPECT_THAT(rosMapShares(path_),
              AllOf(HasSubstr("0 % is free, 0 % occupied, 100 % unknown"), HasSubstr("90 to 190"),
                    HasSubstr("'free_thresh: 0.48' and 'occupied_thresh: 0.52'")));
}

TEST_F(RosMap, EveryTruncationOfTheYamlIsRefusedOrChangesNoLine) {
  // A yaml has no end mark: a cut inside its last lines only loses optional keys or digits.
  for (std::size_t size = 0; size < kYaml.find("negate"); ++size) {
    const std::string message = errorOf(kYaml.substr(0, size));
    if (size + 2 < kYaml.find("negate")) {
      ASSERT_THAT(message, HasSubstr("map.yaml: ")) << size;
    }
  }
}

TEST_F(RosMap, ReadsPlainPgm) {
  const std::string plain = "P2 # a comment\n#another\n2 2 # size\n100\n0 100\n  50#x\n99";
  EXPECT_EQ(drawing(load(kYaml, plain)), "?.#.");
  for (std::size_t size = 0; size < plain.size() - 1; ++size) {
    ASSERT_THAT(errorOf(kYaml, plain.substr(0, size)), HasSubstr("map.pgm: ")) << size;
  }
  EXPECT_THAT(errorOf(kYaml, "P2 2 1 100 5 101"), HasSubstr("above the greatest value"));
  EXPECT_THAT(errorOf(kYaml, "P2 2 1 100 5 x"), HasSubstr("pixel 1"));
}

TEST_F(RosMap, ReadsBinaryPgmOfManyLevels) {
  EXPECT_EQ(draw(kYaml, {0, 65535, 52685, 22937, 22938}, 65535),
            "#.?"
            "#?");
  EXPECT_EQ(draw(kYaml, {0, 1}, 1), "#.");
  EXPECT_EQ(drawing(load(kYaml, "P5#c\n2#c\n1 #c\n255\n##")), "##");  // pixels, not comments
  const std::string whole = pgmRow({1, 2, 3, 4}, 300);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_THAT(errorOf(kYaml, whole.substr(0, size)), HasSubstr("map.pgm: ")) << size;
  }
  EXPECT_THAT(errorOf(kYaml, whole.substr(0, whole.size() - 1)), HasSubstr("3 of 4 pixels"));
}

TEST_F(RosMap, RefusesSizesOutOfRange) {
  for (const char* bad :
       {"P5 0 5 255\n", "P5 5 0 255\n", "P5 -5 5 255\n", "P5 5 5 0\n", "P5 5 5 65536\n",
        "P5 99999999999999999999 5 255\n", "P5 300000 300000 255\n", "P2 20000 20000 255\n1",
        "P5 20000 20000 255\n1", "P5 5", "P5 5x5 255\n"}) {
    EXPECT_THAT(errorOf(kYaml, bad), HasSubstr("map.pgm: ")) << bad;
  }
}

class RosMapPng : public RosMap {
 protected:
  std::string drawPng(const std::string& png, const std::string& mode = "trinary") {
    return drawing(load(yaml_ + "mode: " + mode + "\n", png, "map.png"));
  }
  std::string yaml_ = replaced(kYaml, "map.pgm", "map.png");
};

TEST_F(RosMapPng, ReadsEveryColourType) {
  using std::string;
  EXPECT_EQ(drawPng(test::pngFile(4, 1, 8, 0, string("\x00\x59\xcd\xff", 4))), "##?.");
  EXPECT_EQ(drawPng(test::pngFile(8, 1, 1, 0, "\x0f")), "####....");
  EXPECT_EQ(drawPng(test::pngFile(2, 1, 16, 0, string("\x00\x10\xf0\x00", 4))), "#.");
  EXPECT_EQ(drawPng(test::pngFile(3, 1, 8, 2, string("\0\0\0\xff\xff\xff\xff\0\0", 9))), "#.#");
  EXPECT_EQ(drawPng(test::pngFile(2, 1, 16, 2, string(6, '\xff') + string(6, '\0'))), ".#");
}

// Means of the colours: (255 + 0 + 0) / 3 = 85 is occupied, (255 + 255 + 0) / 3 = 170 unknown.
TEST_F(RosMapPng, TakesTheMeanOfTheColours) {
  const std::string rows("\xff\0\0\xff\xff\0\0\0\xff\0\xff\xff", 12);
  EXPECT_EQ(drawPng(test::pngFile(2, 2, 8, 2, rows)), "#?#?");
}

TEST_F(RosMapPng, TopRowIsTheHighest) {
  EXPECT_EQ(drawPng(test::pngFile(2, 2, 8, 0, std::string("\x00\xff\xff\xff", 4))), "..#.");
}

TEST_F(RosMapPng, TransparentPixelsAreUnknown) {
  const std::string rgba("\0\0\0\xff\0\0\0\0\xff\xff\xff\x80\0\0\0\x80", 16);
  EXPECT_EQ(drawPng(test::pngFile(4, 1, 8, 6, rgba)), "#?.#");
  EXPECT_EQ(drawPng(test::pngFile(4, 1, 8, 6, rgba), "scale"), "#???");
  const std::string gray_alpha("\0\xff\0\0\xff\xff", 6);
  EXPECT_EQ(drawPng(test::pngFile(3, 1, 8, 4, gray_alpha)), "#?.");
}

TEST_F(RosMapPng, RefusesWhatIsTruncatedOrDamaged) {
  std::mt19937 random(31);
  std::string rows;
  for (int i = 0; i < 15 * 10; ++i) rows += static_cast<char>(random());
  const std::string whole = test::pngFile(15, 10, 8, 0, rows);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_THAT(errorOf(yaml_, whole.substr(0, size), "map.png"), HasSubstr("map.png: ")) << size;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    ASSERT_THAT(errorOf(yaml_, bytes, "map.png"), HasSubstr("map.png: ")) << at;
  }
  EXPECT_EQ(errorOf(yaml_, whole, "map.png"), "");
}

TEST_F(RosMapPng, RefusesSizesOutOfRange) {
  const std::string row(10, '\0');
  EXPECT_THAT(errorOf(yaml_, test::pngFile(0, 1, 8, 0, row), "map.png"), HasSubstr("no pixel"));
  EXPECT_THAT(errorOf(yaml_, test::pngFile(2000000, 1000000, 8, 0, row), "map.png"),
              HasSubstr("more than"));
}

}  // namespace
}  // namespace mrpt_polyloc
