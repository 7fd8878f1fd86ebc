#pragma once

#include "ProgramTest.h"
#include <mrpt_polyloc/io/rawlog_writer.h>

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {

inline const char* const kHeader =
    "row,stamp,status,rank,x,y,phi_deg,weight,cost,std_x,std_y,std_phi_deg,ms,match,listed,cov_xy";

constexpr std::size_t kColumns = 16, kTimeColumn = 12;

/// CSV without the time.
inline std::string withoutTimes(const std::string& csv) {
  std::string rest;
  for (const std::string& line : linesOf(csv)) {
    std::vector<std::string> fields = fieldsOf(line);
    if (fields.size() > kTimeColumn) fields[kTimeColumn].clear();
    for (const std::string& field : fields) rest += field + ",";
    rest += "\n";
  }
  return rest;
}

class PolylocLocalize : public ProgramTest {
 protected:
  Outcome localize(const std::vector<std::string>& more,
                   const std::string& scans = "sim/scans.rawlog") const {
    std::vector<std::string> arguments = {"--map", roomFile(), "--scans", path(scans)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-localize", arguments);
  }

  /// The fields of the rows of rank 1, by row.
  static std::map<int, std::vector<std::string>> firstAnswers(const std::string& csv) {
    std::map<int, std::vector<std::string>> answers;
    const std::vector<std::string> lines = linesOf(csv);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> fields = fieldsOf(lines[i]);
      if (fields[3] == "1") answers[std::stoi(fields[0])] = fields;
    }
    return answers;
  }

  /// A rawlog of scans with so many beams each.
  std::string scansOfBeams(const std::vector<std::size_t>& counts) const {
    std::vector<mrpt::obs::CObservation2DRangeScan> scans;
    for (const std::size_t count : counts) {
      mrpt::obs::CObservation2DRangeScan scan;
      scan.sensorLabel = "LASER";
      scan.timestamp = mrpt::Clock::fromDouble(1e9 + static_cast<double>(scans.size()));
      scan.aperture = count > 1 ? 3.0f : 0.0f;
      scan.maxRange = 20.0f;
      scan.resizeScanAndAssign(count, 1.5f, true);
      scans.push_back(scan);
    }
    writeScansRawlog(path("few.rawlog"), scans);
    return "few.rawlog";
  }
};

}  // namespace mrpt_polyloc::test
