// Mutated map files: each is a valid map, or refused with one of the two errors of bad input.

#include "tests/support/map_factories.h"
#include "tests/support/ring_oracles.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/io/houseexpo.h>
#include <mrpt_polyloc/io/wkt.h>

#include <gtest/gtest.h>

#include <iostream>
#include <string>

namespace mrpt_polyloc::test {
namespace {

/// A few random changes to a text: characters, numbers and pieces replaced, removed, doubled.
std::string mutated(std::string text, std::mt19937& random) {
  static const std::vector<std::string> kScraps{
      "1e308",    "-1e308",    "1e-300", "nan",   "inf",   "0",       "-",    ",",    "(",
      ")",        "[",         "]",      "EMPTY", "1e999", "POLYGON", "null", "{}",   "\"",
      " ",        "\n",        ":",      "1 2",   "[[",    "]]",      "free", "open", "wall",
      "\xc3\xa4", "999999999", "5",      "2.5",   ".",     "e",       "+",    "((",   "))"};
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t at = below(text.size());
    const std::size_t length = 1 + below(std::min<std::size_t>(12, text.size() - at));
    switch (below(15)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, kScraps[below(kScraps.size())]);
        break;
      case 2:
        text.replace(at, length, kScraps[below(kScraps.size())]);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 4:
        text[at] = static_cast<char>(below(256));
        break;
      default: {  // another digit: the most likely to stay readable
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
      }
    }
    if (below(50) == 0) text.resize(at);  // truncated
  }
  return text;
}

struct FuzzTally {
  int valid = 0, invalid = 0, unreadable = 0;
};

template <class Parse>
FuzzTally fuzz(const std::vector<std::string>& texts, int rounds, unsigned seed,
               const Parse& parse) {
  FuzzTally tally;
  std::mt19937 random(seed);
  for (int i = 0; i < rounds; ++i) {
    const std::string text = mutated(texts[static_cast<std::size_t>(i) % texts.size()], random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", mutation " + std::to_string(i) + ": " + text);
    try {
      const RepairedMap repaired = repairMap(parse(text));
      ++tally.valid;
      EXPECT_GT(repaired.map.area(), 0.0);
      EXPECT_EQ(countMeetings(edgesOf(repaired.map), Meeting::cross), 0U);
    } catch (const FormatError& error) {
      ++tally.unreadable;
      EXPECT_EQ(std::string(error.what()).rfind("fuzz: ", 0), 0U) << error.what();
    } catch (const InvalidMapError&) {
      ++tally.invalid;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "another exception: " << error.what();
    }
  }
  std::cout << tally.valid << " valid, " << tally.invalid << " invalid, " << tally.unreadable
            << " unreadable\n";
  return tally;
}

TEST(MapTextFuzz, Wkt) {
  const FuzzTally tally =
      fuzz({toWkt(lRoomMap()), toWkt(pillarMap(2, 1)), toWkt(touchingHolesMap()),
            "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4)), ((5 5, 9 5, 9 9), (6 5.5, 8 5.5, 8 7)))\n"
            "POLYGON ((10 10, 12 10, 12 12))\n"},
           6000, 11, [](const std::string& text) { return parseWkt(text, "fuzz"); });
  EXPECT_GT(tally.valid, 200);
  EXPECT_GT(tally.invalid, 200);
  EXPECT_GT(tally.unreadable, 200);
}

TEST(MapTextFuzz, GeoJson) {
  const PolygonMap open = withOpenEdges(pillarMap(1, 1), 0.4, 3);
  const FuzzTally tally =
      fuzz({toGeoJson(lRoomMap()), toGeoJson(touchingHolesMap()),
            toGeoJson(PolygonMap(open.components(), {{{20, 0}, {20, 5}}}))},
           6000, 12, [](const std::string& text) { return parseGeoJson(text, "fuzz"); });
  EXPECT_GT(tally.valid, 200);
  EXPECT_GT(tally.invalid, 50);
  EXPECT_GT(tally.unreadable, 200);
}

TEST(MapTextFuzz, HouseExpo) {
  const FuzzTally tally =
      fuzz({R"({"verts": [[0, 0], [4, 0], [4, 4], [2, 4], [2, 2], [0, 2]], "id": "x"})"}, 3000, 13,
           [](const std::string& text) { return parseHouseExpo(text, "fuzz"); });
  EXPECT_GT(tally.valid, 200);
  EXPECT_GT(tally.invalid, 20);
  EXPECT_GT(tally.unreadable, 200);
}

}  // namespace
}  // namespace mrpt_polyloc::test
