#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/exact/SkeletonClasses.h>
#include <mrpt_polyloc/travel/verification_tour.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// The second stage as Dudek, Romanik and Whitesides pose it: a simple polygon, a compass, no
/// noise, unlimited sight. The reference that TravelPlanner's strategy `nearest` is modelled on.
///
/// The map is laid over itself, once for each hypothesis, so that all have the robot at the origin;
/// what is seen at a place is the same under two hypotheses if their visibility cells there are of
/// one class and their skeletons lie alike. Places are points inside of the cells of all copies:
/// the centre of each, and beside each of its corners. Robots move in straight lines between places
/// that see each other, so that all lengths are those of walks over one graph.
class POLYLOC_EXPORT ExactTravel {
 public:
  struct Run {
    double travel = 0.0;            ///< [m]
    std::size_t looks = 0;          ///< views taken on the way
    std::vector<std::size_t> left;  ///< hypotheses that are left, the truth among them
  };

  /// \param starts where the robot may stand, for each hypothesis [m in the map]
  /// \param truth which of them is right: robots move in its copy
  /// Keeps references to cells and classes (of the same map, a simple polygon).
  /// Cost: O(places^2 * vertices).
  ExactTravel(const VisibilityCells& cells, const SkeletonClasses& classes,
              std::vector<TPoint2D> starts, std::size_t truth, double tolerance = 1e-6);

  /// Goes to the nearest place where the hypotheses left do not all see the same, drops those that
  /// do not see what is seen, and again, until one is left or nothing tells more.
  /// \param back whether it returns to the start between, as the strategy of the paper does
  Run nearest(bool back = true) const;

  /// The shortest tour that verifies the truth against all hypotheses that can be told from it.
  /// None without a way.
  std::optional<double> shortestTour() const;

  /// Whether two hypotheses see the same at a place of their common frame.
  bool seesAlike(const TPoint2D& place, std::size_t a, std::size_t b) const;

  std::size_t places() const { return places_.size(); }
  /// Relative to the start; the first is the start.
  const std::vector<TPoint2D>& placePoints() const { return places_; }
  const TravelGraph& graph() const { return graph_; }

 private:
  void collectPlaces();
  void connect();
  std::vector<std::uint32_t> toldFromTruth() const;

  const VisibilityCells* cells_;
  const SkeletonClasses* classes_;
  std::vector<TPoint2D> starts_;
  std::size_t truth_;
  double tolerance_;
  std::vector<std::int64_t> class_of_cell_;
  std::vector<TPoint2D> places_;
  TravelGraph graph_;
};

}  // namespace mrpt_polyloc
