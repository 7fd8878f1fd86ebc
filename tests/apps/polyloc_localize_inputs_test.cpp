#include "PolylocLocalizeTest.h"

#include <gmock/gmock.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(PolylocLocalize, KeepsItsIndexInAFile) {
  simulate("sim");
  const Outcome plain = localize({});
  const Outcome writes = localize({"--index", path("room.index")});
  ASSERT_EQ(writes.code, 0) << writes.err;
  ASSERT_TRUE(std::filesystem::exists(path("room.index")));
  const Outcome reads = localize({"--index", path("room.index")});
  ASSERT_EQ(reads.code, 0) << reads.err;
  EXPECT_EQ(withoutTimes(writes.out), withoutTimes(plain.out));
  EXPECT_EQ(withoutTimes(reads.out), withoutTimes(plain.out));
}

TEST_F(PolylocLocalize, ExplainsWhatItMakesOfMapAndScans) {
  simulate("sim");
  const Outcome outcome = localize({"--explain"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("free space    36.90 m2 in 1 parts"), HasSubstr("hits"),
                                 HasSubstr("odd: no reading is a no-return")));
  EXPECT_THAT(localize({"--explain", "--max-range", "2"}).out,
              AllOf(HasSubstr("nothing within 2.00 m"), HasSubstr("odd: the range is short")));
  EXPECT_EQ(localize({"--explain", "--method", "exact"}).code, 2);
  write("bad.wkt", "POLYGON ((");
  EXPECT_EQ(run("polyloc-localize",
                {"--map", path("bad.wkt"), "--scans", path("sim/scans.rawlog"), "--explain"})
                .code,
            1);
}

TEST_F(PolylocLocalize, TakesLimitsOfTheRange) {
  simulate("sim");
  const std::string plain = withoutTimes(localize({}).out);
  EXPECT_NE(withoutTimes(localize({"--max-range", "1.5"}).out), plain);
  EXPECT_NE(withoutTimes(localize({"--min-range", "1.5"}).out), plain);
  EXPECT_EQ(withoutTimes(localize({"--max-range", "1000", "--min-range", "0"}).out), plain);
  for (const char* bad : {"0", "-1", "inf", "x"}) {
    EXPECT_EQ(localize({"--max-range", bad}).code, 2) << bad;
  }
  EXPECT_EQ(localize({"--min-range", "-1"}).code, 2);
  EXPECT_EQ(localize({"--max-range", "1", "--min-range", "2"}).code, 1);
}

TEST_F(PolylocLocalize, UsesTheWholePartOfALogThatIsCutShort) {
  simulate("sim");
  const std::string whole = readFile(path("sim/scans.rawlog"));
  write("cut.rawlog", whole.substr(0, whole.size() - 20));
  const Outcome outcome = localize({}, "cut.rawlog");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, AllOf(StartsWith("polyloc-localize: "),
                                 HasSubstr("cut.rawlog: note: it is cut short")));
  const Outcome strict = localize({"--strict"}, "cut.rawlog");
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.err, HasSubstr("truncated"));
}

TEST_F(PolylocLocalize, ScalesAMapInMillimetres) {
  simulate("sim");
  write("mm.wkt", "POLYGON ((0 0, 4000 0, 4000 3000, 0 3000))");
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--map", path("mm.wkt"), "--scans",
                                          path("sim/scans.rawlog")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-localize", arguments);
  };
  const Outcome refused = with({});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("mm.wkt"), HasSubstr("--scale 0.001")));
  EXPECT_EQ(with({"--scale", "0.001"}).code, 0);
  EXPECT_EQ(with({"--scale", "0"}).code, 2);
}

TEST_F(PolylocLocalize, RefusesAFileThatIsNotItsIndex) {
  simulate("sim");
  write("bad.index", "no index at all");
  const Outcome outcome = localize({"--index", path("bad.index")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("bad.index"), HasSubstr("not a search index")));
  write("empty.index", "");
  EXPECT_EQ(localize({"--index", path("empty.index")}).code, 1);
  EXPECT_EQ(localize({"--index", "/no/such/folder/room.index"}).code, 1);
}

