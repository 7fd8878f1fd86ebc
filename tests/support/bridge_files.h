#pragma once

#include <mrpt_polyloc/io/scan_files.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {

/// A folder of its own for one test, removed with all in it.
class TempDir {
 public:
  TempDir();
  ~TempDir();
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;

  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

void writeFile(const std::string& path, const std::string& bytes);
std::string readFile(const std::string& path);
std::string gzipped(const std::string& content);

/// MRPT's serialisation of one object.
std::string serialised(const mrpt::serialization::CSerializable& object);

/// A PNG file by its specification; `rows` are the raw samples without filter bytes.
std::string pngFile(std::uint32_t width, std::uint32_t height, int bit_depth, int colour_type,
                    const std::string& rows);

/// A test that fails if anything is printed to stderr, as MRPT does where it meets a bad file.
class QuietTest : public testing::Test {
 protected:
  void SetUp() override { testing::internal::CaptureStderr(); }
  void TearDown() override { EXPECT_EQ(testing::internal::GetCapturedStderr(), ""); }

  test::TempDir dir_;
};

/// The FormatError message that `action` throws, "" if it throws none; another exception fails the
/// test.
std::string formatErrorOf(const std::function<void()>& action);

/// A scan of random ranges and flags with this label.
mrpt::obs::CObservation2DRangeScan randomObservation(std::mt19937& random, std::size_t beams,
                                                     const std::string& label = "LASER");

/// To read the scans of one sensor only.
inline ScanFileOptions ofSensor(const std::string& label) {
  ScanFileOptions options;
  options.sensor_label = label;
  return options;
}

/// Whether two lists of scans are the same in all but rounding.
bool sameScans(const std::vector<RangeScan>& a, const std::vector<RangeScan>& b);

}  // namespace mrpt_polyloc::test
