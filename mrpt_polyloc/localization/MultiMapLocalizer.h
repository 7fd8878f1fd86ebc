#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// An answer over several maps.
struct POLYLOC_EXPORT MultiMapResult {
  /// Hypotheses of all maps, ranked and weighed together; match_probability: that the scans were
  /// taken in one of the maps. Statistics are sums; certificate and regions are those of
  /// `of_map`.
  LocalizationResult result;
  std::vector<std::size_t> maps;  ///< of each hypothesis, the number of its map
  /// What each map's own search found: its certificate, its match.
  std::vector<LocalizationResult> of_map;
};

/// In which floor, or building, is the robot, and where? Every map is searched; the hypotheses of
/// all are compared by the evidence of the same beams, as those of one map are (see SetEvidence).
///
/// Const, thread-safe, deterministic; a single map gives the answer of its localizer.
class POLYLOC_EXPORT MultiMapLocalizer {
 public:
  /// \throws InvalidParamsError if there is none
  explicit MultiMapLocalizer(std::vector<GlobalLocalizer> localizers);

  /// \param prior in the frame of every map; \throws InvalidParamsError as GlobalLocalizer
  MultiMapResult localize(const ScanSet& set, const PosePrior& prior = {},
                          const SearchOptions& options = {}) const;

  const std::vector<GlobalLocalizer>& localizers() const { return localizers_; }

 private:
  std::vector<GlobalLocalizer> localizers_;
};

}  // namespace mrpt_polyloc
