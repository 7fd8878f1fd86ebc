#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// An SVG picture of a piece of the plane: metres, y up, sizes of strokes and signs in pixels.
///
/// What is drawn later lies on top. Styles are classes, see styleSheet() in the source.
class SvgCanvas {
 public:
  /// \param view what must be seen [m]; a margin is added. The longer side has about 1200 pixels.
  /// \param unit of the scale bar
  explicit SvgCanvas(const BoundingBox& view, std::string unit = "m");

  double metresPerPixel() const { return 1.0 / scale_; }

  /// Closed rings, filled by the even-odd rule.
  void area(const std::vector<std::vector<TPoint2D>>& rings, const std::string& style);
  /// Open chains as one path.
  void lines(const std::vector<Polyline>& chains, const std::string& style);
  /// Discs of a radius in pixels.
  void dots(const std::vector<TPoint2D>& centers, double radius_px, const std::string& style);
  /// A text whose left end lies so many pixels right of and above a point.
  void label(const TPoint2D& at, double right_px, double up_px, const std::string& text,
             const std::string& style);

  /// One line of the legend: a sample of the style and what it means.
  enum class Sample { line, dot, patch };
  void legend(Sample sample, const std::string& style, const std::string& meaning);

  /// The whole file, with scale bar and legend below the picture.
  std::string text() const;

 private:
  struct LegendEntry {
    Sample sample;
    std::string style;
    std::string meaning;
  };
  std::string scaleBar(double y_px) const;
  std::string legendRow(double y_px) const;

  BoundingBox view_;
  std::string unit_;
  double scale_;      ///< pixels per metre
  double width_px_;   ///< of the map's part
  double height_px_;  ///< of the map's part
  std::string shapes_;
  std::string labels_;
  std::vector<LegendEntry> legend_;
};

}  // namespace mrpt_polyloc::apps
