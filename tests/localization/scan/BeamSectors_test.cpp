#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/scan/BeamSectors.h>

#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

std::vector<Beam> beamsAt(const std::vector<double>& degrees) {
  std::vector<Beam> beams;
  for (const double d : degrees) beams.push_back({d * kPi / 180.0, 1.0, BeamKind::hit});
  return beams;
}

std::vector<Beam> evenBeams(double first, double step, std::size_t count) {
  std::vector<double> degrees;
  for (std::size_t i = 0; i < count; ++i) degrees.push_back(first + step * static_cast<double>(i));
  return beamsAt(degrees);
}

TEST(BeamSectors, AreSectorsOfTenDegrees) {
  EXPECT_EQ(BeamSectors(evenBeams(-180, 1, 360)).count(), 36U);
  EXPECT_EQ(BeamSectors(evenBeams(-180, 0.25, 1440)).count(), 36U);
  EXPECT_EQ(BeamSectors(evenBeams(-90, 1, 180)).count(), 18U);
  EXPECT_EQ(BeamSectors(beamsAt({3, 4, 3})).count(), 1U);
  EXPECT_EQ(BeamSectors(beamsAt({})).count(), 0U);
  // Turns do not count, whichever way round.
  EXPECT_EQ(BeamSectors(beamsAt({5, 365, -355, 725})).count(), 1U);
}

TEST(BeamSectors, DifferenceByHand) {
  // Sectors with the differences {1, 3}, {2}, {6}: means 2, 2, 6, of which the scatter is 16/3.
  const BeamSectors sectors(beamsAt({1, 2, 15, 101}));
  const PairedDifference difference = sectors.difference({0, 0, 1, 1}, {1, 3, 3, 7});
  EXPECT_DOUBLE_EQ(difference.mean, 3.0);
  EXPECT_NEAR(difference.standard_error, std::sqrt(16.0 / 3.0 / 3.0), 1e-12);
}

TEST(BeamSectors, NothingIsSureInOneSector) {
  const PairedDifference difference = BeamSectors(beamsAt({1, 2})).difference({1, 1}, {0, 0});
  EXPECT_EQ(difference.mean, -1.0);
  EXPECT_EQ(difference.standard_error, 1.0);
  EXPECT_EQ(BeamSectors({}).difference({}, {}).standard_error, 0.0);
}

TEST(BeamSectors, RepeatedBeamsChangeNothing) {
  const auto once = evenBeams(-180, 2, 180);
  std::vector<Beam> thrice;
  std::vector<float> a, b, a3, b3;
  for (std::size_t i = 0; i < once.size(); ++i) {
    a.push_back(static_cast<float>(i % 7));
    b.push_back(static_cast<float>(i % 11));
    for (int k = 0; k < 3; ++k) {
      thrice.push_back(once[i]);
      a3.push_back(a.back());
      b3.push_back(b.back());
    }
  }
  const PairedDifference x = BeamSectors(once).difference(a, b);
  const PairedDifference y = BeamSectors(thrice).difference(a3, b3);
  EXPECT_NEAR(x.mean, y.mean, 1e-12);
  EXPECT_NEAR(x.standard_error, y.standard_error, 1e-12);
}

}  // namespace
}  // namespace mrpt_polyloc::test
