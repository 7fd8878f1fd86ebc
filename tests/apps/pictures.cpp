#include "pictures.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <png.h>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> gray;
};

Picture readPicture(const std::string& path) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
  image.format = PNG_FORMAT_GRAY;
  Picture picture{image.width, image.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&image, &white, picture.gray.data(), 0, nullptr) == 0) return {};
  return picture;
}

constexpr std::size_t kBlock = 8;

double meanOf(const Picture& picture, std::size_t column, std::size_t row) {
  double sum = 0.0;
  for (std::size_t y = row * kBlock; y < (row + 1) * kBlock; ++y) {
    for (std::size_t x = column * kBlock; x < (column + 1) * kBlock; ++x) {
      sum += picture.gray[y * picture.width + x];
    }
  }
  return sum / (kBlock * kBlock);
}

}  // namespace

double shareOfOtherBlocks(const std::string& png, const std::string& other_png) {
  const Picture a = readPicture(png), b = readPicture(other_png);
  if (a.gray.empty() || a.width != b.width || a.height != b.height) return 1.0;
  constexpr double kDifference = 255.0 / 20.0;
  const std::size_t columns = a.width / kBlock, rows = a.height / kBlock;
  std::size_t other = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      other += std::abs(meanOf(a, column, row) - meanOf(b, column, row)) > kDifference ? 1 : 0;
    }
  }
  return static_cast<double>(other) / static_cast<double>(columns * rows);
}

}  // namespace mrpt_polyloc::test
