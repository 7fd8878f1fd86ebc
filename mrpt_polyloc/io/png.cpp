#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/gray_image.h>
#include <mrpt_polyloc/io/mrpt_archive.h>

#include <mrpt/img/CImage.h>

#include <cstddef>
#include <limits>
#include <zlib.h>

namespace mrpt_polyloc {

namespace {

std::uint32_t bigEndian(const std::string& data, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = value << 8U | static_cast<unsigned char>(data[at + k]);
  return value;
}

/// Checks that all chunks of the file are there and whole, and that the image is of a modest size:
/// the decoder prints on what is truncated or damaged, and may show half of the image.
void checkPng(const std::string& path) {
  const std::string data = GzInputStream(path).readAll();
  const auto fail = [&](std::size_t at, const std::string& reason) {
    throw FormatError(path, "byte " + std::to_string(at), reason);
  };
  if (data.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0) fail(0, "not a PNG image");
  bool has_pixels = false;
  for (std::size_t at = 8;;) {
    if (data.size() - at < 12) fail(data.size(), "truncated: the end of the PNG is missing");
    const std::size_t length = bigEndian(data, at);
    if (data.size() - at - 12 < length) fail(data.size(), "truncated inside a chunk of the PNG");
    const auto* chunk = reinterpret_cast<const Bytef*>(data.data()) + at + 4;
    const auto sum = crc32(crc32(0, nullptr, 0), chunk, static_cast<uInt>(length + 4));
    if (sum != bigEndian(data, at + 8 + length)) fail(at, "damaged chunk of the PNG (checksum)");
    const std::string type = data.substr(at + 4, 4);
    if ((at == 8) != (type == "IHDR") || (type == "IHDR" && length != 13)) {
      fail(at, "the PNG's header is missing or out of place");
    }
    if (type == "IHDR") {
      const std::uint64_t width = bigEndian(data, at + 8), height = bigEndian(data, at + 12);
      if (width == 0 || height == 0) fail(at, "the image has no pixel");
      if (width * height > static_cast<std::uint64_t>(kMaxBitmapCells)) {
        fail(at, "more than " + std::to_string(kMaxBitmapCells) + " pixels");
      }
    }
    has_pixels |= type == "IDAT";
    if (type == "IEND") break;
    at += length + 12;
  }
  if (!has_pixels) fail(data.size(), "the PNG holds no pixels");
}

template <typename Level>
GrayImage toGray(const mrpt::img::CImage& source) {
  constexpr std::uint32_t kWhite = std::numeric_limits<Level>::max();
  const auto channels = static_cast<unsigned>(source.channelCount());
  const unsigned colours = channels >= 3 ? 3 : 1;  // a channel behind them is alpha
  GrayImage image;
  image.width = static_cast<int>(source.getWidth());
  image.height = static_cast<int>(source.getHeight());
  image.max_value = kWhite * colours;
  image.values.reserve(source.getWidth() * source.getHeight());
  for (unsigned row = 0; row < source.getHeight(); ++row) {
    const Level* pixel = source.ptrLine<Level>(row);
    for (unsigned column = 0; column < source.getWidth(); ++column, pixel += channels) {
      std::uint32_t sum = 0;
      for (unsigned k = 0; k < colours; ++k) sum += pixel[k];
      image.values.push_back(sum);
      if (channels == colours) continue;
      const std::uint32_t alpha = pixel[colours];
      image.opacity.push_back(alpha == 0        ? Opacity::transparent
                              : alpha == kWhite ? Opacity::opaque
                                                : Opacity::partial);
    }
  }
  return image;
}

}  // namespace

GrayImage loadPng(const std::string& path) {
  checkPng(path);
  mrpt::img::CImage image;
  bool loaded = false;
  try {
    loaded = image.loadFromFile(path);
  } catch (const std::exception& error) {
    throw FormatError(path, "", "the PNG cannot be decoded: " + plainMessage(error));
  }
  if (!loaded || image.isEmpty()) throw FormatError(path, "", "the PNG cannot be decoded");
  return image.getPixelDepth() == mrpt::img::PixelDepth::D16U ? toGray<std::uint16_t>(image)
                                                              : toGray<std::uint8_t>(image);
}

}  // namespace mrpt_polyloc
