#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/rawlog.h>
#include <mrpt_polyloc/io/rawlog_writer.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <set>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using test::formatErrorOf;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class Rawlog : public test::QuietTest {
 protected:
  /// The message when `bytes` are read as a rawlog; "" if they can be.
  std::string errorOf(const std::string& bytes, const std::string& label = {}) {
    test::writeFile(path_, bytes);
    ScanFileOptions options = test::ofSensor(label);
    options.strict = true;
    return formatErrorOf([&] { loadRawlog(path_, options); });
  }
  std::vector<CObservation2DRangeScan> observations(std::size_t count, std::size_t beams = 12,
                                                    const std::string& label = "LASER") {
    std::vector<CObservation2DRangeScan> scans;
    for (std::size_t i = 0; i < count; ++i) {
      scans.push_back(test::randomObservation(random_, beams, label));
    }
    return scans;
  }
  static std::vector<RangeScan> converted(const std::vector<CObservation2DRangeScan>& scans) {
    std::vector<RangeScan> result;
    for (const auto& scan : scans) result.push_back(toRangeScan(scan));
    return result;
  }
  static std::string bytesOf(const std::vector<CObservation2DRangeScan>& scans) {
    std::string bytes;
    for (const auto& scan : scans) bytes += test::serialised(scan);
    return bytes;
  }
  /// Actions and sensory frames of one or two scans each, with odometry among the scans.
  static mrpt::obs::CRawlog actionLog(const std::vector<CObservation2DRangeScan>& scans) {
    mrpt::obs::CRawlog log;
    for (std::size_t i = 0; i < scans.size();) {
      mrpt::obs::CActionCollection actions;
      actions.insert(mrpt::obs::CActionRobotMovement2D());
      log.insert(actions);
      mrpt::obs::CSensoryFrame frame;
      frame.insert(mrpt::obs::CObservationOdometry::Create());
      for (std::size_t k = 0; k < 1 + i % 2 && i < scans.size(); ++k) {
        frame.insert(CObservation2DRangeScan::Create(scans[i++]));
      }
      log.insert(frame);
    }
    return log;
  }

  std::string path_ = dir_.file("test.rawlog");
  std::mt19937 random_{21};
};

TEST_F(Rawlog, ReadsWhatTheWriterWrote) {
  const auto scans = observations(7, 90);
  writeScansRawlog(path_, scans);
  EXPECT_TRUE(test::sameScans(loadRawlog(path_), converted(scans)));
  const std::string bytes = test::readFile(path_);
  EXPECT_EQ(bytes.substr(0, 2), "\x1f\x8b");
  writeScansRawlog(path_, scans);
  EXPECT_EQ(test::readFile(path_), bytes);

  mrpt::obs::CRawlog by_mrpt;
  ASSERT_TRUE(by_mrpt.loadFromRawLogFile(path_));
  EXPECT_EQ(by_mrpt.size(), scans.size());
}

TEST_F(Rawlog, WriterTellsWhatCannotBeWritten) {
  EXPECT_THROW(writeScansRawlog(dir_.file("no/such/folder.rawlog"), {}), std::runtime_error);
  EXPECT_THROW(writeScansRawlog("/dev/full", observations(50, 361)), std::runtime_error);
}

TEST_F(Rawlog, ReadsActionsAndSensoryFrames) {
  const auto scans = observations(9);
  ASSERT_TRUE(actionLog(scans).saveToRawLogFile(path_));
  EXPECT_TRUE(test::sameScans(loadRawlog(path_), converted(scans)));
}

TEST_F(Rawlog, ReadsAWholeRawlogStoredAsOneObject) {
  const auto scans = observations(5);
  auto log = actionLog(scans);
  EXPECT_EQ(errorOf(test::serialised(log)), "");
  EXPECT_TRUE(test::sameScans(loadRawlog(path_), converted(scans)));
}

