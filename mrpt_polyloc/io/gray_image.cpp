#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/gray_image.h>
#include <mrpt_polyloc/io/mrpt_archive.h>

#include <mrpt/img/CImage.h>

#include <cstddef>
#include <filesystem>

namespace mrpt_polyloc {

namespace {

bool startsWith(const std::string& data, const std::string& head) {
  return data.compare(0, head.size(), head) == 0;
}

/// Kinds that MRPT reads, if it was built with them.
bool isMrptsKind(const std::string& data) {
  return startsWith(data, "BM") || startsWith(data, "\xff\xd8\xff") ||
         startsWith(data, std::string("II*\0", 4)) || startsWith(data, std::string("MM\0*", 4));
}

std::uint32_t littleEndian(const std::string& data, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) {
    value = value << 8U | static_cast<unsigned char>(data[at + k]);
  }
  return value;
}

/// Whether the end is missing: OpenCV, with which MRPT decodes, prints then, and shows half of it.
bool isTruncated(const std::string& data) {
  if (startsWith(data, "BM")) {
    constexpr std::size_t kHeaders = 54;
    return data.size() < kHeaders || data.size() < littleEndian(data, 2) ||
           data.size() <= littleEndian(data, 10);
  }
  if (startsWith(data, "\xff\xd8")) return data.rfind("\xff\xd9") == std::string::npos;
  return data.size() < 16;  // of a TIFF no more can be told
}

GrayImage loadByMrpt(const std::string& path, const std::string& data) {
  if (isTruncated(data)) throw FormatError(path, "", "truncated: the end of the image is missing");
  mrpt::img::CImage image;
  bool loaded = false;
  try {
    loaded = image.loadFromFile(path);
  } catch (const std::exception& error) {
    throw FormatError(path, "", "the image cannot be decoded: " + plainMessage(error));
  }
  if (!loaded || image.isEmpty()) {
    throw FormatError(path, "",
                      "the image cannot be decoded: damaged, or of a kind that this "
                      "MRPT does not read");
  }
  if (image.getPixelDepth() != mrpt::img::PixelDepth::D8U) {
    throw FormatError(path, "", "the image has more than 8 bits: store it as .png or .pgm");
  }
  const std::uint64_t width = image.getWidth(), height = image.getHeight();
  if (width * height > static_cast<std::uint64_t>(kMaxBitmapCells)) {
    throw FormatError(path, "", "more than " + std::to_string(kMaxBitmapCells) + " pixels");
  }
  const mrpt::img::CImage gray = image.isColor() ? image.grayscale() : std::move(image);
  GrayImage result;
  result.width = static_cast<int>(width);
  result.height = static_cast<int>(height);
  result.max_value = 255;
  result.values.reserve(width * height);
  for (unsigned row = 0; row < height; ++row) {
    const auto* pixel = gray.ptrLine<std::uint8_t>(row);
    result.values.insert(result.values.end(), pixel, pixel + width);
  }
  return result;
}

}  // namespace

GrayImage loadImage(const std::string& path) {
  const std::string data = GzInputStream(path).readAll();
  if (startsWith(data, "\x89PNG")) return decodePng(path, data);
  if (data.size() >= 2 && data[0] == 'P' && data[1] >= '1' && data[1] <= '7') {
    return decodePgm(path, data);
  }
  if (isMrptsKind(data)) return loadByMrpt(path, data);
  throw FormatError(path, "",
                    "its first bytes are of no kind of image that is known: those are "
                    ".pgm, .ppm, .png, .bmp, .jpg and .tif");
}

}  // namespace mrpt_polyloc
