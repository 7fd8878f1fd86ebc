#pragma once

#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// The finite number a whole text is, if it is one: parseNumber() for options.
std::optional<double> parseFinite(const std::string& text);

bool endsWith(const std::string& text, const std::string& tail);

/// A row or an inclusive range of rows (0-based).
struct RowRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

/// `I,J-K`: rows and inclusive ranges of rows, 0-based.
/// \throws UsageError naming the part that is neither.
std::vector<RowRange> parseRows(const std::string& text);

/// The rows of [0, count) that the ranges name, ascending, each once; ranges are clipped at the
/// end.
std::vector<std::size_t> selectRows(const std::vector<RowRange>& ranges, std::size_t count);

/// `X,Y,R`: the robot is within R > 0 of (X, Y) [m].
/// \throws UsageError
PosePrior::Disk parseDisk(const std::string& text);

/// `X,Y`: a point of the map [m], for an option of that name.
/// \throws UsageError
mrpt::math::TPoint2D parsePoint(const std::string& option, const std::string& text);

/// `A,B,C`: errors of wheels, metres a metre, degrees a metre, degrees a radian turned.
/// \throws UsageError
MotionNoise parseMotionNoise(const std::string& text);

/// `M,DEG`: a tolerance, both positive, at most 180 degrees.
/// \throws UsageError
Tolerance parseTolerance(const std::string& text);

}  // namespace mrpt_polyloc::apps