TEST_F(PolylocLocalize, RowsChoosesScansAndClips) {
  simulate("sim");
  const Outcome outcome = localize({"--rows", "10-99,3"});
  ASSERT_EQ(outcome.code, 0);
  std::vector<int> rows;
  for (const auto& answer : firstAnswers(outcome.out)) rows.push_back(answer.first);
  EXPECT_THAT(rows, ElementsAre(3, 10, 11));
}

TEST_F(PolylocLocalize, RowsOutOfRangeFail) {
  simulate("sim");
  const Outcome outcome = localize({"--rows", "12-20"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("scans.rawlog"), HasSubstr("--rows 12-20"),
                                 HasSubstr("rows 0 to 11")));
}

TEST_F(PolylocLocalize, ScansWithoutInformationHaveOneRowOfRankZero) {
  const Outcome outcome = localize({}, scansOfBeams({0, 1}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = linesOf(outcome.out);
  ASSERT_THAT(lines, SizeIs(3));
  EXPECT_THAT(lines[1], StartsWith("0,1000000000.000000,too_few_beams,0,,,,,,,,,"));
  EXPECT_THAT(lines[2], StartsWith("1,1000000001.000000,too_few_beams,0,,,,,,,,,"));
  EXPECT_THAT(fieldsOf(lines[1]), SizeIs(kColumns));
  EXPECT_EQ(lines[1].substr(lines[1].size() - 10), ",0.0000,0,");  // match, listed, no covariance
}

TEST_F(PolylocLocalize, AStoredScanThatAsksForMoreMemoryThanThereIsFails) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.resizeScanAndAssign(0x3039, 1.0F, true);
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom<mrpt::io::CStream>(stream) << scan;
  std::string bytes(static_cast<const char*>(stream.getRawBufferData()),
                    stream.getTotalBytesCount());
  const std::size_t count = bytes.find(std::string("\x39\x30\0\0", 4));
  ASSERT_NE(count, std::string::npos);
  bytes.replace(count, 4, "\xf0\xff\xff\xff");  // 4 G readings: 17 GB
  const std::string log = write("hostile.rawlog", bytes);
  const Outcome outcome = run("polyloc-localize", {"--map", roomFile(), "--scans", log});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err,
            "polyloc-localize: " + log + ": object 0: a scan of more than 100000 beams\n");
}

TEST_F(PolylocLocalize, BadScanFilesFailWithAMessage) {
  const auto expectFailure = [&](const std::string& scans, const std::string& reason) {
    const Outcome outcome = localize({}, scans);
    EXPECT_EQ(outcome.code, 1) << scans;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("polyloc-localize: "), HasSubstr(scans), HasSubstr(reason)));
    EXPECT_THAT(outcome.out, IsEmpty());
  };
  expectFailure("missing.rawlog", "no such file");
  expectFailure("missing.log", "no such file");
  write("scans.bag", "x");
  expectFailure("scans.bag", "unknown extension");
  write("empty.rawlog", "");
  expectFailure("empty.rawlog", "empty");
  write("empty.log", "");
  expectFailure("empty.log", "");
  write("foreign.rawlog", "no rawlog at all");
  expectFailure("foreign.rawlog", "");
  write("fov.log", "FLASER 3 1.0 1.0 1.0 0 0 0 0 0 0 1.0 host 1.0\n");
  expectFailure("fov.log", "--laser-fov");
}

TEST_F(PolylocLocalize, LaserFovSaysWhatACarmenLogDoesNot) {
  write("fov.log", "FLASER 3 1.0 1.0 1.0 0 0 0 0 0 0 1.0 host 1.0\n");
  const Outcome outcome = localize({"--laser-fov", "180"}, "fov.log");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(linesOf(outcome.out), SizeIs(2));
}

