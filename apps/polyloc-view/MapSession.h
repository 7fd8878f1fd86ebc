#pragma once

#include "requests.h"
#include <mrpt_polyloc/base/Lazy.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/CellLocalizer.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace mrpt_polyloc::apps {

/// The map that is served and what is prepared for it. The index of the search is built by a thread
/// of its own, so that the map is shown meanwhile; the rest when it is first asked for. Calls are
/// thread-safe.
class MapSession {
 public:
  /// Cells at most that are shown, and that the method `cells` may have.
  static constexpr std::size_t kMostCells = 60'000;

  MapSession(PolygonMap map, std::string name);
  ~MapSession();
  MapSession(const MapSession&) = delete;
  MapSession& operator=(const MapSession&) = delete;

  const PolygonMap& map() const { return map_; }
  const std::string& name() const { return name_; }
  std::uint64_t hash() const { return hash_; }

  /// What the index is about: its share built, or why it failed.
  struct IndexState {
    double progress = 0.0;
    bool is_ready = false;
    std::string error;
  };
  IndexState indexState() const;

  /// Waits for the index. \throws ApiError if `cancelled` is set, or if it could not be built
  MapIndex::Ptr index(const std::atomic<bool>& cancelled) const;

  /// \throws ApiError: see index(); method exact, for which there is localizeExact();
  /// CellBudgetError
  LocalizationResult localize(const ScanSet& scans, const SearchRequest& search,
                              const std::atomic<bool>& cancelled) const;
  /// \param view what is seen, in the robot's frame [m]
  LocalizationResult localizeExact(const std::vector<TPoint2D>& view,
                                   const SearchRequest& search) const;

  /// A planner with such parameters: the last one if they are the same, for each makes a table of
  /// the map's clearances. Only strategy, robot_radius and max_range may differ from the default.
  /// \throws InvalidParamsError
  std::shared_ptr<const TravelPlanner> planner(const MapIndex::Ptr& index,
                                               const TravelPlannerParams& params) const;

  const Triangulation& triangulation() const;
  const WallSegments& walls() const;
  /// Of the greatest range for which they are few enough. \throws CellBudgetError
  const VisibilityCells& cells() const;

 private:
  void buildIndex();

  PolygonMap map_;
  std::string name_;
  std::uint64_t hash_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  MapIndex::Ptr index_;
  std::string index_error_;
  std::atomic<double> progress_{0.0};
  std::atomic<bool> is_ending_{false};

  mutable std::mutex planner_mutex_;
  mutable std::shared_ptr<const TravelPlanner> planner_;  ///< the last one

  Lazy<Triangulation> triangulation_;
  Lazy<WallSegments> walls_;
  Lazy<std::unique_ptr<VisibilityCells>> cells_;
  Lazy<std::unique_ptr<CellLocalizer>> cell_localizer_;
  Lazy<std::unique_ptr<ExactLocalizer>> exact_localizer_;
  std::thread builder_;
};

}  // namespace mrpt_polyloc::apps
