#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/polar/RotationRange.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace mrpt_polyloc {

/// Nearest views under the sampled polar coordinate metric over rotations, exactly: in the order
/// that comparing with every view would give, but most are ruled out by a lower bound computed for
/// all in a row: FourierBound for a complete query of unknown heading, else BinMeansBound.
///
/// Not a MetricTree: on views of visibility cells it evaluates the metric far more often
/// (doc/performance.md); and for a partial query, or one with a reach, there is no triangle
/// inequality that it could go by, since what is compared depends on the rotation.
/// Immutable, all queries const and thread-safe.
class POLYLOC_EXPORT ViewIndex {
 public:
  /// Of the Fourier features. More would cost memory traffic and rule out little more.
  static constexpr std::size_t kOrder = 15;

  struct Neighbor {
    std::size_t view;  ///< its place in the constructor's argument
    double distance;   ///< [m rad^(1/2)]
    double rotation;   ///< the query turned counterclockwise by this fits best, between samples
                       ///< too [rad]
  };

  struct Query {
    const SampledPolarFunction& scan;
    RotationRange rotations;
    /// Views are cut off here first: how far the query could see at all [m].
    double reach = std::numeric_limits<double>::infinity();
    /// Views for which this is false are passed over; empty: none.
    std::function<bool(std::size_t)> accepts;
  };

  /// \param views complete, all of the same number of samples k >= 2 (kOrder + 1)
  /// \throws InvalidParamsError if they are not
  explicit ViewIndex(std::vector<SampledPolarFunction> views);

  /// Calls visit(neighbor) from the nearest view on, equally far ones by their place, until it
  /// returns false. \returns evaluations of the metric
  /// \throws InvalidParamsError if the scan has another number of samples, or no valid one, or the
  /// range is bad.
  std::size_t visitNearest(const Query& query,
                           const std::function<bool(const Neighbor&)>& visit) const;

  /// The `count` nearest views.
  std::vector<Neighbor> nearest(const Query& query, std::size_t count) const;

  std::size_t size() const { return views_.size(); }
  const std::vector<SampledPolarFunction>& views() const { return views_; }
  /// Memory [bytes]; 8.5 k per view, most of it.
  std::size_t bytes() const;

 private:
  void addFeature(std::size_t view);
  std::vector<float> lowerBounds(const Query& query) const;
  std::vector<float> fourierBounds(const SampledPolarFunction& scan) const;
  Neighbor compare(const Query& query, std::size_t view) const;

  std::vector<SampledPolarFunction> views_;
  // Block by block of kLanes views, in a block number by number.
  std::vector<float> features_;
  double greatest_norm_ = 0.0;
};

}  // namespace mrpt_polyloc
