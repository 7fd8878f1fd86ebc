#include <mrpt_polyloc/base/Checksum.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/search/search_index_file.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr char kMagic[8] = {'P', 'L', 'C', 'E', 'L', 'L', 'S', '\n'};  // as in version 1
constexpr std::uint32_t kVersion = 5;

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(&value, sizeof(T));
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    put(values.data(), values.size() * sizeof(T));
  }
  void putChecksum() { put(checksum_.value()); }

 private:
  void put(const void* data, std::size_t size) {
    checksum_.add(data, size);
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  }

  std::ostream& out_;
  Checksum checksum_;
};

class Reader {
 public:
  Reader(std::istream& in, const std::string& file) : in_(in), file_(file) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw FormatError(file_, "byte " + std::to_string(at_), reason);
  }
  void takeMagic() {
    char magic[sizeof(kMagic)] = {};
    in_.read(magic, sizeof(magic));
    if (std::memcmp(magic, kMagic, sizeof(kMagic)) != 0) fail("not a search index");
    checksum_.add(magic, sizeof(magic));
    at_ = sizeof(magic);
  }
  void take(void* to, std::size_t size) {
    in_.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    const auto got = static_cast<std::size_t>(in_.gcount());
    checksum_.add(to, got);
    at_ += got;
    if (got < size) fail("the file ends too early");
  }
  template <class T>
  T take() {
    T value{};
    take(&value, sizeof(T));
    return value;
  }
  template <class T>
  void take(std::vector<T>& values) {
    // Piece by piece, as a damaged count may be of any size.
    constexpr std::uint64_t kPiece = (std::uint64_t{1} << 24) / sizeof(T);
    const auto count = take<std::uint64_t>();
    values.reserve(static_cast<std::size_t>(std::min(count, kPiece)));
    while (values.size() < count) {
      const std::size_t filled = values.size();
      const auto more = static_cast<std::size_t>(std::min(count - filled, kPiece));
      if (values.capacity() < filled + more)
        values.reserve(std::min(count, 4 * kPiece + 2 * filled));
      values.resize(filled + more);
      take(values.data() + filled, more * sizeof(T));
    }
  }
  void requireChecksum() {
    const std::uint64_t computed = checksum_.value();
    if (take<std::uint64_t>() != computed) fail("damaged: the checksum does not match");
  }
  void requireEnd() {
    if (in_.peek() != std::istream::traits_type::eof()) fail("more than the index follows");
  }

 private:
  std::istream& in_;
  const std::string& file_;
  Checksum checksum_;
  std::size_t at_ = 0;
};

/// The arrays of an index, in the order of the file. The types are const, or not.
template <class Lists, class Data, class Action>
void forEachArray(Lists& edges, Data& tree, Action&& action) {
  action(edges.squares);
  action(edges.begin);
  action(edges.runs);
  action(tree.vertices);
  action(tree.first_vertex);
  for (auto& level : tree.levels) {
    action(level.nodes);
    action(level.boxes);
    action(level.codes);
  }
  action(tree.first_view);
  action(tree.views);
}

}  // namespace

void writeIndex(std::ostream& out, const VisibleEdgeIndex::Lists& edges,
                const SearchTree::Data& tree, std::uint64_t map_hash) {
  Writer writer(out);
  writer.put(kMagic);
  writer.put(kVersion);
  writer.put(static_cast<std::uint32_t>(kBandBins));
  writer.put(map_hash);
  writer.put(edges.layout);
  writer.put(edges.square_size);
  writer.put(edges.horizon);
  writer.put(tree.leaf_size);
  forEachArray(edges, tree, [&writer](const auto& array) { writer.put(array); });
  writer.putChecksum();
}

SearchIndex readIndex(std::istream& in, const std::string& file, std::uint64_t map_hash) {
  Reader reader(in, file);
  reader.takeMagic();
  const auto version = reader.take<std::uint32_t>();
  if (version != kVersion) {
    reader.fail("version " + std::to_string(version) + " of the index; this program reads " +
                std::to_string(kVersion));
  }
  if (reader.take<std::uint32_t>() != kBandBins) reader.fail("another number of angular bins");
  if (reader.take<std::uint64_t>() != map_hash) reader.fail("the index of another map");
  SearchIndex index;
  index.edges.layout = reader.take<std::uint64_t>();
  index.edges.square_size = reader.take<double>();
  index.edges.horizon = reader.take<double>();
  index.tree.leaf_size = reader.take<double>();
  forEachArray(index.edges, index.tree, [&reader](auto& array) { reader.take(array); });
  reader.requireChecksum();
  reader.requireEnd();
  return index;
}

}  // namespace mrpt_polyloc
