#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/carmen.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using test::formatErrorOf;
using testing::AllOf;
using testing::HasSubstr;

std::string repeated(const std::string& word, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + word;
  return text;
}

std::string flaser(std::size_t beams, const std::string& range = "2.5",
                   const std::string& tail = "12.5 host 13.5") {
  return "FLASER " + std::to_string(beams) + " " + repeated(range, beams) +
         (beams == 0 ? "" : " ") + "1 2 0.5 1 2 0.5 " + tail + "\n";
}

class Carmen : public test::QuietTest {
 protected:
  std::vector<RangeScan> load(const std::string& text, const ScanFileOptions& options = {}) {
    test::writeFile(path_, text);
    return loadCarmen(path_, options);
  }
  std::string errorOf(const std::string& text, ScanFileOptions options = {}) {
    options.strict = true;
    return formatErrorOf([&] { load(text, options); });
  }
  void expectAngles(const RangeScan& scan, double first_deg, double last_deg) {
    EXPECT_NEAR(scan.beams().front().bearing, first_deg * kDegree, 1e-9);
    EXPECT_NEAR(scan.beams().back().bearing, last_deg * kDegree, 1e-9);
  }

  std::string path_ = dir_.file("test.log");
};

TEST_F(Carmen, FlaserOfAKnownNumberOfBeamsStartsAtMinus90) {
  expectAngles(load(flaser(180))[0], -90, 89);
  expectAngles(load(flaser(181))[0], -90, 90);
  expectAngles(load(flaser(360))[0], -90, 89.5);
  expectAngles(load(flaser(361))[0], -90, 90);
}

TEST_F(Carmen, FlaserOfAnotherNumberOfBeamsAsksForTheFieldOfView) {
  EXPECT_THAT(
      errorOf("# a log\n" + flaser(200)),
      AllOf(HasSubstr("test.log: line 2: "), HasSubstr("200 beams"), HasSubstr("--laser-fov")));
  ScanFileOptions options;
  options.laser_fov = 270 * kDegree;
  expectAngles(load(flaser(541), options)[0], -135, 135);
  expectAngles(load("PARAM laser_front_laser_resolution 1.0 0 h 0\n" + flaser(181), options)[0],
               -135, 135);
}

TEST_F(Carmen, FlaserTakesTheResolutionThatTheLogStates) {
  const auto param = [](const std::string& value) {
    return "PARAM laser_front_laser_resolution " + value + " 0 nohost 0\n";
  };
  expectAngles(load(param("1.0") + flaser(180))[0], -90, 89);
  expectAngles(load(param("1") + flaser(181))[0], -90, 90);
  expectAngles(load(param("0.5") + flaser(181))[0], -45, 45);
  expectAngles(load(param("0.25") + flaser(720))[0], -90, 89.75);
  expectAngles(load(flaser(541) + param("0.5"))[0], -135, 135);  // it holds for the whole log
  EXPECT_THAT(errorOf(param("1") + flaser(500)), HasSubstr("full turn"));
  EXPECT_THAT(errorOf(param("0") + flaser(180)), HasSubstr("line 1: "));
  EXPECT_THAT(errorOf(param("abc") + flaser(180)), HasSubstr("line 1: "));
}

TEST_F(Carmen, RefusesAFieldOfViewOutOfRange) {
  for (const double fov : {0.0, -1.0, 7.0, std::nan("")}) {
    ScanFileOptions options;
    options.laser_fov = fov;
    EXPECT_THROW(load(flaser(180), options), InvalidParamsError);
  }
}

TEST_F(Carmen, OneBeamAndNoBeamAreScans) {
  const auto scans = load(flaser(1) + flaser(0));
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[0].beams()[0].bearing, 0.0);
  EXPECT_TRUE(scans[1].beams().empty());
}