TEST_F(Rawlog, PassesOverCommentsAndOtherObservations) {
  const auto scans = observations(2);
  mrpt::obs::CObservationComment comment;
  comment.text = "hello";
  const std::string bytes = test::serialised(comment) + test::serialised(scans[0]) +
                            test::serialised(mrpt::obs::CObservationOdometry()) +
                            test::serialised(scans[1]);
  EXPECT_EQ(errorOf(bytes), "");
  EXPECT_TRUE(test::sameScans(loadRawlog(path_), converted(scans)));
  EXPECT_EQ(errorOf(test::gzipped(bytes)), "");
  EXPECT_TRUE(test::sameScans(loadRawlog(path_), converted(scans)));
}

TEST_F(Rawlog, TellsSensorsApart) {
  auto scans = observations(4, 10, "front");
  scans[1].sensorLabel = "rear";
  scans[2].sensorLabel = "";
  scans[1].sensorPose.setYawPitchRoll(0, 0, 1);  // tilted, which matters only if it is chosen
  const std::string bytes = bytesOf(scans);
  EXPECT_THAT(errorOf(bytes), AllOf(HasSubstr("several sensors"), HasSubstr("'front' (2"),
                                    HasSubstr("'rear' (1"), HasSubstr("'' (1")));
  EXPECT_THAT(errorOf(bytes, "top"), AllOf(HasSubstr("'top'"), HasSubstr("'front' (2")));
  EXPECT_THAT(errorOf(bytes, "rear"),
              AllOf(HasSubstr("test.rawlog: object 1"), HasSubstr("tilted")));
  EXPECT_EQ(errorOf(bytes, "front"), "");
  EXPECT_TRUE(
      test::sameScans(loadRawlog(path_, test::ofSensor("front")), converted({scans[0], scans[3]})));
}

TEST_F(Rawlog, NamesAnUnknownClassAndItsObject) {
  const auto scans = observations(3);
  std::string foreign = test::serialised(scans[1]);
  foreign.replace(foreign.find("2DRange"), 7, "9DRange");
  EXPECT_THAT(errorOf(test::serialised(scans[0]) + foreign + test::serialised(scans[2])),
              AllOf(HasSubstr("test.rawlog: object 1"), HasSubstr("CObservation9DRangeScan"),
                    HasSubstr("not registered")));
}

TEST_F(Rawlog, RefusesForeignAndEmptyFiles) {
  EXPECT_THAT(errorOf(""), HasSubstr("empty file"));
  EXPECT_THAT(errorOf(test::gzipped("")), HasSubstr("empty file"));
  EXPECT_THAT(errorOf("FLASER 3 1 2 3"), HasSubstr("object 0"));
  EXPECT_THAT(errorOf(test::gzipped(std::string(5000, 'x'))), HasSubstr("object 0"));
  EXPECT_THAT(errorOf(std::string(5000, '\0')), HasSubstr("object 0"));
  EXPECT_THAT(errorOf("\x89PNG\r\n\x1a\n"), HasSubstr("object 0"));
  EXPECT_THAT(errorOf(test::serialised(mrpt::maps::CSimpleMap())), HasSubstr("no 2D laser scan"));
  EXPECT_THAT(errorOf(test::serialised(mrpt::obs::CObservationOdometry())),
              HasSubstr("no 2D laser scan"));
  EXPECT_THAT(formatErrorOf([&] { loadRawlog(dir_.file("missing.rawlog")); }),
              HasSubstr("missing.rawlog: no such file"));
  EXPECT_THAT(formatErrorOf([&] { loadRawlog(dir_.file("")); }), HasSubstr("is a directory"));
}

// MRPT's own loader returns the scans before the cut as if they were all.
TEST_F(Rawlog, RefusesEveryTruncationOfAGzippedFile) {
  const std::string whole = test::gzipped(bytesOf(observations(3, 5)));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string message = errorOf(whole.substr(0, size));
    ASSERT_THAT(message, HasSubstr("test.rawlog: ")) << "cut to " << size << " bytes";
    if (size >= 2) {
      ASSERT_THAT(message, AllOf(HasSubstr("byte "), HasSubstr("truncated"))) << size;
    }
  }
  EXPECT_EQ(errorOf(whole), "");
}

