#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/RangeScan.h>

#include <cstddef>
#include <memory>

namespace mrpt_polyloc {

struct GlobalLocalizerParams {
  std::size_t max_hypotheses = 20;  ///< at most so many are returned
  int threads = 0;                  ///< for building the index; 0: all cores

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The front door: a map in, then one scan in, all poses that explain it out.
///
/// Building prepares an index; localize() is const, thread-safe and deterministic.
class GlobalLocalizer {
 public:
  /// \throws InvalidParamsError
  explicit GlobalLocalizer(PolygonMap map, GlobalLocalizerParams params = {});
  ~GlobalLocalizer();
  GlobalLocalizer(GlobalLocalizer&&) noexcept;

  /// Every pose that explains the scan. Never throws for what a scan contains: a scan that cannot
  /// be localized is a status.
  LocalizationResult localize(const RangeScan& scan, const PosePrior& prior = {}) const;

  const PolygonMap& map() const;
  std::size_t indexBytes() const;    ///< memory of the search index
  double indexBuildSeconds() const;  ///< wall time that building it took

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrpt_polyloc
