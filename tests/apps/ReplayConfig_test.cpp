#include "ProgramTest.h"
#include <mrpt_polyloc/base/errors.h>

#include <gmock/gmock.h>

#include <apps/polyloc-replay/ReplayConfig.h>
#include <filesystem>

namespace mrpt_polyloc::replay {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ReplayConfigTest : public test::ProgramTest {
 protected:
  ReplayConfig load(const std::string& text) const {
    return loadReplayConfig(write("a.ini", text));
  }
  std::string errorOf(const std::string& text) const {
    try {
      load(text);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no FormatError";
  }
};

TEST_F(ReplayConfigTest, HasTheDefaultsOfWhatItConfigures) {
  const ReplayConfig config = load("# nothing\n");
  EXPECT_EQ(config.init, Init::polyloc);
  EXPECT_EQ(config.seeds.particles, ParticleSeederParams{}.particles);
  EXPECT_EQ(config.seeds.least_per_hypothesis, ParticleSeederParams{}.least_per_hypothesis);
  EXPECT_EQ(config.recovery.share, FilterRecoveryParams{}.share);
  EXPECT_EQ(config.recovery.monitor.patience, FilterMonitorParams{}.patience);
  EXPECT_TRUE(config.recovers);
  EXPECT_EQ(config.repetitions, 1U);
  EXPECT_EQ(config.uniform_particles, 40'000U);
  EXPECT_EQ(config.odometry.min_std_xy, OdometryNoise{}.min_std_xy);
  EXPECT_NEAR(config.odometry.min_std_phi, OdometryNoise{}.min_std_phi, 1e-15);
  EXPECT_THAT(config.carried, IsEmpty());
}

TEST_F(ReplayConfigTest, ReadsEveryOption) {
  const ReplayConfig config = load(
      "[polyloc]\nmap=m.wkt\nsensor=L\nmax_range=29.5\nmin_range=0.125\ninit=uniform\nparticles="
      "7\nleast_per_hypothesis=3\n"
      "uniform_share=0.25\nmax_hypotheses=4\nodometry_noise=ini\nrecovery=no\n"
      "recovery_share=0.75\nrecovery_least_gain=0.9\nrecovery_sure_weight=0.5\nrecovery_patience="
      "8\nrecovery_accumulate=2.5\njudged_particles=11\njudged_least_hits=12\n"
      "monitor_least_steps=13\nmonitor_window=14\nmonitor_deviations=1.5\n"
      "monitor_least_deviation=0.125\nmonitor_patience=16\ncarried=3,5-9\nreport_steps=2,4-6\n"
      "[LocalizationExperiment]\nmap_file=/m.gridmap\nrawlog_file=/r.rawlog\n"
      "ground_truth_path_file=/t.txt\nrawlog_offset=21\nexperimentRepetitions=22\n"
      "particles_count=23\n3DSceneFrequency=24 // as MRPT's inis comment\n"
      "[DummyOdometryParams]\nminStdXY=0.5\nminStdPHI=90 // deg\n");
  EXPECT_EQ(config.search_map, "m.wkt");
  EXPECT_EQ(config.scans.sensor_label, "L");
  EXPECT_EQ(config.scans.readings.max_range, 29.5);
  EXPECT_EQ(config.scans.readings.min_range, 0.125);
  EXPECT_EQ(config.init, Init::uniform);
  EXPECT_EQ(config.seeds.particles, 7U);
  EXPECT_EQ(config.seeds.least_per_hypothesis, 3U);
  EXPECT_EQ(config.seeds.uniform_share, 0.25);
  EXPECT_EQ(config.recovery.max_hypotheses, 4U);
  EXPECT_TRUE(config.odometry.replaces_recorded);
  EXPECT_FALSE(config.recovers);
  EXPECT_EQ(config.recovery.share, 0.75);
  EXPECT_EQ(config.recovery.least_gain, 0.9);
  EXPECT_EQ(config.recovery.sure_weight, 0.5);
  EXPECT_EQ(config.recovery.patience, 8U);
  EXPECT_EQ(config.recovery.last_metres.length, 2.5);
  EXPECT_EQ(config.recovery.judged_particles, 11U);
  EXPECT_EQ(config.recovery.least_hits, 12U);
  EXPECT_EQ(config.recovery.monitor.least_steps, 13U);
  EXPECT_EQ(config.recovery.monitor.window, 14U);
  EXPECT_EQ(config.recovery.monitor.deviations, 1.5);
  EXPECT_EQ(config.recovery.monitor.least_deviation, 0.125);
  EXPECT_EQ(config.recovery.monitor.patience, 16U);
  ASSERT_EQ(config.carried.size(), 2U);
  EXPECT_EQ(config.carried[0].first, 3U);
  EXPECT_EQ(config.carried[0].last, 3U);
  EXPECT_EQ(config.carried[1].last, 9U);
  EXPECT_THAT(config.report_steps, ElementsAre(2, 4, 5, 6));
  EXPECT_EQ(config.map_file, "/m.gridmap");
  EXPECT_EQ(config.rawlog_file, "/r.rawlog");
  EXPECT_EQ(config.truth_file, "/t.txt");
  EXPECT_EQ(config.rawlog_offset, 21U);
  EXPECT_EQ(config.repetitions, 22U);
  EXPECT_EQ(config.uniform_particles, 23U);
  EXPECT_EQ(config.scene_frequency, 24);
  EXPECT_EQ(config.odometry.min_std_xy, 0.5);
  EXPECT_NEAR(config.odometry.min_std_phi, M_PI / 2, 1e-12);
}

TEST_F(ReplayConfigTest, NamesWhatIsNotKnownOrOutOfRange) {
  for (const char* section :
       {"polyloc", "LocalizationExperiment", "PF_options", "KLD_options", "DummyOdometryParams"}) {
    EXPECT_THAT(errorOf("[" + std::string(section) + "]\nmisspelt=1\n"),
                AllOf(HasSubstr("a.ini"), HasSubstr("[" + std::string(section) + "]"),
                      HasSubstr("'misspelt'")));
  }
  const auto bad = [&](const std::string& line) { return errorOf("[polyloc]\n" + line + "\n"); };
  EXPECT_THAT(bad("particles=3oo"), AllOf(HasSubstr("particles"), HasSubstr("'3oo'")));
  EXPECT_THAT(bad("particles=0"), HasSubstr("particles"));
  EXPECT_THAT(bad("particles=-1"), HasSubstr("particles"));
  EXPECT_THAT(bad("uniform_share=1.5"), HasSubstr("uniform_share"));
  EXPECT_THAT(bad("uniform_share=nan"), HasSubstr("uniform_share"));
  EXPECT_THAT(bad("recovery=perhaps"), HasSubstr("'perhaps'"));
  EXPECT_THAT(bad("init=anywhere"), HasSubstr("'anywhere'"));
  EXPECT_THAT(bad("odometry_noise=none"), HasSubstr("'none'"));
  EXPECT_THAT(bad("carried=9-3"), AllOf(HasSubstr("carried"), HasSubstr("9-3")));
  EXPECT_THAT(bad("report_steps=0-99999999"), HasSubstr("report_steps"));
  EXPECT_THAT(bad("monitor_window=3"), HasSubstr("window"));  // shorter than the least
  EXPECT_THAT(errorOf("[LocalizationExperiment]\nparticles_count=100 200\n"),
              AllOf(HasSubstr("particles_count"), HasSubstr("one whole number")));
  EXPECT_THAT(errorOf("[LocalizationExperiment]\nuse_3D_poses=true\n"), HasSubstr("use_3D_poses"));
  EXPECT_THAT(errorOf("[PF_options]\nBETA=half\n"),
              AllOf(HasSubstr("[PF_options]"), HasSubstr("BETA"), HasSubstr("half")));
  EXPECT_THAT(errorOf("[PF_options]\nsampleSize=many\n"), HasSubstr("sampleSize"));
  EXPECT_THAT(errorOf("[KLD_options]\nKLD_binSize_XY=hello\n"), HasSubstr("KLD_binSize_XY"));
  EXPECT_THAT(errorOf("[KLD_options]\nKLD_maxSampleSize=-3\n"), HasSubstr("KLD_maxSampleSize"));
  EXPECT_THAT(errorOf("[polyloc]\ninit=anywhere\n"),
              AllOf(HasSubstr("anywhere"), HasSubstr("polyloc")));
  EXPECT_THAT(errorOf("[PF_options]\nBETA=0.5\n"),
              AllOf(HasSubstr("[PF_options]"), HasSubstr("adaptiveSampleSize")));
  EXPECT_THROW(loadReplayConfig(path("none.ini")), FormatError);
  EXPECT_THROW(loadReplayConfig(path(".")), FormatError);
}

TEST_F(ReplayConfigTest, LooksForFilesBesideTheIniFirst) {
  write("here.rawlog", "");
  const ReplayConfig config = load(
      "[LocalizationExperiment]\nrawlog_file=here.rawlog\nmap_file=elsewhere.gridmap\n"
      "[MetricMap_polygonMap2D_00_creationOpts]\nfile=./here.rawlog\n");
  EXPECT_TRUE(fs::equivalent(config.rawlog_file, path("here.rawlog")));
  EXPECT_EQ(config.map_file, "elsewhere.gridmap");
  EXPECT_TRUE(
      fs::equivalent(config.text.read_string("MetricMap_polygonMap2D_00_creationOpts", "file", ""),
                     path("here.rawlog")));
}

TEST_F(ReplayConfigTest, TellsWhichSectionsItLeavesOut) {
  EXPECT_THAT(unreadSections(load("[polylok]\na=1\n[MetricMap]\n[polyloc]\n[PF_options]\n"
                                  "PF_algorithm=0\nresamplingMethod=0\nadaptiveSampleSize=0\n"
                                  "sampleSize=1\nBETA=1\n")),
              ElementsAre("polylok"));
}

TEST_F(ReplayConfigTest, ReadsMrptsOwnInis) {
  const fs::path folder = "/usr/share/mrpt/config_files/pf-localization";
  if (!fs::exists(folder)) GTEST_SKIP() << "mrpt-common is missing";
  const ReplayConfig config = loadReplayConfig(folder / "localization_demo.ini");
  EXPECT_EQ(config.uniform_particles, 40'000U);
  EXPECT_EQ(config.kld.KLD_maxSampleSize, 40'000U);
  EXPECT_TRUE(config.filter.adaptiveSampleSize);
  EXPECT_NEAR(config.odometry.min_std_xy, 0.1, 1e-12);
  EXPECT_NEAR(config.odometry.min_std_phi, M_PI / 90, 1e-12);
  EXPECT_THAT(unreadSections(config), IsEmpty());
  EXPECT_NO_THROW(loadReplayConfig(folder / "localization_demo_obsonly_rawlog.ini"));
}

}  // namespace
}  // namespace mrpt_polyloc::replay
