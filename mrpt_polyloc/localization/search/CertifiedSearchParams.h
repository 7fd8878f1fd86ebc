#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT CertifiedSearchParams {
  /// Poses whose search cost is within this share of the least one found, plus `margin`, are kept:
  /// the cost is noisy, and the right pose does not always have the least.
  double margin_share = 0.1;
  double margin = 0.01;  ///< [m]
  /// Of the poses kept, those whose cost in the middle of their leaf is within this share of the
  /// best such cost, plus `seed_margin`, are starting points for refinement.
  double seed_share = 0.3;
  double seed_margin = 0.08;  ///< [m]
  /// The best so many of them; where the leaves that remain lie in no more places than this, all
  /// places are looked at, whatever their middles cost.
  std::size_t max_candidates = 200;
  /// Starting points, too, are the places whose clipped cost (ViewCost::clipped) is within this
  /// share of the least, `max_explained` of them at most.
  double explained_share = 0.25;
  std::size_t max_explained = 60;
  /// Regions are settled (see SettledRegions) where the best of their poses tried costs at most
  /// this more than the best of all [m]. On simulated and real scans the optimum as cheap as the
  /// best was at most 0.29 m cheaper than that (doc/localization.md).
  double reach = 0.3;
  /// So many are lowered to their optimum at most; what is left is undecided.
  std::size_t max_lowered = 4000;
  /// Nodes evaluated at most before the search stops and says up to which cost it is certified; 0:
  /// no limit.
  std::size_t max_nodes = 0;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
