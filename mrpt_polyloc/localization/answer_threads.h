#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/localization/SearchOptions.h>

#include <tbb/task_arena.h>

namespace mrpt_polyloc {

/// What one answer may take by its options.
inline Budget budgetOf(const SearchOptions& options) {
  return Budget(options.time_budget_ms, options.cancel,
                options.threads == 1 ? Budget::Threads::callers : Budget::Threads::arenas);
}

/// Finds an answer in an arena of as many threads as its options ask for, more than one.
/// \param find is given the options of a search in that arena; what it returns is returned
template <class Find>
auto inOwnArena(const SearchOptions& options, const Find& find) {
  SearchOptions inside = options;
  inside.threads = 0;
  tbb::task_arena arena(options.threads);
  return arena.execute([&] { return find(inside); });
}

}  // namespace mrpt_polyloc
