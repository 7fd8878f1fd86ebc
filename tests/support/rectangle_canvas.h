#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <vector>

namespace mrpt_polyloc::test {

/// What a part of the canvas is: not free (walls between), free, or unknown (open edges between).
enum class Paint { solid, free, unknown };

/// Rectangles painted over one another on a solid ground, and the free space that results, with
/// its borders traced exactly: an independent way to maps with known area.
class RectangleCanvas {
 public:
  void paint(double x0, double y0, double x1, double y1, Paint paint);

  /// What was painted last at a point.
  Paint at(const TPoint2D& point) const;

  /// The free space. Free parts that touch only at a corner are not joined there.
  std::vector<FreePolygon> freeSpace() const;

  /// Of the free space [m2], by summing rectangles.
  double freeArea() const;

 private:
  struct Rectangle {
    double x0, y0, x1, y1;
    Paint paint;
  };
  /// The canvas cut along all sides of all rectangles: cell (c, r) spans xs[c], xs[c + 1].
  struct Cells {
    std::vector<double> xs, ys;
    std::vector<Paint> paints;
    int columns() const { return static_cast<int>(xs.size()) - 1; }
    int rows() const { return static_cast<int>(ys.size()) - 1; }
    Paint at(int column, int row) const;
  };
  Cells cells() const;

  std::vector<Rectangle> rectangles_;
};

/// Puts a ring into the polygons: an outer ring as a new one, a hole into the smallest polygon that
/// holds its first vertex.
void addRing(std::vector<FreePolygon>& polygons, Ring ring);

}  // namespace mrpt_polyloc::test
