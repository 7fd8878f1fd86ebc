#include "explanation.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/map_files.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

// From where on something is worth a word. Rules of thumb from the project's own sets, where half
// circles, short ranges and coarse cells are what makes answers ambiguous.
constexpr double kCoarseCell = 0.1;       // [m]
constexpr double kLargeOpenShare = 0.5;   // of the perimeter
constexpr double kLittleUnknown = 0.005;  // of the cells
constexpr double kShortRange = 6.0;       // [m]
constexpr double kNarrowView = 200.0;     // [deg]
constexpr double kManyNothing = 0.3;      // of the readings
constexpr double kManyNoReturns = 0.5;    // of the readings
constexpr std::size_t kFewHits = 30;      // of a scan
constexpr double kManyPoorScans = 0.1;    // of the scans

template <class... Values>
std::string line(const char* format, Values... values) {
  return "  " + formatted(format, values...) + "\n";
}

std::string listed(const char* head, const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += std::string("  ") + head + ": " + item + "\n";
  return text;
}

std::string explainGrid(const OccupancyBitmap& bitmap, std::vector<std::string>& odd) {
  std::array<double, 3> shares{};
  for (const CellState cell : bitmap.cells) shares[static_cast<std::size_t>(cell)] += 1.0;
  for (double& share : shares) share /= static_cast<double>(bitmap.cells.size());
  const double unknown = shares[static_cast<std::size_t>(CellState::unknown)];
  if (bitmap.resolution >= kCoarseCell) {
    odd.push_back("coarse cells: poses are told apart less well than with cells of 0.05 m");
  }
  if (unknown < kLittleUnknown) {
    odd.push_back(
        "nearly nothing is unknown: was free_thresh too high? Look at --svg of polyloc-map");
  }
  return line("grid          %d x %d cells of %g m", bitmap.width, bitmap.height,
              bitmap.resolution) +
         line("cells         %.1f %% free, %.1f %% occupied, %.1f %% unknown",
              100 * shares[static_cast<std::size_t>(CellState::free)],
              100 * shares[static_cast<std::size_t>(CellState::occupied)], 100 * unknown);
}

std::string explainMap(const SearchOptions& search) {
  Notes notes;
  std::vector<std::string> odd;
  const RepairedMap loaded = loadMap(search.map, {}, &notes, search.scale);
  const PolygonMap& map = loaded.map;
  std::string text = "map " + search.map + "\n";
  if (const auto bitmap = loadBitmap(search.map)) text += explainGrid(*bitmap, odd);
  const auto box = map.boundingBox();
  const double open_share = map.perimeter() > 0.0 ? map.openPerimeter() / map.perimeter() : 0.0;
  text += line("free space    %.2f m2 in %zu parts, within %.2f m x %.2f m", map.area(),
               map.components().size(), box.max.x - box.min.x, box.max.y - box.min.y);
  text += line("borders       %.1f m, of which open to the unknown %.1f %%; walls beyond %.1f m",
               map.perimeter(), 100 * open_share, map.wallsBeyondLength());
  if (!loaded.repairs.empty()) text += line("repairs       %zu", loaded.repairs.size());
  if (open_share > kLargeOpenShare) {
    odd.push_back("much of the border is open: poses at it are told apart by little");
  }
  return text + listed("assumed", notes) + listed("odd", odd);
}

/// Figures of a log's scans.
struct ScanFigures {
  std::size_t scans = 0, beams = 0, hits = 0, no_returns = 0, poor = 0;
  std::size_t least_beams = 0, most_beams = 0;
  double view_deg = 0.0;      ///< widest
  std::set<double> maximums;  ///< ranges of no-returns, a few
  std::vector<float> ranges;  ///< of hits, a share of them
};

