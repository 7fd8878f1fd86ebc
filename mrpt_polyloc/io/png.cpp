#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/gray_image.h>

#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <png.h>

namespace mrpt_polyloc {

namespace {

constexpr std::size_t kHeaderSize = 33;  // signature, and the chunk IHDR, which begins with sizes

std::uint32_t bigEndian(const std::string& data, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    value = value << 8U | static_cast<unsigned char>(data[at + k]);
  }
  return value;
}

/// What libpng reads from, and what it has to say. It is C: an error jumps back over its functions,
/// so nothing between here and there may need a destructor.
struct Reading {
  const std::string* data = nullptr;
  std::size_t next = 0;
  bool truncated = false;
  char message[160] = "";
};

void onError(png_structp png, png_const_charp message) {
  auto* reading = static_cast<Reading*>(png_get_error_ptr(png));
  std::strncpy(reading->message, message, sizeof(reading->message) - 1);
  png_longjmp(png, 1);
}

/// Of chunks that do not matter to the levels libpng only warns.
void onWarning(png_structp /*png*/, png_const_charp /*message*/) {}

void onRead(png_structp png, png_bytep bytes, std::size_t count) {
  auto* reading = static_cast<Reading*>(png_get_io_ptr(png));
  if (count > reading->data->size() - reading->next) {
    reading->truncated = true;
    png_error(png, "truncated");
  }
  std::memcpy(bytes, reading->data->data() + reading->next, count);
  reading->next += count;
}

/// The decoder, freed on every way out.
class Decoder {
 public:
  explicit Decoder(Reading& reading)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, onError, onWarning)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) throw std::bad_alloc();
    png_set_read_fn(png_, &reading, onRead);
    // Checksums are checked, for all that is read; the sizes are checked by us.
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_user_limits(png_, 0x7fffffffU, 0x7fffffffU);
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  // Each returns false where libpng gave up.
  bool readHeader() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_info(png_, info_);
    // Only unpacked, nothing is changed: palettes to colours, bits to bytes, keys to alpha.
    if (png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (png_get_bit_depth(png_, info_) < 8) png_set_expand_gray_1_2_4_to_8(png_);
    if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(png_);
    png_set_interlace_handling(png_);
    return true;
  }
  bool unpack() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_update_info(png_, info_);
    return true;
  }
  bool readRows(unsigned char** rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
  unsigned channels() const { return png_get_channels(png_, info_); }
  bool isDeep() const { return png_get_bit_depth(png_, info_) == 16; }

 private:
  png_structp png_;
  png_infop info_;
};

/// Samples of one or two bytes, the high one first, summed over the colours.
GrayImage toGray(const std::vector<unsigned char>& bytes, std::size_t width, std::size_t height,
                 unsigned channels, bool deep) {
  const std::uint32_t white = deep ? 65535 : 255;
  const unsigned colours = channels >= 3 ? 3 : 1;  // a channel behind them is alpha
  GrayImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.max_value = white * colours;
  image.values.reserve(width * height);
  const unsigned char* next = bytes.data();
  const auto sample = [&] {
    const std::uint32_t high = *next++;
    return deep ? high << 8U | *next++ : high;
  };
  for (std::size_t i = 0; i < width * height; ++i) {
    std::uint32_t sum = 0;
    for (unsigned k = 0; k < colours; ++k) sum += sample();
    image.values.push_back(sum);
    if (channels == colours) continue;
    const std::uint32_t alpha = sample();
    image.opacity.push_back(alpha == 0       ? Opacity::transparent
                            : alpha == white ? Opacity::opaque
                                             : Opacity::partial);
  }
  return image;
}

}  // namespace

GrayImage decodePng(const std::string& path, const std::string& data) {
  Reading reading;
  reading.data = &data;
  const auto fail = [&]() {
    throw FormatError(path, "byte " + std::to_string(reading.next),
                      reading.truncated ? "truncated: the end of the PNG is missing"
                                        : "damaged PNG: " + std::string(reading.message));
  };
  const auto refuse = [&](const std::string& reason) { throw FormatError(path, "", reason); };
  if (data.size() < kHeaderSize) refuse("truncated: the PNG's header is not whole");
  const std::size_t width = bigEndian(data, 16), height = bigEndian(data, 20);
  if (width == 0 || height == 0) refuse("the image has no pixel");
  if (width > static_cast<std::size_t>(kMaxBitmapCells) / height) {
    refuse("more than " + std::to_string(kMaxBitmapCells) + " pixels");
  }
  Decoder decoder(reading);
  if (!decoder.readHeader() || !decoder.unpack()) fail();
  // No memory for a damaged size: zlib packs at most a thousand to one.
  if (decoder.rowBytes() * height / 1100 > data.size()) refuse("truncated: it is too short");
  std::vector<unsigned char> bytes(decoder.rowBytes() * height);
  std::vector<unsigned char*> rows(height);
  for (std::size_t i = 0; i < height; ++i) rows[i] = bytes.data() + i * decoder.rowBytes();
  if (!decoder.readRows(rows.data())) fail();
  return toGray(bytes, width, height, decoder.channels(), decoder.isDeep());
}

}  // namespace mrpt_polyloc