TEST_F(Carmen, TellsKindsByTheMaximumRange) {
  const std::string line =
      "FLASER 180 79.9 80 81.91 0 -1 nan inf 50.5 " + repeated("1", 172) + " 0 0 0 0 0 0 1 h 1\n";
  const auto kinds = [](const RangeScan& scan) {
    std::string text;
    for (std::size_t i = 0; i < 8; ++i) {
      text += "hni"[static_cast<std::size_t>(scan.beams()[i].kind)];
    }
    return text;
  };
  EXPECT_EQ(kinds(load(line)[0]), "hhniiinh");  // infinite: nothing within what was ever read
  EXPECT_DOUBLE_EQ(load(line)[0].beams()[2].range, 81.91);
  EXPECT_EQ(kinds(load("PARAM robot_front_laser_max 50 0 h 0\n" + line)[0]), "nnniiinn");
  EXPECT_EQ(kinds(load("PARAM laser_front_max_range 81.9 0 h 0\n" + line)[0]), "hhniiinh");
  EXPECT_THAT(errorOf("PARAM robot_front_laser_max -1 0 h 0\n" + line), HasSubstr("line 1"));
}

TEST_F(Carmen, TakesTheLasersPlaceAndTheMessagesTime) {
  const auto scans = load("PARAM robot_frontlaser_offset 0.3 0 h 0\n" + flaser(180) +
                          flaser(180, "1", "0 h 13.5"));
  EXPECT_EQ(scans[0].sensor().x, 0.3);
  EXPECT_EQ(scans[0].sensor().y, 0.0);
  EXPECT_EQ(scans[0].stamp(), 12.5);
  EXPECT_EQ(scans[1].stamp(), 13.5);
  EXPECT_EQ(scans[0].label(), "FLASER");
}

std::string robotLaser(const std::string& head, const std::string& readings,
                       const std::string& poses = "1 1 1.5707963267948966 1 0.5 1.5707963267948966",
                       const std::string& tail = "0 0 0.1 0.1 1e6 99.5 h 100.5") {
  return "ROBOTLASER1 " + head + " " + readings + " " + poses + " " + tail + "\n";
}

TEST_F(Carmen, ReadsRobotLaser) {
  const auto scans =
      load(robotLaser("0 -1.0 2.0 0.5 30 0.01 0", "5 1 2 3 30 31 2 7 8") + "ODOM 1 2 3\n" +
           robotLaser("0 -1.0 2.0 0.0 0 0.01 0", "3 1 2 80 0", "1 1 0.25 1 0 0"));
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[0].label(), "ROBOTLASER1");
  EXPECT_EQ(scans[0].stamp(), 99.5);
  EXPECT_NEAR(scans[0].sensor().x, 0.5, 1e-12);  // ahead of a robot that looks along y
  EXPECT_NEAR(scans[0].sensor().y, 0.0, 1e-12);
  ASSERT_EQ(scans[0].beams().size(), 5U);
  EXPECT_NEAR(scans[0].beams()[0].bearing, -1.0, 1e-12);
  EXPECT_NEAR(scans[0].beams()[2].bearing, 0.0, 1e-12);
  EXPECT_EQ(scans[0].beams()[2].kind, BeamKind::hit);
  EXPECT_EQ(scans[0].beams()[3].kind, BeamKind::no_return);
  EXPECT_EQ(scans[0].beams()[4].range, 30.0);

  EXPECT_NEAR(scans[1].sensor().x, 0.0, 1e-12);
  EXPECT_NEAR(scans[1].sensor().y, 1.0, 1e-12);
  EXPECT_NEAR(scans[1].beams()[0].bearing, -0.75, 1e-12);
  EXPECT_NEAR(scans[1].beams()[1].bearing, 0.25, 1e-12);  // no resolution: from the field of view
  EXPECT_EQ(scans[1].beams()[2].kind, BeamKind::hit);     // no maximum range is said
}

TEST_F(Carmen, RobotLaserTurnsTheSameWayAcrossPi) {
  const auto scan = load(robotLaser("0 0 1 0.5 30 0.01 0", "2 1 2 0", "0 0 -3.1 0 0 3.1"))[0];
  EXPECT_NEAR(scan.beams()[0].bearing, 2 * (kPi - 3.1), 1e-12);
}