TEST_F(PolylocLocalize, AnUnknownSensorLabelFails) {
  simulate("sim");
  EXPECT_EQ(localize({"--sensor", "LASER", "--rows", "0"}).code, 0);
  const Outcome outcome = localize({"--sensor", "REAR"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("REAR"));
}

TEST_F(PolylocLocalize, UnwritableOutputFailsBeforeTheSearch) {
  const std::string room = roomFile();
  for (const char* option : {"-o", "--svg", "--pf-ini"}) {
    const Outcome outcome = localize({option, room + "/out"}, "missing.rawlog");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(room + "/out"), HasSubstr("Not a directory")));
  }
  EXPECT_THAT(files(), ElementsAre("room.wkt"));
}

TEST_F(PolylocLocalize, RefusesAMapWhoseIndexWouldNotFit) {
  simulate("sim");
  const Outcome refused = localize({"--max-memory", "0.5", "--index", path("index")});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("room.wkt"), HasSubstr("MB"), HasSubstr("--max-memory"),
                                 HasSubstr("--leaf-size"), HasSubstr("--scale")));
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("room.wkt", "sim"));
  EXPECT_EQ(localize({"--max-memory", "50"}).code, 0);
  EXPECT_EQ(localize({"--max-memory", "0"}).code, 2);
  // The index of one that is far too large is not begun: this would take hours.
  const std::string plain = write("plain.wkt", "POLYGON ((0 0, 900 0, 900 900, 0 900))\n");
  const Outcome large = run("polyloc-localize", {"--map", plain, "--scans",
                                                 path("sim/scans.rawlog"), "--max-memory", "2000"});
  EXPECT_EQ(large.code, 1);
  EXPECT_THAT(large.err, HasSubstr("810000 m2"));
}

TEST_F(PolylocLocalize, SeveralMapsShareTheMemory) {
  simulate("sim");
  const auto in_both = [this](const std::string& megabytes) {
    return localize({"--map", roomFile(), "--rows", "0", "--max-memory", megabytes});
  };
  // What one of them takes, by the estimate that refuses it; two take twice that.
  const Outcome one = localize({"--rows", "0", "--max-memory", "1"});
  const Outcome refused = in_both("1");
  EXPECT_EQ(one.code, 1);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("room.wkt"), HasSubstr("--max-memory")));
  std::size_t enough_for_one = 2;
  while (localize({"--rows", "0", "--max-memory", std::to_string(enough_for_one)}).code != 0) {
    ASSERT_LT(++enough_for_one, 100U);
  }
  EXPECT_EQ(in_both(std::to_string(enough_for_one)).code, 1);
  EXPECT_EQ(in_both(std::to_string(2 * enough_for_one)).code, 0);
}

TEST_F(PolylocLocalize, LargerLeavesMakeASmallerIndexAndTheSameAnswer) {
  simulate("sim");
  const Outcome small = localize({"--rows", "0", "--index", path("small")});
  const Outcome large = localize({"--rows", "0", "--leaf-size", "0.5", "--index", path("large")});
  EXPECT_EQ(large.code, 0) << large.err;
  EXPECT_LT(2 * std::filesystem::file_size(path("large")),
            std::filesystem::file_size(path("small")));
  const auto a = firstAnswers(small.out).at(0), b = firstAnswers(large.out).at(0);
  EXPECT_EQ(a[2], b[2]);
  for (const std::size_t k : {4U, 5U, 6U}) EXPECT_NEAR(std::stod(a[k]), std::stod(b[k]), 0.01);
  // A stored index has leaves of its own.
  EXPECT_EQ(localize({"--rows", "0", "--index", path("large")}).code, 0);
  const Outcome other = localize({"--leaf-size", "0.25", "--index", path("large")});
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err, AllOf(HasSubstr("large"), HasSubstr("0.5 m"), HasSubstr("--leaf-size")));
  EXPECT_EQ(localize({"--leaf-size", "0.01"}).code, 2);
  EXPECT_EQ(localize({"--leaf-size", "0.5", "--method", "cells"}).code, 2);
}

}  // namespace
}  // namespace mrpt_polyloc::test
