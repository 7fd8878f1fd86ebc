#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/GlobalLocalizerParams.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/MapIndex.h>
#include <mrpt_polyloc/localization/SearchOptions.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <vector>

namespace mrpt_polyloc {

/// The front door: a map's index in, then one scan in, all poses that explain it out.
///
/// Cheap to make, copy and assign; any number may share an index. localize() is const, thread-safe
/// and deterministic.
class POLYLOC_EXPORT GlobalLocalizer {
 public:
  /// Prepares what is missing if the index is a deferred one.
  /// \throws InvalidParamsError, also if the index is null
  explicit GlobalLocalizer(MapIndex::Ptr index, GlobalLocalizerParams params = {});
  /// With an index of its own.
  explicit GlobalLocalizer(PolygonMap map, GlobalLocalizerParams params = {});

  /// Every pose that explains the scan. Never throws for what a scan contains: a scan that cannot
  /// be localized is a status. \throws InvalidParamsError for a prior or options that are not
  /// finite or in range
  LocalizationResult localize(const RangeScan& scan, const PosePrior& prior = {},
                              const SearchOptions& options = {}) const;

  /// Every pose now that explains all scans of a set. The scans are searched one by one, what they
  /// leave is carried to now by the movements, refined on all beams of all scans with the movements
  /// free within their uncertainty, or more if the scans say so (LocalizationResult::wheel_scale),
  /// ranked and judged on all (see WayFinder, SetRefiner, SetEvidence). For a set of one scan it is
  /// the answer for that scan. The certificate and regions are those of the first scan that was
  /// searched, mostly the first of now: see Certificate::moment. The prior is of the robot now. The
  /// budget is for all searches together.
  LocalizationResult localize(const ScanSet& set, const PosePrior& prior = {},
                              const SearchOptions& options = {}) const;

  /// The same for many scans, each for itself, on the threads of the caller's TBB arena; a time
  /// budget is each scan's own. In the order of the scans, the same at any number of threads.
  std::vector<LocalizationResult> localize(const std::vector<RangeScan>& scans,
                                           const PosePrior& prior = {},
                                           const SearchOptions& options = {}) const;

  const MapIndex& index() const { return *index_; }
  const PolygonMap& map() const { return index_->map(); }
  const GlobalLocalizerParams& params() const { return params_; }

 private:
  MapIndex::Ptr index_;
  GlobalLocalizerParams params_;
};

}  // namespace mrpt_polyloc
