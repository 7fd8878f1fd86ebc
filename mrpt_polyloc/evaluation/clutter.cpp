#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/clutter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr double kNearest = 0.02;  // [m]: a range of 0 would be invalid

/// Least and greatest bearing of the beams that say something; they span the field of view.
std::pair<double, double> bearingSpan(const std::vector<Beam>& beams) {
  std::pair<double, double> span{std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()};
  for (const Beam& beam : beams) {
    if (beam.kind == BeamKind::invalid) continue;
    span.first = std::min(span.first, beam.bearing);
    span.second = std::max(span.second, beam.bearing);
  }
  return span;
}

void putOccluder(std::vector<Beam>& beams, const std::pair<double, double>& span, Random& random) {
  const double center = random.uniform(span.first, span.second);
  const double half_width = 0.5 * random.uniform(8.0, 19.0) * kDegree;
  const double share = random.uniform(0.2, 0.9);
  double nearest = std::numeric_limits<double>::infinity(), middle = 0.0;
  for (const Beam& beam : beams) {
    const double off = angleBetween(beam.bearing, center);
    if (beam.kind == BeamKind::invalid || off >= nearest) continue;
    nearest = off;
    middle = beam.range;
  }
  const double range = std::max(share * middle, kNearest);
  for (Beam& beam : beams) {
    if (beam.kind == BeamKind::invalid || beam.range <= range) continue;
    if (angleBetween(beam.bearing, center) > half_width) continue;
    beam.range = range;
    beam.kind = BeamKind::hit;
  }
}

}  // namespace

void Clutter::check() const {
  requireInRange("short_beams", short_beams, 0.0, 1.0);
  requireInRange("occluders_a_circle", occluders_a_circle, 0.0, 1000.0);
}

RangeScan withClutter(const RangeScan& scan, const Clutter& clutter, std::uint64_t seed) {
  clutter.check();
  Random random(seed);
  std::vector<Beam> beams = scan.beams();
  for (Beam& beam : beams) {
    // Both numbers are drawn for every beam, so that a beam's fate does not hang on the others'.
    const double lot = random.unit(), share = random.unit();
    if (beam.kind != BeamKind::hit || lot >= clutter.short_beams) continue;
    beam.range = std::min(beam.range, std::max(share * beam.range, kNearest));
  }
  const std::pair<double, double> span = bearingSpan(beams);
  if (span.second >= span.first) {
    const double circles = (span.second - span.first) / kTwoPi;
    const auto occluders = std::lround(clutter.occluders_a_circle * circles);
    for (long i = 0; i < occluders; ++i) putOccluder(beams, span, random);
  }
  return RangeScan(std::move(beams), scan.sensor(), scan.stamp(), scan.label());
}

}  // namespace mrpt_polyloc
