#pragma once

#include <mrpt_polyloc/base/Lazy.h>
#include <mrpt_polyloc/geometry/NearestWalls.h>
#include <mrpt_polyloc/localization/MapIndex.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <memory>
#include <string>
#include <utility>

namespace mrpt_polyloc {

/// A map and what CPolygonMap2D derives from it, shared by all copies of one CPolygonMap2D.
///
/// MRPT copies its maps by storing and loading them: fromText() then finds the content that is
/// already there. Immutable, const calls are thread-safe.
class PolygonMapContent {
 public:
  using Ptr = std::shared_ptr<const PolygonMapContent>;

  explicit PolygonMapContent(MapIndex::Ptr index)
      : index_(std::move(index)), walls_(index_->map()) {}

  /// The content that has this text, if some map of this process that was stored or loaded still
  /// holds it; else a new one, read as GeoJSON and validated (milliseconds).
  /// \throws FormatError, InvalidMapError
  static Ptr fromText(const std::string& text);
  /// The map as GeoJSON, which keeps every bit.
  static const std::string& textOf(const Ptr& content);

  const MapIndex::Ptr& index() const { return index_; }
  const PolygonMap& map() const { return index_->map(); }
  const NearestWalls& walls() const { return walls_; }
  /// Made when first asked for, which takes up to seconds for the largest maps: a map that is only
  /// stored, loaded or looked at needs none.
  const RangePredictor& predictor() const;

 private:
  MapIndex::Ptr index_;
  NearestWalls walls_;
  Lazy<std::string> text_;
};

}  // namespace mrpt_polyloc