void addScan(const RangeScan& scan, ScanFigures& figures) {
  constexpr std::size_t kEvery = 7;  // prime to the usual numbers of beams
  constexpr std::size_t kMostMaximums = 4;
  const auto& beams = scan.beams();
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Beam& beam = beams[i];
    if (beam.kind == BeamKind::invalid) continue;
    low = std::min(low, beam.bearing);
    high = std::max(high, beam.bearing);
    if (beam.kind == BeamKind::no_return) {
      if (figures.maximums.size() < kMostMaximums) figures.maximums.insert(beam.range);
    } else if ((figures.hits + i) % kEvery == 0) {
      figures.ranges.push_back(static_cast<float>(beam.range));
    }
  }
  if (high >= low) figures.view_deg = std::max(figures.view_deg, toDegrees(high - low));
  figures.least_beams =
      figures.scans == 0 ? beams.size() : std::min(figures.least_beams, beams.size());
  figures.most_beams = std::max(figures.most_beams, beams.size());
  figures.beams += beams.size();
  figures.hits += scan.hitCount();
  figures.no_returns += scan.noReturnCount();
  figures.poor += scan.hitCount() < kFewHits ? 1 : 0;
  ++figures.scans;
}

/// The range below which such a share of the hits lies; the ranges are sorted.
double quantile(const std::vector<float>& ranges, double share) {
  const auto last = static_cast<double>(ranges.size() - 1);
  return static_cast<double>(ranges[static_cast<std::size_t>(share * last)]);
}

std::vector<std::string> oddInScans(const ScanFigures& figures, double nothing, double no_returns) {
  std::vector<std::string> odd;
  if (static_cast<double>(figures.poor) > kManyPoorScans * static_cast<double>(figures.scans)) {
    odd.push_back(std::to_string(figures.poor) + " scans have fewer than " +
                  std::to_string(kFewHits) + " hits: little to tell poses apart by");
  }
  if (nothing > kManyNothing) {
    odd.push_back("many readings say nothing: is a sector masked, or --min-range too large?");
  }
  if (no_returns > kManyNoReturns) {
    odd.push_back("most readings are no-returns: is --max-range too small?");
  }
  if (figures.no_returns == 0) {
    odd.push_back(
        "no reading is a no-return: if the sensor has them, --max-range M says from where");
  }
  if (figures.view_deg < kNarrowView) {
    odd.push_back(
        "the field of view is narrow: expect more ambiguous answers than of a full circle");
  }
  if (!figures.maximums.empty() && *figures.maximums.rbegin() < kShortRange) {
    odd.push_back("the range is short: expect ambiguous answers in large rooms");
  }
  return odd;
}

std::string explainScans(const SearchOptions& search) {
  Notes notes;
  ScanFigures figures;
  for (const RangeScan& scan : loadScans(search.scans, search.file, &notes)) {
    addScan(scan, figures);
  }
  std::sort(figures.ranges.begin(), figures.ranges.end());
  const double all = static_cast<double>(std::max<std::size_t>(1, figures.beams));
  const double hits = static_cast<double>(figures.hits) / all;
  const double no_returns = static_cast<double>(figures.no_returns) / all;
  const double nothing =
      static_cast<double>(figures.beams - figures.hits - figures.no_returns) / all;

  std::string text = "scans " + search.scans + "\n";
  text += line("scans         %zu of %zu to %zu beams, over %.1f deg", figures.scans,
               figures.least_beams, figures.most_beams, figures.view_deg);
  text += line("readings      %.1f %% hits, %.1f %% no-returns, %.1f %% say nothing", 100 * hits,
               100 * no_returns, 100 * nothing);
  if (!figures.ranges.empty()) {
    text += line("hits          %.2f m (5 %%), %.2f m (half), %.2f m (95 %%), %.2f m (all)",
                 quantile(figures.ranges, 0.05), quantile(figures.ranges, 0.5),
                 quantile(figures.ranges, 0.95), quantile(figures.ranges, 1.0));
  }
  for (const double maximum : figures.maximums) {
    text += line("no-returns    nothing within %.2f m", maximum);
  }
  return text + listed("assumed", notes) + listed("odd", oddInScans(figures, nothing, no_returns));
}

}  // namespace

std::string explain(const LocalizeOptions& options) {
  return explainMap(options.search) + explainScans(options.search);
}

}  // namespace mrpt_polyloc::apps
