#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/localization/ViewIndex.h>
#include <mrpt_polyloc/polar/BinMeansBound.h>
#include <mrpt_polyloc/polar/FourierBound.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

constexpr std::size_t kLanes = 16;
constexpr std::size_t kNumbers = ViewIndex::kOrder + 2;  // of a feature

/// Squared distances of a feature from `blocks` blocks of features.
POLYLOC_HOT_LOOP
void squaredDistances(const float* features, const float* query, std::size_t blocks,
                      float* squares) {
  for (std::size_t b = 0; b < blocks; ++b) {
    std::array<float, kLanes> sums{};
    for (std::size_t i = 0; i < kNumbers; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float e = features[(b * kNumbers + i) * kLanes + lane] - query[i];
        sums[lane] += e * e;
      }
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) squares[b * kLanes + lane] = sums[lane];
  }
}

/// Rounding of features and bounds in single precision, as a share of the norms. Nearly all of it
/// is that of a feature's last number, a root of a difference: it covers one down to 0.005 of the
/// norm.
constexpr double kRounding = 1e-4;

SampledPolarFunction cutOff(const SampledPolarFunction& view, double reach) {
  std::vector<float> samples = view.samples();
  for (float& sample : samples) sample = std::min(sample, static_cast<float>(reach));
  return SampledPolarFunction(std::move(samples));
}

/// A view whose distance is bounded but not known yet.
struct Bound {
  float distance;
  std::uint32_t view;
  bool operator<(const Bound& other) const {
    return distance < other.distance || (distance == other.distance && view < other.view);
  }
};

struct Farther {
  bool operator()(const ViewIndex::Neighbor& a, const ViewIndex::Neighbor& b) const {
    return a.distance > b.distance || (a.distance == b.distance && a.view > b.view);
  }
};

/// Bounds in ascending order, sorted only as far as they are asked for.
class AscendingBounds {
 public:
  explicit AscendingBounds(std::vector<float> bounds) : bounds_(std::move(bounds)) {
    for (const float bound : bounds_) least_ = std::min(least_, bound);
    if (!bounds_.empty()) fill(least_ * 1.1F + 1e-6F);
  }

  /// The least bound left; infinite if there is none.
  float top() const { return next_ < sorted_.size() ? sorted_[next_].distance : kNever; }

  std::size_t pop() {
    const std::size_t view = sorted_[next_++].view;
    // Level by level, each reaching a quarter farther: few passes, and little is sorted in vain.
    while (next_ == sorted_.size() && left_ > 0) fill(1.25F * end_);
    return view;
  }

 private:
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  /// Takes all bounds below `end`.
  void fill(float end) {
    sorted_.clear();
    next_ = 0;
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      if (bounds_[i] >= end_ && (bounds_[i] < end || std::isinf(end))) {
        sorted_.push_back({bounds_[i], static_cast<std::uint32_t>(i)});
      }
    }
    std::sort(sorted_.begin(), sorted_.end());
    left_ -= sorted_.size();
    end_ = end;
  }

  std::vector<float> bounds_;
  std::vector<Bound> sorted_;
  std::size_t next_ = 0;
  std::size_t left_ = bounds_.size();
  float least_ = kNever;
  float end_ = 0.0F;
};

}  // namespace

ViewIndex::ViewIndex(std::vector<SampledPolarFunction> views) : views_(std::move(views)) {
  features_.resize((views_.size() + kLanes - 1) / kLanes * kLanes * kNumbers);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (views_[i].size() != views_.front().size()) {
      throw InvalidParamsError("view " + std::to_string(i) + " has " +
                               std::to_string(views_[i].size()) + " samples, the first has " +
                               std::to_string(views_.front().size()));
    }
    addFeature(i);
  }
}

void ViewIndex::addFeature(std::size_t view) {
  const std::vector<double> feature = fourierFeature(views_[view], kOrder);
  for (std::size_t i = 0; i < kNumbers; ++i) {
    features_[(view / kLanes * kNumbers + i) * kLanes + view % kLanes] =
        static_cast<float>(feature[i]);
  }
  greatest_norm_ = std::max(greatest_norm_, std::sqrt(views_[view].squaredNorm()));
}

std::vector<float> ViewIndex::lowerBounds(const Query& query) const {
  if (query.scan.isComplete() && query.rotations.isFullCircle() && std::isinf(query.reach)) {
    return fourierBounds(query.scan);
  }
  // Bins of 16 degrees at k = 180: wide enough to be few, and narrow beside a partial view.
  constexpr std::size_t kBinWidth = 8;
  const BinMeansBound bound(query.scan, kBinWidth, query.rotations);
  std::vector<float> bounds(views_.size());
  for (std::size_t i = 0; i < views_.size(); ++i) {
    bounds[i] = static_cast<float>(bound(views_[i], query.reach));
  }
  return bounds;
}

std::vector<float> ViewIndex::fourierBounds(const SampledPolarFunction& scan) const {
  const std::vector<double> feature = fourierFeature(scan, kOrder);
  std::array<float, kNumbers> query{};
  std::transform(feature.begin(), feature.end(), query.begin(),
                 [](double number) { return static_cast<float>(number); });
  const std::size_t blocks = features_.size() / (kLanes * kNumbers);
  std::vector<float> bounds(blocks * kLanes);
  squaredDistances(features_.data(), query.data(), blocks, bounds.data());
  bounds.resize(views_.size());
  const auto slack =
      static_cast<float>(kRounding * (greatest_norm_ + std::sqrt(scan.squaredNorm())));
  for (float& bound : bounds) {
    bound = std::clamp(std::sqrt(bound) - slack, 0.0F, std::numeric_limits<float>::max());
  }
  return bounds;
}

ViewIndex::Neighbor ViewIndex::compare(const Query& query, std::size_t view) const {
  const RotationMatch match =
      std::isfinite(query.reach)
          ? distanceOverRotations(query.scan, cutOff(views_[view], query.reach), query.rotations)
          : distanceOverRotations(query.scan, views_[view], query.rotations);
  return {view, match.distance, match.finer_rotation};
}

std::size_t ViewIndex::visitNearest(const Query& query,
                                    const std::function<bool(const Neighbor&)>& visit) const {
  query.rotations.check();
  AscendingBounds bounds(views_.empty() ? std::vector<float>() : lowerBounds(query));
  std::priority_queue<Neighbor, std::vector<Neighbor>, Farther> known;
  std::size_t evaluations = 0;
  for (;;) {
    // What is known is next if no unknown one can be as near.
    const auto bound = static_cast<double>(bounds.top());
    if (!known.empty() && known.top().distance < bound) {
      if (!visit(known.top())) return evaluations;
      known.pop();
      continue;
    }
    if (std::isinf(bound)) return evaluations;
    const std::size_t view = bounds.pop();
    if (query.accepts && !query.accepts(view)) continue;
    ++evaluations;
    known.push(compare(query, view));
  }
}

std::vector<ViewIndex::Neighbor> ViewIndex::nearest(const Query& query, std::size_t count) const {
  std::vector<Neighbor> found;
  if (count == 0) return found;
  visitNearest(query, [&](const Neighbor& neighbor) {
    found.push_back(neighbor);
    return found.size() < count;
  });
  return found;
}

std::size_t ViewIndex::bytes() const {
  std::size_t sum = features_.capacity() * sizeof(float) + views_.capacity() * sizeof(views_[0]);
  for (const SampledPolarFunction& view : views_) {
    sum += view.samples().capacity() * sizeof(float) +
           view.spectrum().capacity() * sizeof(view.spectrum()[0]);
  }
  return sum;
}

}  // namespace mrpt_polyloc
