#include "MapSession.h"

#include "ApiError.h"

#include <tbb/task_scheduler_observer.h>

#include <chrono>
#include <exception>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace mrpt_polyloc::apps {

namespace {

/// Threads that build the index leave the processor to those that answer.
class LowPriority : public tbb::task_scheduler_observer {
 public:
  LowPriority() {
    lower();
    observe(true);
  }
  ~LowPriority() override { observe(false); }
  void on_scheduler_entry(bool is_worker) override {
    if (is_worker) lower();
  }

 private:
  static void lower() {
    constexpr int kNice = 5;
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice);  // on Linux of the thread
  }
};

}  // namespace

MapSession::MapSession(PolygonMap map, std::string name)
    : map_(std::move(map)),
      name_(std::move(name)),
      hash_(map_.hash()),
      builder_([this] { buildIndex(); }) {}

MapSession::~MapSession() {
  is_ending_ = true;
  builder_.join();
}

void MapSession::buildIndex() {
  const LowPriority low;
  MapIndex::Ptr index;
  std::string error;
  try {
    index = MapIndex::build(map_, {}, [this](double share) {
      progress_ = share;
      return !is_ending_;
    });
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  index_ = std::move(index);
  index_error_ = error;
  changed_.notify_all();
}

MapSession::IndexState MapSession::indexState() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {index_ ? 1.0 : progress_.load(), index_ != nullptr, index_error_};
}

MapIndex::Ptr MapSession::index(const std::atomic<bool>& cancelled) const {
  constexpr std::chrono::milliseconds kLook(20);  // whether nobody waits any more
  std::unique_lock<std::mutex> lock(mutex_);
  while (!index_) {
    if (!index_error_.empty()) throw ApiError(500, "no_index", "", index_error_);
    if (cancelled) throw superseded();
    changed_.wait_for(lock, kLook);
  }
  return index_;
}

LocalizationResult MapSession::localize(const ScanSet& scans, const SearchRequest& search,
                                        const std::atomic<bool>& cancelled) const {
  SearchOptions options;
  options.max_hypotheses = search.max_hypotheses;
  options.time_budget_ms = search.time_budget_ms;
  options.cancel = &cancelled;
  options.threads = 0;  // somebody waits for it
  options.metric = search.metric;
  options.keep_regions = search.keep_regions;
  if (search.method == Method::exact) {
    throw ApiError(400, "bad_request", "options.method",
                   "options.method: exact searches for a polygon (member polygon), not for a scan");
  }
  const MapIndex::Ptr index = this->index(cancelled);
  const RangeScan* const single = scans.single();
  if (search.method == Method::certified) {
    const GlobalLocalizer localizer(index);
    return single != nullptr ? localizer.localize(*single, search.prior, options)
                             : localizer.localize(scans, search.prior, options);
  }
  if (single == nullptr) {
    throw ApiError(400, "bad_request", "options.method",
                   "options.method: cells searches for one scan, not for several");
  }
  const auto& cell_localizer = cell_localizer_.get([&] {
    CellLocalizerParams params;
    params.max_cells = kMostCells;
    return std::make_unique<CellLocalizer>(index, params);
  });
  return cell_localizer->localize(*single, search.prior, options);
}

LocalizationResult MapSession::localizeExact(const std::vector<TPoint2D>& view,
                                             const SearchRequest& search) const {
  const auto& localizer =
      exact_localizer_.get([&] { return std::make_unique<ExactLocalizer>(map_); });
  return resultOf(localizer->localize(view, search.prior), localizer->tolerance(),
                  search.max_hypotheses);
}

std::shared_ptr<const TravelPlanner> MapSession::planner(const MapIndex::Ptr& index,
                                                         const TravelPlannerParams& params) const {
  const std::lock_guard<std::mutex> lock(planner_mutex_);
  const auto isSame = [&](const TravelPlannerParams& other) {
    return other.strategy == params.strategy && other.max_range == params.max_range &&
           other.safe.robot_radius == params.safe.robot_radius;
  };
  if (!planner_ || !isSame(planner_->params())) {
    planner_ = std::make_shared<const TravelPlanner>(index, params);
  }
  return planner_;
}

const Triangulation& MapSession::triangulation() const {
  return triangulation_.get([&] { return Triangulation(map_); });
}

const WallSegments& MapSession::walls() const {
  return walls_.get([&] { return WallSegments(map_); });
}

const VisibilityCells& MapSession::cells() const {
  return *cells_.get([&] {
    VisibilityCellsParams params;
    params.max_cells = kMostCells;
    params.range = VisibilityCells::greatestRange(map_, kMostCells);
    return std::make_unique<VisibilityCells>(map_, params);
  });
}

}  // namespace mrpt_polyloc::apps
