#include "tests/support/bridge_files.h"

#include <mrpt_polyloc/base/errors.h>

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdlib.h>
#include <zlib.h>

namespace mrpt_polyloc::test {

TempDir::TempDir() {
  std::string pattern = (std::filesystem::temp_directory_path() / "polyloc_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TempDir::~TempDir() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void writeFile(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::runtime_error("cannot write " + path);
}

std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string gzipped(const std::string& content) {
  z_stream z{};
  deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&z, content.size()) + 32, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  z.avail_in = static_cast<uInt>(content.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

std::string serialised(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << object;
  return {static_cast<const char*>(stream.getRawBufferData()),
          static_cast<std::size_t>(stream.getTotalBytesCount())};
}

namespace {

std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xffU);
  return bytes;
}

std::string pngChunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return bigEndian(static_cast<std::uint32_t>(data.size())) + body +
         bigEndian(static_cast<std::uint32_t>(sum));
}

}  // namespace

std::string pngFile(std::uint32_t width, std::uint32_t height, int bit_depth, int colour_type,
                    const std::string& rows) {
  const std::size_t row_bytes = rows.size() / height;
  std::string filtered;
  for (std::size_t row = 0; row < height; ++row) {
    filtered += '\0' + rows.substr(row * row_bytes, row_bytes);
  }
  std::string packed(compressBound(filtered.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(filtered.data()), filtered.size());
  packed.resize(size);
  const std::string header = bigEndian(width) + bigEndian(height) + static_cast<char>(bit_depth) +
                             static_cast<char>(colour_type) + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + pngChunk("IDAT", packed) +
         pngChunk("IEND", "");
}

std::string formatErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const FormatError& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another exception: " << error.what();
  }
  return "";
}

mrpt::obs::CObservation2DRangeScan randomObservation(std::mt19937& random, std::size_t beams,
                                                     const std::string& label) {
  std::uniform_real_distribution<float> range(0.1F, 30.0F);
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = std::uniform_real_distribution<float>(0.5F, 6.0F)(random);
  scan.rightToLeft = random() % 2 == 0;
  scan.maxRange = 25.0F;
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  scan.sensorPose =
      mrpt::poses::CPose3D(place(random), place(random), 0.3, 3.0 * place(random), 0, 0);
  scan.sensorLabel = label;
  scan.timestamp = mrpt::Clock::fromDouble(1.6e9 + range(random));
  scan.resizeScanAndAssign(beams, 0.0F, false);
  for (std::size_t i = 0; i < beams; ++i) {
    const float reading = range(random);
    scan.setScanRange(i, reading);
    scan.setScanRangeValidity(i, random() % 8 != 0 && reading < scan.maxRange);
  }
  return scan;
}

namespace {

bool sameBeam(const Beam& a, const Beam& b) {
  return a.kind == b.kind && std::abs(a.bearing - b.bearing) < 1e-6 &&
         std::abs(a.range - b.range) < 1e-5;
}

}  // namespace

bool sameScans(const std::vector<RangeScan>& a, const std::vector<RangeScan>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& s, const auto& t) {
    return s.label() == t.label() && std::abs(s.stamp() - t.stamp()) < 1e-5 &&
           std::abs(s.sensor().x - t.sensor().x) < 1e-9 &&
           std::abs(s.sensor().y - t.sensor().y) < 1e-9 &&
           std::equal(s.beams().begin(), s.beams().end(), t.beams().begin(), t.beams().end(),
                      sameBeam);
  });
}

}  // namespace mrpt_polyloc::test