TEST_F(Carmen, RefusesBadRobotLasers) {
  const std::string head = "0 -1.0 2.0 0.5 30 0.01 0";
  EXPECT_THAT(errorOf(robotLaser(head, "2 1 2 0", "9 9 0 0 0 0")), HasSubstr("more than 5 m"));
  EXPECT_THAT(errorOf(robotLaser("0 -1.0 0 0 30 0.01 0", "2 1 2 0")), HasSubstr("are 0"));
  EXPECT_THAT(errorOf(robotLaser("0 nan 0 0 30 0.01 0", "2 1 2 0")), HasSubstr("start angle"));
  EXPECT_THAT(errorOf(robotLaser(head, "3 1 2 0")), HasSubstr("line 1: "));
  EXPECT_THAT(errorOf(robotLaser(head, "2 1 2 3 1 1")), HasSubstr("line 1: "));
}

TEST_F(Carmen, RefusesEveryTruncationOfALineBetweenItsFields) {
  for (const std::string& line :
       {flaser(180), robotLaser("0 -1.0 2.0 0.5 30 0.01 0", "4 1 2 3 4 2 7 8")}) {
    const std::string before = flaser(180) + "ODOM 0 0 0 0 0 0 1 h 1\n";
    for (std::size_t blank = line.find(' '); blank != std::string::npos;
         blank = line.find(' ', blank + 1)) {
      ASSERT_THAT(errorOf(before + line.substr(0, blank), test::ofSensor("FLASER")),
                  AllOf(HasSubstr("test.log: line 3: "), HasSubstr("truncated")))
          << line.substr(0, blank);
    }
  }
}

TEST_F(Carmen, ReadsTheWholePartOfALogThatIsCutShort) {
  const std::string line = flaser(180), text = line + line + line;
  std::size_t cut_files = 0;
  for (std::size_t size = line.size(); size < text.size() - 1; size += 5) {
    Notes notes;
    test::writeFile(path_, text.substr(0, size));
    const std::size_t whole = loadCarmen(path_, {}, &notes).size();
    if (notes.front().find("cut short") == std::string::npos) continue;
    ASSERT_EQ(whole, size / line.size()) << size;
    ASSERT_THAT(notes.front(),
                AllOf(HasSubstr("line " + std::to_string(whole + 1) + ":"), HasSubstr("--strict")))
        << size;
    ++cut_files;
  }
  EXPECT_GT(cut_files,
            (2 * line.size() - 30) / 5);  // all but those in the last number or between lines
  EXPECT_THAT(errorOf(text.substr(0, text.size() - 30)), HasSubstr("line 3: truncated"));
  // In the middle it is damage.
  EXPECT_THAT(formatErrorOf([&] { load(line + "FLASER 3 1 2\n" + line); }), HasSubstr("line 2: "));
}

std::string rawLaser(const std::string& keyword, const std::string& readings) {
  return keyword + " 0 -1.0 2.0 0.5 30 0.01 0 " + readings + " 7.5 h 8.5\n";
}

