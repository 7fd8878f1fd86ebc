#include "EvaluationOptions.h"

#include "../common/parsing.h"
#include <mrpt_polyloc/evaluation/truth.h>

namespace mrpt_polyloc::apps {

void addEvaluationOptions(CLI::App& cli, EvaluationOptions& options) {
  options.search.max_hypotheses = 50;
  addSearchOptions(cli, options.search);
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
  inputs.scans = loadSearchedScans(program, options.search);
  inputs.truth = matchTruth(inputs.scans, loadTum(options.truth), options.truth);
  if (!options.good.empty()) inputs.good = loadRows(options.good, inputs.scans.size());
  return inputs;
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
