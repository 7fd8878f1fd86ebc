// Logs as robots really send them: the cases of the evaluation data, each of which was once read
// wrongly.
#include "tests/support/bridge_files.h"
#include "tests/support/data_dir.h"
#include <mrpt_polyloc/io/scan_files.h>

#include <gmock/gmock.h>

#include <cmath>

namespace mrpt_polyloc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::size_t countOf(const std::vector<RangeScan>& scans, BeamKind kind) {
  std::size_t count = 0;
  for (const RangeScan& scan : scans) {
    for (const Beam& beam : scan.beams()) count += beam.kind == kind ? 1 : 0;
  }
  return count;
}

/// Share of the beams of two logs that are of the same kind.
double alike(const std::vector<RangeScan>& a, const std::vector<RangeScan>& b) {
  std::size_t same = 0, all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].beams().size(); ++k) {
      same += a[i].beams()[k].kind == b.at(i).beams().at(k).kind ? 1 : 0;
      ++all;
    }
  }
  return static_cast<double>(same) / static_cast<double>(all);
}

TEST(Cases, AMaximumRangeThatIsUnsaidOrRounded) {
  POLYLOC_DATA_OR_SKIP(data);
  const std::string folder = data + "/cases/03-carmen-max-range-unsaid/";
  Notes notes;
  const auto unsaid = loadScans(folder + "scans.log.gz", {}, &notes);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("taken for 8.19 m")));
  for (const char* name : {"with_param.log.gz", "with_param_rounded.log.gz"}) {
    notes.clear();
    const auto said = loadScans(folder + name, {}, &notes);
    EXPECT_THAT(notes, IsEmpty());
    EXPECT_GT(alike(said, unsaid), 0.999);
  }
}

TEST(Cases, NoReturnsJustBelowTheMaximumOrInfinite) {
  POLYLOC_DATA_OR_SKIP(data);
  for (const char* name : {"04-reading-just-below-max-range", "08-infinity-is-no-return"}) {
    const std::string folder = data + "/cases/" + name + "/";
    EXPECT_TRUE(sameScans(loadScans(folder + "scans.rawlog"), loadScans(folder + "plain.rawlog")));
  }
}

TEST(Cases, AMaskedSectorSaysNothing) {
  POLYLOC_DATA_OR_SKIP(data);
  const std::string folder = data + "/cases/05-excluded-sector-taken-for-no-return/";
  const auto masked = loadScans(folder + "scans.rawlog");
  EXPECT_TRUE(sameScans(masked, loadScans(folder + "zero.rawlog")));
  EXPECT_EQ(countOf(masked, BeamKind::invalid), masked.size() * 120);
}

TEST(Cases, LasersUpsideDownAndTilted) {
  POLYLOC_DATA_OR_SKIP(data);
  const std::string folder = data + "/cases/06-upside-down-laser/";
  const auto upright = loadScans(folder + "upright.rawlog");
  // Stored with its sweep reversed, so that beam by beam they are the same.
  EXPECT_TRUE(sameScans(loadScans(folder + "scans.rawlog"), upright));
  const std::string tilted = data + "/cases/07-pitch-of-a-tenth-degree/";
  for (const char* name : {"scans.rawlog", "half_degree.rawlog"}) {
    Notes notes;
    const auto scans = loadScans(tilted + name, {}, &notes);
    EXPECT_EQ(countOf(scans, BeamKind::hit), countOf(upright, BeamKind::hit)) << name;
    EXPECT_THAT(notes, IsEmpty());
  }
}

TEST(Cases, LogsCutShortAndRawLaser) {
  POLYLOC_DATA_OR_SKIP(data);
  for (const char* name : {"cut.rawlog", "cut.log"}) {
    Notes notes;
    EXPECT_EQ(loadScans(data + "/cases/12-log-cut-short/" + name, {}, &notes).size(), 19U);
    EXPECT_THAT(notes.front(), HasSubstr("cut short"));
  }
  const auto raw = loadScans(data + "/cases/13-carmen-rawlaser-only/scans.log");
  EXPECT_EQ(raw.front().label(), "RAWLASER1");
  EXPECT_EQ(raw.front().beams().size(), 181U);
}

}  // namespace
}  // namespace mrpt_polyloc::test
