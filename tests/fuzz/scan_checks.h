#pragma once

#include "fuzz_target.h"
#include <mrpt_polyloc/io/scan_files.h>

#include <cmath>
#include <vector>

namespace mrpt_polyloc::fuzz {

/// Reads a log whole, and strictly: whatever strict reading takes, the other takes, too.
inline void checkLog(const std::string& path) {
  Notes notes;
  const std::vector<RangeScan> scans = loadScans(path, {}, &notes);
  must(!scans.empty(), "a log has scans, or is refused");
  for (const RangeScan& scan : scans) {
    for (const Beam& beam : scan.beams()) {
      must(beam.kind == BeamKind::invalid || (std::isfinite(beam.range) && beam.range > 0.0),
           "a beam that says something has a range");
    }
  }
  ScanFileOptions strict;
  strict.strict = true;
  must(loadScans(path, strict, &notes).size() == scans.size(), "strict reading finds the same");
}

}  // namespace mrpt_polyloc::fuzz
