#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/search/search_index_file.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr char kMagic[8] = {'P', 'L', 'C', 'E', 'L', 'L', 'S', '\n'};
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);

/// 64-bit FNV-1a, over words of eight bytes for speed, the last ones padded with zeros.
std::uint64_t checksum(const char* data, std::size_t size) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + i, std::min(sizeof(word), size - i));
    hash = (hash ^ word) * 0x100000001B3U;
    hash ^= hash >> 29;
  }
  return hash;
}

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    content.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    content.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  std::string content;
};

class Reader {
 public:
  Reader(const std::string& content, const std::string& file) : content_(content), file_(file) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw FormatError(file_, "byte " + std::to_string(at_), reason);
  }
  void take(void* to, std::size_t size) {
    if (size > content_.size() - kChecksumBytes - at_) fail("the file ends too early");
    std::memcpy(to, content_.data() + at_, size);
    at_ += size;
  }
  template <class T>
  T take() {
    T value{};
    take(&value, sizeof(T));
    return value;
  }
  template <class T>
  void take(std::vector<T>& values) {
    const auto count = take<std::uint64_t>();
    if (count > content_.size() / sizeof(T)) fail("an array is longer than the file");
    values.resize(count);
    take(values.data(), count * sizeof(T));
  }
  std::size_t left() const { return content_.size() - kChecksumBytes - at_; }

 private:
  const std::string& content_;
  const std::string& file_;
  std::size_t at_ = 0;
};

/// The arrays of an index, in the order of the file. The types are const, or not.
template <class Lists, class Data, class Action>
void forEachArray(Lists& edges, Data& tree, Action&& action) {
  action(edges.of_square);
  action(edges.begin);
  action(edges.runs);
  action(tree.vertices);
  action(tree.first_vertex);
  for (auto& level : tree.levels) {
    action(level.nodes);
    action(level.boxes);
    action(level.codes);
  }
  action(tree.views);
}

}  // namespace

std::string serializeIndex(const VisibleEdgeIndex::Lists& edges, const SearchTree::Data& tree,
                           std::uint64_t map_hash) {
  Writer writer;
  writer.content.append(kMagic, sizeof(kMagic));
  writer.put(kVersion);
  writer.put(static_cast<std::uint32_t>(kBandBins));
  writer.put(map_hash);
  writer.put(edges.square_size);
  writer.put(tree.leaf_size);
  forEachArray(edges, tree, [&writer](const auto& array) { writer.put(array); });
  writer.put(checksum(writer.content.data(), writer.content.size()));
  return std::move(writer.content);
}

SearchIndex parseIndex(const std::string& content, const std::string& file,
                       std::uint64_t map_hash) {
  if (content.size() < sizeof(kMagic) || std::memcmp(content.data(), kMagic, sizeof(kMagic)) != 0) {
    throw FormatError(file, "byte 0", "not a search index");
  }
  if (content.size() < sizeof(kMagic) + 40 + kChecksumBytes) {
    throw FormatError(file, "byte " + std::to_string(content.size()), "the file ends too early");
  }
  Reader reader(content, file);
  char magic[sizeof(kMagic)];
  reader.take(magic, sizeof(magic));
  const auto version = reader.take<std::uint32_t>();
  if (version != kVersion) {
    reader.fail("version " + std::to_string(version) + " of the index; this program reads " +
                std::to_string(kVersion));
  }
  if (reader.take<std::uint32_t>() != kBandBins) reader.fail("another number of angular bins");
  if (reader.take<std::uint64_t>() != map_hash) reader.fail("the index of another map");
  SearchIndex index;
  index.edges.square_size = reader.take<double>();
  index.tree.leaf_size = reader.take<double>();
  forEachArray(index.edges, index.tree, [&reader](auto& array) { reader.take(array); });
  if (reader.left() != 0) reader.fail("more than the index follows");
  std::uint64_t stored = 0;
  const std::size_t end = content.size() - kChecksumBytes;
  std::memcpy(&stored, content.data() + end, kChecksumBytes);
  if (stored != checksum(content.data(), end)) reader.fail("damaged: the checksum does not match");
  return index;
}

}  // namespace mrpt_polyloc