TEST_F(Carmen, ReadsRawLaserAndRearLaserWhereThereIsNoOther) {
  const std::string offsets =
      "PARAM robot_frontlaser_offset 0.2 0 h 0\nPARAM robot_rearlaser_offset -0.1 0 h 0\n";
  const RangeScan front = load(rawLaser("RAWLASER1", "3 1 2 30 0") + offsets)[0];
  EXPECT_EQ(front.sensor().x, 0.2);
  EXPECT_EQ(front.stamp(), 7.5);
  EXPECT_NEAR(front.beams()[0].bearing, -1.0, 1e-12);
  EXPECT_EQ(front.beams()[1].range, 2.0);
  EXPECT_EQ(front.beams()[2].kind, BeamKind::no_return);
  EXPECT_EQ(load(rawLaser("RAWLASER1", "2 1 2 2 9 9"))[0].hitCount(), 2U);  // with remissions

  std::string rear_line = flaser(180);
  rear_line.front() = 'R';
  const RangeScan rear = load(offsets + rear_line)[0];
  EXPECT_EQ(rear.sensor().x, -0.1);
  EXPECT_NEAR(rear.beams()[0].bearing, kPi / 2, 1e-12);
  EXPECT_EQ(rear.label(), "RLASER");

  // They repeat what FLASER and ROBOTLASER1 say, or are of another laser.
  const std::string both = rawLaser("RAWLASER1", "2 1 2 0") + rear_line + flaser(180);
  EXPECT_EQ(load(both).size(), 1U);
  EXPECT_EQ(load(both, test::ofSensor("RLASER"))[0].label(), "RLASER");
  EXPECT_EQ(load(both, test::ofSensor("RAWLASER1"))[0].label(), "RAWLASER1");
  EXPECT_THAT(errorOf(rawLaser("RAWLASER1", "2 1 2 1")), HasSubstr("line 1: "));
}

TEST_F(Carmen, RefusesWrongCountsAndWhatIsNoNumber) {
  std::string line = flaser(180);
  EXPECT_THAT(errorOf(line.substr(0, line.size() - 1) + " 7\n"), HasSubstr("number of readings"));
  line.replace(line.find("180"), 3, "179");
  EXPECT_THAT(errorOf(line), AllOf(HasSubstr("line 1: "), HasSubstr("number of readings")));
  line.replace(line.find("179"), 3, "181");
  EXPECT_THAT(errorOf(line), AllOf(HasSubstr("line 1: "), HasSubstr("truncated")));
  line.replace(line.find("181"), 3, "-18");
  EXPECT_THAT(errorOf(line), HasSubstr("whole number"));
  line.replace(line.find("-18"), 3, "1e9");
  EXPECT_THAT(errorOf(line), HasSubstr("truncated"));
  EXPECT_THAT(errorOf(flaser(180, "2,5")), AllOf(HasSubstr("line 1: "), HasSubstr("reading 0")));
  EXPECT_THAT(errorOf(flaser(180, "1", "x h 1")), HasSubstr("ipc timestamp"));
}

TEST_F(Carmen, TellsSensorsApart) {
  const std::string both =
      flaser(180) + robotLaser("0 -1.0 2.0 0.5 30 0.01 0", "2 1 2 0") + flaser(180);
  EXPECT_THAT(errorOf(both), AllOf(HasSubstr("'FLASER' (2"), HasSubstr("'ROBOTLASER1' (1")));
  EXPECT_EQ(load(both, test::ofSensor("FLASER")).size(), 2U);
  EXPECT_EQ(load(both, test::ofSensor("ROBOTLASER1")).size(), 1U);
  EXPECT_THAT(errorOf(both, test::ofSensor("RLASER")), HasSubstr("'RLASER'"));
}

TEST_F(Carmen, ReadsOtherLineEndsAndGzip) {
  std::string text = "# comment\r\n\r\n  " + flaser(180);
  text.insert(text.size() - 1, "\r");
  text += flaser(180);
  text.pop_back();  // no end of the last line
  EXPECT_EQ(load(text).size(), 2U);
  EXPECT_EQ(load(test::gzipped(text)).size(), 2U);
}

TEST_F(Carmen, RefusesFilesWithoutScansAndTruncatedGzip) {
  EXPECT_THAT(errorOf(""), HasSubstr("empty file"));
  EXPECT_THAT(errorOf("ODOM 0 0 0 0 0 0 1 h 1\n"), HasSubstr("no 2D laser scan"));
  EXPECT_THAT(errorOf(std::string("\x01\x02\0\xff binary", 12)), HasSubstr("no 2D laser scan"));
  const std::string whole = test::gzipped(flaser(180) + flaser(180, "3"));
  for (std::size_t size = 2; size < whole.size(); ++size) {
    ASSERT_THAT(errorOf(whole.substr(0, size)), HasSubstr("truncated")) << size;
  }
}

}  // namespace
}  // namespace mrpt_polyloc
