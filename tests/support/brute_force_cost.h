#pragma once

#include "tests/support/BruteForceRays.h"
#include <mrpt_polyloc/localization/GlobalLocalizerParams.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mrpt_polyloc::test {

/// The search cost, by rays cast against every edge in double.
class BruteForceCost {
 public:
  BruteForceCost(const PolygonMap& map, const RangeScan& scan,
                 SearchMetric metric = SearchMetric::robust, double horizon = 20.0)
      : rays_(map, horizon),
        beams_(BandQuery(scan, GlobalLocalizerParams{}.search_cost, metric).beams),
        cost_(GlobalLocalizerParams{}.search_cost),
        metric_(metric) {}

  double operator()(const mrpt::math::TPose2D& pose_map_beams) const {
    double sum = 0.0;
    for (const Beam& beam : beams_) {
      const RayHit hit =
          rays_.cast({pose_map_beams.x, pose_map_beams.y}, pose_map_beams.phi + beam.bearing);
      if (metric_ == SearchMetric::polar) {
        const double reach = 127.5;
        const double off = std::min(hit.wall, reach) - std::min(beam.range, reach);
        sum += off * off;
        continue;
      }
      sum += static_cast<double>(
          cost_(beam, static_cast<float>(hit.wall), static_cast<float>(hit.open)));
    }
    const double mean = sum / static_cast<double>(beams_.size());
    return metric_ == SearchMetric::polar ? std::sqrt(mean) : mean;
  }

 private:
  BruteForceRays rays_;
  std::vector<Beam> beams_;
  RobustCost cost_;
  SearchMetric metric_;
};

}  // namespace mrpt_polyloc::test
