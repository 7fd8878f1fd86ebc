#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/search/SearchMetric.h>

#include <atomic>
#include <cstddef>

namespace mrpt_polyloc {

/// What one call of a localizer may take, and what it is to return.
struct POLYLOC_EXPORT SearchOptions {
  std::size_t max_hypotheses = 20;  ///< at most so many are returned
  /// Wall time for search and refinement [ms]; 0: no limit. What is not decided by then is not
  /// proven, and the answer never `unique`; it then depends on the machine.
  double time_budget_ms = 0.0;
  /// Set by another thread to have the call return soon, as if its time were over; null: none.
  const std::atomic<bool>* cancel = nullptr;
  /// Threads that find one answer, which is the same at any number; 0: those of the caller's TBB
  /// arena, outside of any as many as there are cores.
  int threads = 1;
  /// What the certified search minimises and certifies. Poses are ranked by the robust cost in any
  /// case.
  SearchMetric metric = SearchMetric::robust;
  /// Whether hypotheses that stand in one long uncertain valley, as along a corridor, are returned
  /// as one with a long covariance; false for those who go on to tell them apart.
  bool unite_valleys = true;
  /// Whether the result lists what could not be excluded.
  bool keep_regions = false;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
