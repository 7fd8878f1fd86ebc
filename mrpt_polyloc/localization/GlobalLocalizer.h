#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/PoseRefinerParams.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>
#include <mrpt_polyloc/localization/search/CertifiedSearchParams.h>
#include <mrpt_polyloc/localization/search/SearchMetric.h>

#include <cstddef>
#include <memory>
#include <string>

namespace mrpt_polyloc {

struct GlobalLocalizerParams {
  std::size_t max_hypotheses = 20;  ///< at most so many are returned
  int threads = 0;                  ///< for building the index; 0: all cores
  /// Side of the finest leaves [m]. Smaller ones are bounded more tightly; time of building and
  /// memory grow with the inverse square.
  double leaf_size = 0.25;
  /// Whether the result lists what could not be excluded.
  bool keep_regions = false;
  /// Scans with fewer hits are not searched for: so few fit almost everywhere.
  std::size_t least_hits = 15;
  RobustCostParams cost;  ///< by which poses are ranked
  /// The search's cost: wider truncations, by which wrong poses stand out more, so that bounds
  /// exclude more.
  RobustCostParams search_cost{1.2, 2.0, 0.6, 0.3, RobustCostParams{}.none_share};
  /// What the search minimises and certifies. Poses are ranked by `cost` in any case.
  SearchMetric search_metric = SearchMetric::robust;
  CertifiedSearchParams certified;
  PoseRefinerParams refinement;
  HypothesisParams hypotheses;

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
  /// With an index made before, `params.leaf_size` then being the index's.
  /// \param file its name, for messages
  /// \throws FormatError if the content is not the index of this map, see parseIndex()
  GlobalLocalizer(PolygonMap map, const std::string& index, const std::string& file,
                  GlobalLocalizerParams params = {});
  ~GlobalLocalizer();
  GlobalLocalizer(GlobalLocalizer&&) noexcept;

  /// Every pose that explains the scan. Never throws for what a scan contains: a scan that cannot
  /// be localized is a status. \throws InvalidParamsError for a prior that is not finite or in
  /// range
  LocalizationResult localize(const RangeScan& scan, const PosePrior& prior = {}) const;

  const PolygonMap& map() const;
  std::size_t indexBytes() const;  ///< memory of the search index
  /// The search index, to be kept in a file.
  std::string serializedIndex() const;
  double indexBuildSeconds() const;  ///< wall time that building it took

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrpt_polyloc
