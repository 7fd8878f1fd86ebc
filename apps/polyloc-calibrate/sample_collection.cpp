#include "sample_collection.h"

#include "../common/map_input.h"
#include <mrpt_polyloc/evaluation/clutter.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace mrpt_polyloc::apps {
namespace {

/// At most so many of the rows, evenly chosen.
std::vector<std::size_t> thinned(const std::vector<std::size_t>& rows, std::size_t most) {
  if (rows.size() <= most) return rows;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(rows[i * rows.size() / most]);
  return chosen;
}

std::vector<std::size_t> allRows(const CalibrationSet& set) {
  std::vector<std::size_t> rows(set.scans.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

std::vector<std::size_t> goodRows(const CalibrationSet& set) {
  std::vector<std::size_t> rows = allRows(set);
  rows.erase(std::remove_if(rows.begin(), rows.end(), [&](std::size_t r) { return !set.good[r]; }),
             rows.end());
  return rows;
}

/// The scans of a set with clutter of five kinds, in turn: light to heavy dust and legs, few and
/// many large objects.
std::vector<RangeScan> clutteredScans(const CalibrationSet& set,
                                      const std::vector<std::size_t>& rows) {
  constexpr std::array<Clutter, 5> kKinds = {{{0.1, 0}, {0.3, 0}, {0.5, 0}, {0.0, 5}, {0.0, 10}}};
  std::vector<RangeScan> scans = set.scans;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    scans[rows[i]] = withClutter(set.scans[rows[i]], kKinds[i % kKinds.size()], rows[i]);
  }
  return scans;
}

/// What all samples of one batch have in common, and the batch.
struct Batch {
  std::size_t map, set;
  ScanOrigin origin;
  std::vector<std::size_t> rows;
};

void collect(const ScanLocalizer& localizer, const CalibrationSet& set,
             const std::vector<RangeScan>& scans, const Batch& batch, const SearchOptions& search,
             std::vector<CalibrationSample>& samples) {
  for (const LocalizedScan& scan : localizeScans(localizer, scans, batch.rows, {}, search)) {
    const bool has_truth = batch.origin != ScanOrigin::foreign;
    auto sample = calibrationSample(scan.result, has_truth ? &set.truth[scan.row] : nullptr);
    if (!sample) continue;
    sample->map = batch.map;
    sample->set = batch.set;
    sample->origin = batch.origin;
    sample->good = set.good[scan.row] && !set.is_form;
    if (set.is_form) sample->position_square = sample->heading_square = std::nullopt;
    samples.push_back(std::move(*sample));
  }
}

}  // namespace

std::vector<CalibrationSample> collectSamples(const Program& program,
                                              const std::vector<CalibrationSet>& sets,
                                              const CollectionSize& size, SearchOptions search) {
  search.calibration = uncalibrated();
  std::vector<CalibrationSample> samples;
  for (std::size_t map = 0; map < sets.size(); ++map) {
    search.map = sets[map].map;
    const ScanLocalizer localizer =
        makeLocalizer(loadMapWithWarnings(program, search.map, search.scale).map, search, 0);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const CalibrationSet& set = sets[i];
      const auto run = [&](ScanOrigin origin, std::vector<std::size_t> rows,
                           const std::vector<RangeScan>& scans) {
        collect(localizer, set, scans, {sets[map].building, set.building, origin, std::move(rows)},
                search, samples);
      };
      if (i != map) {
        if (set.is_form || sets[map].is_form || set.building == sets[map].building) continue;
        run(ScanOrigin::foreign, thinned(allRows(set), size.foreign), set.scans);
        continue;
      }
      run(ScanOrigin::own, thinned(allRows(set), size.own), set.scans);
      if (set.is_form) continue;
      const std::vector<std::size_t> rows = thinned(goodRows(set), size.cluttered);
      run(ScanOrigin::cluttered, rows, clutteredScans(set, rows));
    }
  }
  return samples;
}

}  // namespace mrpt_polyloc::apps
