#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewIndex.h>
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
constexpr float kMostFloat = std::numeric_limits<float>::max();

/// Distances of a feature from `blocks` blocks of features, less `slack`, in [0, the greatest
/// float].
POLYLOC_HOT_LOOP
void boundsOf(const float* features, const float* query, std::size_t blocks, float slack,
              float* bounds) {
  for (std::size_t b = 0; b < blocks; ++b) {
    std::array<float, kLanes> sums{};
    for (std::size_t i = 0; i < kNumbers; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float e = features[(b * kNumbers + i) * kLanes + lane] - query[i];
        sums[lane] += e * e;
      }
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float bound = std::sqrt(sums[lane]) - slack;
      const float above = bound > 0.0F ? bound : 0.0F;
      bounds[b * kLanes + lane] = above < kMostFloat ? above : kMostFloat;
    }
  }
}

/// The least of n numbers, infinity of none.
POLYLOC_HOT_LOOP
float leastOf(const float* values, std::size_t n) {
  std::array<float, kLanes> lanes;
  lanes.fill(std::numeric_limits<float>::infinity());
  std::size_t i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      lanes[lane] = values[i + lane] < lanes[lane] ? values[i + lane] : lanes[lane];
    }
  }
  for (; i < n; ++i) lanes[0] = std::min(lanes[0], values[i]);
  return *std::min_element(lanes.begin(), lanes.end());
}

/// A view whose distance is bounded but not known yet.
struct Bound {
  float distance;
  std::uint32_t view;
  bool operator<(const Bound& other) const {
    return distance < other.distance || (distance == other.distance && view < other.view);
  }
};

/// Appends the bounds in [from, to), few among many: most blocks hold none.
POLYLOC_HOT_LOOP
void collect(const float* bounds, std::size_t n, float from, float to, std::vector<Bound>& found) {
  constexpr std::size_t kBlock = 64;
  for (std::size_t i = 0; i < n; i += kBlock) {
    const std::size_t stop = std::min(i + kBlock, n);
    unsigned any = 0;
    for (std::size_t j = i; j < stop; ++j) {
      any |= static_cast<unsigned>(bounds[j] >= from) & static_cast<unsigned>(bounds[j] < to);
    }
    for (std::size_t j = i; any != 0 && j < stop; ++j) {
      if (bounds[j] >= from && bounds[j] < to) {
        found.push_back({bounds[j], static_cast<std::uint32_t>(j)});
      }
    }
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

struct Farther {
  bool operator()(const ViewIndex::Neighbor& a, const ViewIndex::Neighbor& b) const {
    return a.distance > b.distance || (a.distance == b.distance && a.view > b.view);
  }
};

/// Bounds in ascending order, sorted only as far as they are asked for.
class AscendingBounds {
 public:
  explicit AscendingBounds(std::vector<float> bounds) : bounds_(std::move(bounds)) {
    if (!bounds_.empty()) fill(leastOf(bounds_.data(), bounds_.size()) * 1.1F + 1e-6F);
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

  /// Takes all bounds below `end`; in the end those of the greatest number too.
  void fill(float end) {
    sorted_.clear();
    next_ = 0;
    collect(bounds_.data(), bounds_.size(), end_, end, sorted_);
    std::sort(sorted_.begin(), sorted_.end());
    left_ -= sorted_.size();
    end_ = end;
  }

  std::vector<float> bounds_;
  std::vector<Bound> sorted_;
  std::size_t next_ = 0;
  std::size_t left_ = bounds_.size();
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
  // Bins of 16 degrees at k = 180. Of 32 they leave 20 times as many views in doubt.
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
  const auto slack =
      static_cast<float>(kRounding * (greatest_norm_ + std::sqrt(scan.squaredNorm())));
  boundsOf(features_.data(), query.data(), blocks, slack, bounds.data());
  bounds.resize(views_.size());
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
