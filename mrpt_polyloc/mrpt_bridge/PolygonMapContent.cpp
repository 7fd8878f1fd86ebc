#include <mrpt_polyloc/geometry/validation.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
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
      MapIndex::deferred(repairMap(parseGeoJson(text, "stored CPolygonMap2D")).map));
  textOf(content);
  return content;
}

const std::string& PolygonMapContent::textOf(const Ptr& content) {
  if (content->text_.isMade()) return content->text_.value();
  // Added once it is made: what is alive is asked for its text, by other threads at once.
  const std::string& text = content->text_.get([&] { return toGeoJson(content->map()); });
  living().add(text, content);
  return text;
}

const RangePredictor& PolygonMapContent::predictor() const {
  return index_->parts().predictor();
}

}  // namespace mrpt_polyloc
