#pragma once

#include "../polyloc-travel/TravelRun.h"
#include "../polyloc-travel/World.h"
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>

#include <nlohmann/json.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace mrpt_polyloc::apps {

/// A simulated robot that drives until it knows where it is, one step after the other as they are
/// asked for. Steps that were made stay: one may go back. Thread-safe.
class Drive {
 public:
  using Json = nlohmann::ordered_json;

  /// \param seed of the noise of scans and wheels \throws InvalidParamsError
  Drive(std::shared_ptr<const TravelPlanner> planner, const GlobalLocalizer& localizer, World world,
        const mrpt::math::TPose2D& start, const TravelRunParams& params, std::uint64_t seed);

  /// What is known after so many legs, and planned; of a drive that was over before, its end.
  /// README.md says what it holds. Makes the steps that are not made yet.
  /// \throws ApiError if `cancelled` is set between two steps
  Json step(std::size_t number, const std::atomic<bool>& cancelled);

 private:
  /// A hypothesis where it fell.
  struct Fallen {
    mrpt::math::TPose2D pose;
    double weight;
    std::size_t step;
  };

  void findFallen();
  Json told(double ms) const;
  Json resultJson(double ms) const;
  Json safeJson() const;

  std::shared_ptr<const TravelPlanner> planner_;
  GlobalLocalizer localizer_;
  World world_;
  TravelRun run_;
  std::mutex mutex_;
  std::vector<Fallen> fallen_;
  mrpt::math::TPose2D odometry_before_{0, 0, 0};  ///< of the step before
  std::vector<Json> steps_;
};

}  // namespace mrpt_polyloc::apps
