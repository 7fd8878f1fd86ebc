#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/geometry/border_tracing.h>
#include <mrpt_polyloc/geometry/findings.h>
#include <mrpt_polyloc/geometry/map_limits.h>
#include <mrpt_polyloc/geometry/polygon_verdicts.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Defects that an error message lists one by one.
constexpr std::size_t kListedDefects = 10;

MapInspection refusedAsTooLarge() {
  MapInspection inspection;
  inspection.defects = inspection.unrepaired = {
      {"more than " + std::to_string(kMaxMapVertices) + " vertices, in the whole map", {0, 0}}};
  return inspection;
}

/// Puts the polygons together whose rings can stay as they are, and those traced again.
std::vector<FreePolygon> assemble(const std::vector<CleanRing>& rings,
                                  const FreeSpaceLabels& labels,
                                  const std::vector<bool>& is_rebuilt,
                                  std::vector<std::vector<FreePolygon>> rebuilt,
                                  Findings& findings) {
  std::vector<FreePolygon> components;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto polygon = static_cast<std::size_t>(rings[r].polygon);
    const TPoint2D& first = rings[r].ring.vertices[0];
    if (is_rebuilt[polygon]) {
      if (!rings[r].is_outer) continue;
      if (rebuilt[polygon].empty()) findings.refused("outer ring of zero area", first);
      std::move(rebuilt[polygon].begin(), rebuilt[polygon].end(), std::back_inserter(components));
    } else if (rings[r].is_outer) {
      if (signedArea(rings[r].ring.vertices) <= 0.0) {
        findings.refused("outer ring of zero area", first);
      }
      components.push_back({rings[r].ring, {}});
    } else if (labels.hole_use[r] == FreeSpaceLabels::HoleUse::needed) {
      Ring hole = reversed(rings[r].ring);
      if (signedArea(hole.vertices) < 0.0) {
        components.back().holes.push_back(std::move(hole));
      } else {
        findings.repaired("hole of zero area", "dropped a hole of zero area", first);
      }
    }
  }
  return components;
}

void refuseIncomplete(const std::vector<CleanRing>& rings, const NodedRings& noded,
                      Findings& findings) {
  refuseContacts(rings, noded.contacts, findings);
  const TPoint2D where =
      noded.contacts.empty() ? rings[0].ring.vertices[0] : noded.contacts.front().where;
  findings.refused(noded.contacts.size() > kMaxContacts
                       ? "more than 10000 crossings and overlaps, the first"
                       : "rings too entangled to tell apart, the first",
                   where);
}

/// The components of a map whose rings are clean; empty if something had to be refused.
std::vector<FreePolygon> resolve(const std::vector<CleanRing>& rings, std::size_t polygon_count,
                                 Findings& findings) {
  std::vector<Ring> bare_rings;
  for (const CleanRing& ring : rings) bare_rings.push_back(ring.ring);
  const NodedRings noded = nodeRings(bare_rings);
  if (!noded.is_complete) {
    refuseIncomplete(rings, noded, findings);
    return {};
  }
  const PlanarRegions regions = cutIntoRegions(noded);
  const FreeSpaceLabels labels = labelFreeSpace(regions, rings, polygon_count);
  const std::vector<bool> is_rebuilt = judgePolygons(rings, noded, regions, labels, findings);
  if (!findings.unrepaired.empty()) return {};
  return assemble(rings, labels, is_rebuilt, traceFreeSpace(regions, labels, rings, is_rebuilt),
                  findings);
}

}  // namespace

std::size_t vertexCount(const RawMap& raw) {
  std::size_t count = 0;
  for (const RawPolygon& polygon : raw.polygons) {
    count += polygon.outer.vertices.size();
    for (const Ring& hole : polygon.holes) count += hole.vertices.size();
  }
  for (const Polyline& walls : raw.walls_beyond) count += walls.size();
  return count;
}

MapInspection inspectMap(const RawMap& raw) {
  if (vertexCount(raw) > kMaxMapVertices) return refusedAsTooLarge();
  Findings findings;
  std::vector<Polyline> walls = cleanWalls(raw.walls_beyond, findings);
  const std::vector<CleanRing> rings = cleanRings(raw.polygons, findings);
  if (raw.polygons.empty()) findings.refused("no free space", {0, 0});
  MapInspection inspection;
  if (findings.unrepaired.empty()) {
    std::vector<FreePolygon> components = resolve(rings, raw.polygons.size(), findings);
    if (findings.unrepaired.empty()) {
      inspection.map.emplace(std::move(components), std::move(walls), raw.cell_size);
    }
  }
  inspection.defects = std::move(findings.defects);
  inspection.unrepaired = std::move(findings.unrepaired);
  inspection.repairs = std::move(findings.repairs);
  return inspection;
}

RepairedMap repairMap(const RawMap& raw) {
  if (raw.polygons.empty()) throw InvalidMapError("the map has no free space");
  MapInspection inspection = inspectMap(raw);
  if (inspection.map) {
    return {std::move(*inspection.map), std::move(inspection.defects),
            std::move(inspection.repairs)};
  }
  const std::vector<Defect>& defects = inspection.unrepaired;
  std::string message = "the map cannot be used, " + std::to_string(defects.size()) +
                        (defects.size() == 1 ? " defect: " : " defects: ");
  for (std::size_t i = 0; i < std::min(defects.size(), kListedDefects); ++i) {
    message += (i > 0 ? "; " : "") + toString(defects[i]);
  }
  if (defects.size() > kListedDefects) {
    message += "; and " + std::to_string(defects.size() - kListedDefects) + " more";
  }
  throw InvalidMapError(message);
}

std::string toString(const Defect& defect) {
  return defect.what + formatted(" at (%.3f, %.3f)", defect.where.x, defect.where.y);
}

}  // namespace mrpt_polyloc