TEST_F(Rawlog, RefusesEveryTruncationOfAPlainFileButBetweenObjects) {
  const auto scans = observations(2, 5);
  std::string whole;
  std::set<std::size_t> borders;
  for (const auto& scan : scans) {
    whole += test::serialised(scan);
    borders.insert(whole.size());
  }
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const std::string message = errorOf(whole.substr(0, size));
    if (borders.count(size) == 1) {
      ASSERT_EQ(message, "") << size;
    } else if (size > 0) {
      const auto object =
          static_cast<std::size_t>(std::distance(borders.begin(), borders.lower_bound(size)));
      ASSERT_THAT(message, HasSubstr("object " + std::to_string(object))) << size;
    }
  }
}

TEST_F(Rawlog, FindsDamageOfAGzippedFile) {
  const auto scans = observations(6, 40);
  const auto expected = converted(scans);
  const std::string whole = test::gzipped(bytesOf(scans));
  int refused = 0;
  for (int repeat = 0; repeat < 300; ++repeat) {
    std::string bytes = whole;
    const std::size_t at = random_() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + random_() % 255));
    const std::string message = errorOf(bytes);
    if (message.empty()) {
      ASSERT_TRUE(test::sameScans(loadRawlog(path_), expected)) << "byte " << at;
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 285);  // all but those in the unused bytes of the header
}

TEST_F(Rawlog, FindsABadTrailerAndTrailingBytes) {
  const std::string whole = test::gzipped(bytesOf(observations(2)));
  for (std::size_t back = 1; back <= 8; ++back) {
    std::string bytes = whole;
    bytes[bytes.size() - back] = static_cast<char>(~bytes[bytes.size() - back]);
    EXPECT_THAT(errorOf(bytes), HasSubstr("damaged")) << back;
  }
  EXPECT_THAT(errorOf(whole + "garbage"), HasSubstr("damaged"));
}

TEST_F(Rawlog, ReadsConcatenatedGzipFiles) {
  const auto first = observations(3), second = observations(2);
  EXPECT_EQ(errorOf(test::gzipped(bytesOf(first)) + test::gzipped(bytesOf(second))), "");
  EXPECT_EQ(loadRawlog(path_).size(), 5U);
}

// Robots lose power: what is whole is used, and what is missing is told.
TEST_F(Rawlog, ReadsTheWholePartOfAFileThatIsCutShort) {
  const auto scans = observations(4, 5);
  const std::string bytes = bytesOf(scans);
  for (const bool zipped : {false, true}) {
    const std::string whole = zipped ? test::gzipped(bytes) : bytes;
    std::size_t cut_files = 0;
    for (std::size_t size = 30; size < whole.size(); ++size) {
      test::writeFile(path_, whole.substr(0, size));
      Notes notes;
      std::vector<RangeScan> read;
      if (!formatErrorOf([&] { read = loadRawlog(path_, {}, &notes); }).empty()) continue;
      std::vector<RangeScan> expected = converted(scans);
      ASSERT_LE(read.size(), expected.size());
      expected.erase(expected.begin() + static_cast<std::ptrdiff_t>(read.size()), expected.end());
      ASSERT_TRUE(test::sameScans(read, expected)) << size;
      if (notes.empty()) {
        ASSERT_FALSE(zipped) << size;  // a cut between two objects of a plain file
        continue;
      }
      ASSERT_THAT(notes, ElementsAre(AllOf(HasSubstr("cut short"), HasSubstr("--strict"),
                                           HasSubstr(std::to_string(read.size()) + " objects"))));
      ++cut_files;
    }
    EXPECT_GT(cut_files, whole.size() / 2) << zipped;
  }
}

// Without a checksum damage of a value passes; nothing may crash or print.
TEST_F(Rawlog, SurvivesDamageOfAPlainFile) {
  const auto scans = observations(3);
  const std::string whole = bytesOf(scans);
  int refused = 0;
  for (int repeat = 0; repeat < 300; ++repeat) {
    std::string bytes = whole;
    const std::size_t at = random_() % bytes.size();
    // The three high bytes of the number of beams are left out: gigabytes would be allocated.
    const std::size_t beams = bytes.rfind(std::string("\x0c\0\0\0", 4), at);
    if (beams != std::string::npos && at - beams < 4) continue;
    bytes[at] = static_cast<char>(random_());
    refused += errorOf(bytes).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 15);
}

}  // namespace
}  // namespace mrpt_polyloc
