#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/gray_image.h>

#include <cstddef>

namespace mrpt_polyloc {

namespace {

constexpr std::int64_t kMaxLevel = 65535;

class PgmReader {
 public:
  PgmReader(const std::string& path, const std::string& data) : path_(path), data_(data) {}

  GrayImage read() {
    const std::string magic = data_.substr(0, 2);
    const bool is_colour = magic == "P3" || magic == "P6";
    if (!is_colour && magic != "P2" && magic != "P5") {
      fail("a netpbm image that is not a PGM or PPM (P2, P5, P3 or P6)");
    }
    next_ = 2;
    const std::int64_t width = number("width", kMaxBitmapCells);
    const std::int64_t height = number("height", kMaxBitmapCells);
    const std::int64_t max_value = number("greatest value", kMaxLevel);
    if (width == 0 || height == 0) fail("the image has no pixel");
    if (max_value == 0) fail("the greatest value is 0");
    if (width > kMaxBitmapCells / height) {
      fail("more than " + std::to_string(kMaxBitmapCells) + " pixels");
    }
    colours_ = is_colour ? 3 : 1;
    GrayImage image;
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
    image.max_value = static_cast<std::uint32_t>(max_value);
    magic == "P5" || magic == "P6" ? readBinary(image) : readPlain(image);
    if (is_colour) sumColours(image);
    return image;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw FormatError(path_, "", reason); }

  static bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skipSpaceAndComments() {
    while (next_ < data_.size()) {
      if (data_[next_] == '#') {
        while (next_ < data_.size() && data_[next_] != '\n' && data_[next_] != '\r') ++next_;
      } else if (isSpace(data_[next_])) {
        ++next_;
      } else {
        return;
      }
    }
  }

  std::int64_t number(const std::string& what, std::int64_t greatest) {
    skipSpaceAndComments();
    if (next_ >= data_.size()) fail("truncated: the " + what + " is missing");
    const std::size_t start = next_;
    std::int64_t value = 0;
    while (next_ < data_.size() && data_[next_] >= '0' && data_[next_] <= '9') {
      value = value * 10 + (data_[next_] - '0');
      if (value > greatest) fail("the " + what + " is above " + std::to_string(greatest));
      ++next_;
    }
    if (next_ == start) fail("the " + what + " is not a whole number of 0 or more");
    return value;
  }

  void readBinary(GrayImage& image) {
    if (next_ >= data_.size() || !isSpace(data_[next_])) {
      fail("truncated: white space and pixels are missing behind the greatest value");
    }
    ++next_;  // exactly one; the next byte is a pixel, whatever it looks like
    const std::size_t bytes = image.max_value < 256 ? 1 : 2;
    const std::size_t count =
        colours_ * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const std::size_t have = (data_.size() - next_) / bytes;
    if (have < count) failTruncated(have, count);
    image.values.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t value = 0;
      for (std::size_t k = 0; k < bytes; ++k) {
        value = value << 8U | static_cast<unsigned char>(data_[next_++]);
      }
      store(image, i, value);
    }
  }

  void readPlain(GrayImage& image) {
    const std::size_t count =
        colours_ * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    // A pixel takes two characters at least, but for the last one: no memory for a damaged size.
    if ((data_.size() - next_) / 2 + 1 < count) failTruncated((data_.size() - next_) / 2, count);
    image.values.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      skipSpaceAndComments();
      if (next_ >= data_.size()) failTruncated(i, count);
      store(image, i, static_cast<std::uint32_t>(number("pixel " + std::to_string(i), kMaxLevel)));
    }
  }

  /// One value a pixel, as map_server has it.
  static void sumColours(GrayImage& image) {
    const std::size_t count = image.values.size() / 3;
    for (std::size_t i = 0; i < count; ++i) {
      image.values[i] = image.values[3 * i] + image.values[3 * i + 1] + image.values[3 * i + 2];
    }
    image.values.resize(count);
    image.max_value *= 3;
  }

  [[noreturn]] void failTruncated(std::size_t have, std::size_t count) const {
    fail("truncated: at most " + std::to_string(have) + " of " + std::to_string(count) +
         " pixels are there");
  }

  void store(GrayImage& image, std::size_t i, std::uint32_t value) const {
    if (value > image.max_value) {
      fail("pixel " + std::to_string(i) + " is " + std::to_string(value) +
           ", above the greatest value " + std::to_string(image.max_value));
    }
    image.values[i] = value;
  }

  const std::string& path_;
  const std::string& data_;
  std::size_t colours_ = 1;
  std::size_t next_ = 0;
};

}  // namespace

GrayImage decodePgm(const std::string& path, const std::string& data) {
  return PgmReader(path, data).read();
}

}  // namespace mrpt_polyloc
