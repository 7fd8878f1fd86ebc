#include "EvaluationOptions.h"

#include "../common/parsing.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/simulated_odometry.h>
#include <mrpt_polyloc/evaluation/truth.h>

namespace mrpt_polyloc::apps {
namespace {

/// Gives a drive without movements those that wheels would have measured along the true poses.
void giveOdometry(const std::vector<mrpt::math::TPose2D>& truth, const MotionNoise& noise,
                  DriveLog& drive) {
  if (drive.has_odometry) return;
  constexpr std::uint64_t kSeed = 1;
  const std::vector<Motion> motions = simulatedOdometry(truth, noise, kSeed);
  for (std::size_t i = 1; i < motions.size(); ++i) {
    drive.moments[i].since_before = motions[i];
    drive.moments[i].is_after_gap = false;
  }
  drive.has_odometry = true;
}

}  // namespace

void addEvaluationOptions(CLI::App& cli, EvaluationOptions& options) {
  options.search.max_hypotheses = 50;
  addSearchOptions(cli, options.search);
  addSetOptions(cli, options.sets, options.search.file);
  cli.add_option_function<std::string>(
         "--odometry-noise",
         [&options](const std::string& text) { options.sets.noise = parseMotionNoise(text); },
         "Errors of the odometry that is made from the truth where the log holds none, for "
         "--accumulate: m a metre, deg a metre, deg a radian [default: 0.02,1,2]")
      ->type_name("A,B,C");
  addText(cli, "--truth", options.truth, "True poses of the robot, one a scan, matched by stamp")
      ->required()
      ->type_name("TRUTH.tum");
  addText(cli, "--good", options.good, "Rows to be summed up apart, one a line")->type_name("FILE");
  cli.add_option_function<std::string>(
         "--tolerance",
         [&options](const std::string& text) { options.tolerance = parseTolerance(text); },
         "What still counts as right, m and deg [default: 0.3,5]")
      ->type_name("M,DEG");
}

EvaluationInputs loadInputs(const Program& program, const EvaluationOptions& options) {
  EvaluationInputs inputs;
  inputs.sets = options.sets;
  if (options.sets.areAsked(options.search.file)) {
    inputs.drive = loadSearchedDrive(program, options.search, options.sets);
  }
  inputs.scans =
      inputs.drive ? firstScans(*inputs.drive) : loadSearchedScans(program, options.search);
  inputs.truth = matchTruth(inputs.scans, loadTum(options.truth), options.truth);
  if (inputs.drive) giveOdometry(inputs.truth, options.sets.noise, *inputs.drive);
  if (!options.good.empty()) inputs.good = loadRows(options.good, inputs.scans.size());
  return inputs;
}

DriveLog loadDriveOf(const Program& program, const EvaluationOptions& options,
                     const std::vector<mrpt::math::TPose2D>& truth) {
  DriveLog drive = loadSearchedDrive(program, options.search, options.sets);
  if (drive.moments.size() != truth.size()) {
    throw FormatError(options.search.scans, "",
                      std::to_string(drive.moments.size()) + " moments of a drive in " +
                          std::to_string(truth.size()) + " rows");
  }
  giveOdometry(truth, options.sets.noise, drive);
  return drive;
}

ScanRecord scoreLocalized(const LocalizedScan& scan, const mrpt::math::TPose2D& truth,
                          const Tolerance& tolerance) {
  const std::vector<Hypothesis>& hypotheses = scan.result.hypotheses;
  ScanRecord record{scan.row, scan.stamp,       truth, scoreScan(scan.result, truth, tolerance),
                    {},       hypotheses.size()};
  record.score.ms = scan.ms;
  if (!hypotheses.empty()) record.answer = hypotheses.front();
  return record;
}

}  // namespace mrpt_polyloc::apps
