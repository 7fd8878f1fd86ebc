#pragma once

#include <mrpt_polyloc/base/BuildProgress.h>
#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <cstddef>
#include <istream>
#include <memory>
#include <ostream>
#include <string>

namespace mrpt_polyloc {

class MapIndexParts;

struct POLYLOC_EXPORT MapIndexParams {
  /// Side of the search's finest leaves [m]. Smaller ones are bounded more tightly; time of
  /// building and memory grow with the inverse square.
  double leaf_size = 0.25;
  int threads = 0;  ///< for building; 0: all cores
  /// So far past the first open edge a beam meets what the map knows [m], see PredictedRanges.
  double horizon = 20.0;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// What preparing an index will take, on maps of buildings: memory within a factor of 2, time of 6.
struct POLYLOC_EXPORT MapIndexEstimate {
  double bytes;        ///< of memory, kept
  double cpu_seconds;  ///< of one core, without loading the map
};

/// A map and all that is prepared for it: its triangulation, the edges that are seen from where,
/// and the tree of the certified search. Made once, and shared: by localizers of any kind, metric
/// maps, particle seeders.
///
/// Immutable; const calls are thread-safe. What is inside is not for users: see MapIndexParts.
class POLYLOC_EXPORT MapIndex {
 public:
  using Ptr = std::shared_ptr<const MapIndex>;

  /// What build() would take, from the map's area and borders, without building anything.
  /// \throws InvalidParamsError
  static MapIndexEstimate estimate(const PolygonMap& map, const MapIndexParams& params = {});

  /// Prepares everything. Progress is told now and then, and may cancel.
  /// \throws InvalidParamsError, InvalidMapError; CancelledError
  static Ptr build(PolygonMap map, const MapIndexParams& params = {},
                   const ProgressFunction& progress = {});

  /// Prepares each part when it is first needed, and none that is not: a metric map that is only
  /// shown needs none, one that weighs scans no tree. The first to need a part waits for it.
  static Ptr deferred(PolygonMap map, const MapIndexParams& params = {});

  /// Reads what save() wrote for this map. The stream must be binary. \param file its name, for
  /// messages
  /// \throws FormatError naming the file and the byte, if it is not the index of this map as this
  /// program lays it out, cut short, or damaged
  static Ptr load(std::istream& in, PolygonMap map, const std::string& file);
  /// The same from a file.
  static Ptr load(const std::string& path, PolygonMap map);

  /// Writes all that takes long to prepare. Whether that went well the stream says.
  void save(std::ostream& out) const;

  ~MapIndex();
  MapIndex(const MapIndex&) = delete;
  MapIndex& operator=(const MapIndex&) = delete;

  const PolygonMap& map() const;
  double leafSize() const;  ///< [m]
  /// Memory of what is prepared by now, without the map itself.
  std::size_t bytes() const;
  /// Wall time that build() or load() took; 0 if deferred.
  double buildSeconds() const;

  /// For the library's own use.
  const MapIndexParts& parts() const { return *parts_; }

 private:
  explicit MapIndex(std::unique_ptr<MapIndexParts> parts);

  std::unique_ptr<MapIndexParts> parts_;
};

}  // namespace mrpt_polyloc
