#include <mrpt_polyloc/geometry/validation.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/mrpt_bridge/PolygonMapContent.h>

#include <functional>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// The contents that are alive, by the hash of their texts.
class LivingContents {
 public:
  PolygonMapContent::Ptr find(const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto [begin, end] = contents_.equal_range(std::hash<std::string>()(text));
    for (auto entry = begin; entry != end; ++entry) {
      auto content = entry->second.lock();
      if (content && PolygonMapContent::textOf(content) == text) return content;
    }
    return nullptr;
  }

  void add(const std::string& text, const PolygonMapContent::Ptr& content) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto entry = contents_.begin(); entry != contents_.end();) {
      entry = entry->second.expired() ? contents_.erase(entry) : std::next(entry);
    }
    contents_.emplace(std::hash<std::string>()(text), content);
  }

 private:
  std::mutex mutex_;
  std::unordered_multimap<std::size_t, std::weak_ptr<const PolygonMapContent>> contents_;
};

/// Never destroyed: maps in static storage may be stored after main().
LivingContents& living() {
  static auto* contents = new LivingContents;
  return *contents;
}

}  // namespace

PolygonMapContent::Ptr PolygonMapContent::fromText(const std::string& text) {
  if (Ptr shared = living().find(text)) return shared;
  const auto content = std::make_shared<const PolygonMapContent>(
      repairMap(parseGeoJson(text, "stored CPolygonMap2D")).map);
  textOf(content);
  return content;
}

const std::string& PolygonMapContent::textOf(const Ptr& content) {
  std::call_once(content->text_made_, [&] {
    content->text_ = toGeoJson(content->map_);
    living().add(content->text_, content);
  });
  return content->text_;
}

const RangePredictor& PolygonMapContent::predictor() const {
  // The predictor's threads are those of a task arena of its own: the one that makes it takes no
  // task of a caller's parallel loop meanwhile, which might wait for the same flag.
  std::call_once(predictor_made_, [this] { predictor_.emplace(Triangulation(map_)); });
  return *predictor_;
}

}  // namespace mrpt_polyloc
