#include "SvgCanvas.h"

#include <mrpt_polyloc/base/number_text.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

constexpr double kLongSide = 1200.0;    // pixels: sharp in a README, still a screenful
constexpr double kMargin = 0.03;        // of the longer side of the view
constexpr double kFooter = 54.0;        // pixels, for scale bar and legend
constexpr double kLeastWidth = 1080.0;  // pixels: room for the legend under a narrow map

std::string number(double value, int decimals) {
  std::string digits = formatted("%.*f", decimals, value);
  if (digits.find('.') != std::string::npos) {
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  return digits == "-0" ? "0" : digits;
}

/// Map coordinates: a tenth of a millimetre is below a pixel of any picture.
std::string point(const TPoint2D& p) {
  return number(p.x, 4) + " " + number(p.y, 4);
}

std::string px(double value) {
  return number(value, 2);
}

std::string escape(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string pathData(const std::vector<std::vector<TPoint2D>>& chains, bool closed) {
  std::string data;
  for (const std::vector<TPoint2D>& chain : chains) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      data += (i == 0 ? "M" : i == 1 ? "L" : " ") + point(chain[i]);
    }
    if (closed) data += "Z";
  }
  return data;
}

/// Strokes in pixels; the shapes' group is scaled, so they are divided by the scale there.
std::string styleSheet(double scale) {
  const auto stroke = [scale](const char* name, const char* colour, double width_px,
                              const std::string& more = "") {
    return std::string(".") + name + "{fill:none;stroke:" + colour +
           ";stroke-width:" + number(width_px / scale, 6) + more + "}\n";
  };
  const auto dash = [scale](double on_px, double off_px) {
    return ";stroke-dasharray:" + number(on_px / scale, 6) + " " + number(off_px / scale, 6);
  };
  const auto fill = [](const char* name, const char* colour, const std::string& more = "") {
    return std::string(".") + name + "{fill:" + colour + ";stroke:none" + more + "}\n";
  };
  return fill("unknown", "#e3e7ec") + fill("free", "#ffffff") + fill("footer", "#ffffff") +
         stroke("wall", "#1b2430", 2.2, ";stroke-linejoin:round;stroke-linecap:round") +
         stroke("beyond", "#9aa5b1", 1.6, ";stroke-linecap:round") +
         stroke("open", "#f08c1a", 1.4, dash(5, 3)) +
         stroke("beam", "#2f80c3", 0.7, ";stroke-opacity:0.30") + fill("hit", "#d3222a") +
         stroke("faint", "#e0565c", 1.8, ";stroke-linecap:round;stroke-opacity:0.45") +
         stroke("path", "#15803d", 2.0, ";stroke-linejoin:round;stroke-opacity:0.85") +
         fill("stop", "#15803d") +
         stroke("particle", "#b0189c", 2.4, ";stroke-linecap:round;stroke-opacity:0.5") +
         stroke("truth", "#c2410c", 2.0, ";stroke-linejoin:round" + dash(7, 4)) +
         stroke("rival", "#8e44ad", 1.8, ";stroke-linejoin:round;stroke-linecap:round") +
         fill("rivaltip", "#8e44ad") + fill("safe", "#c8e6c9", ";fill-opacity:0.75") +
         stroke("fallen", "#d3222a", 2.4, ";stroke-linecap:round") +
         stroke("best", "#0b3d91", 3.2, ";stroke-linejoin:round;stroke-linecap:round") +
         fill("besttip", "#0b3d91") + "text{font-family:DejaVu Sans,Arial,sans-serif}\n" +
         ".note{font-size:13px;fill:#1b2430}\n" +
         ".bestlabel{font-size:17px;font-weight:bold;fill:#0b3d91;stroke:#ffffff;"
         "stroke-width:4;stroke-linejoin:round;paint-order:stroke}\n" +
         ".rivallabel{font-size:13px;fill:#8e44ad;stroke:#ffffff;stroke-width:3;"
         "stroke-linejoin:round;paint-order:stroke}\n";
}

}  // namespace

SvgCanvas::SvgCanvas(const BoundingBox& view, std::string unit)
    : view_(view), unit_(std::move(unit)) {
  const double longest = std::max(view.width(), view.height());
  const double margin = kMargin * std::max(longest, 1.0);
  view_.min.x -= margin;
  view_.min.y -= margin;
  view_.max.x += margin;
  view_.max.y += margin;
  const double width = view_.max.x - view_.min.x, height = view_.max.y - view_.min.y;
  scale_ = kLongSide / std::max(width, height);
  if (width * scale_ < kLeastWidth) {  // widen: the map stays in the middle
    const double missing = kLeastWidth / scale_ - width;
    view_.min.x -= 0.5 * missing;
    view_.max.x += 0.5 * missing;
  }
  width_px_ = (view_.max.x - view_.min.x) * scale_;
  height_px_ = height * scale_;
}

void SvgCanvas::area(const std::vector<std::vector<TPoint2D>>& rings, const std::string& style) {
  shapes_ +=
      "<path class=\"" + style + "\" fill-rule=\"evenodd\" d=\"" + pathData(rings, true) + "\"/>\n";
}

void SvgCanvas::lines(const std::vector<Polyline>& chains, const std::string& style) {
  if (chains.empty()) return;
  shapes_ += "<path class=\"" + style + "\" d=\"" + pathData(chains, false) + "\"/>\n";
}

void SvgCanvas::dots(const std::vector<TPoint2D>& centers, double radius_px,
                     const std::string& style) {
  shapes_ += "<g class=\"" + style + "\">\n";
  for (const TPoint2D& center : centers) {
    shapes_ += "<circle cx=\"" + number(center.x, 4) + "\" cy=\"" + number(center.y, 4) +
               "\" r=\"" + number(radius_px / scale_, 6) + "\"/>\n";
  }
  shapes_ += "</g>\n";
}

void SvgCanvas::label(const TPoint2D& at, double right_px, double up_px, const std::string& text,
                      const std::string& style) {
  labels_ += "<text class=\"" + style + "\" x=\"" + px((at.x - view_.min.x) * scale_ + right_px) +
             "\" y=\"" + px((view_.max.y - at.y) * scale_ - up_px) + "\">" + escape(text) +
             "</text>\n";
}

void SvgCanvas::legend(Sample sample, const std::string& style, const std::string& meaning) {
  legend_.push_back({sample, style, meaning});
}

std::string SvgCanvas::scaleBar(double y_px) const {
  // The longest of 1, 2 or 5 times a power of ten that takes at most an eighth of the width.
  const double most = width_px_ / scale_ / 8.0;
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  const double metres = most >= 5.0 * decade   ? 5.0 * decade
                        : most >= 2.0 * decade ? 2.0 * decade
                                               : decade;
  const double left = 20.0, right = left + metres * scale_;
  return "<path d=\"M" + px(left) + " " + px(y_px - 5) + "v10M" + px(left) + " " + px(y_px) + "H" +
         px(right) + "M" + px(right) + " " + px(y_px - 5) +
         "v10\" fill=\"none\" stroke=\"#1b2430\" stroke-width=\"2\"/>\n<text class=\"note\" x=\"" +
         px(right + 8) + "\" y=\"" + px(y_px + 5) + "\">" + number(metres, 3) + " " + unit_ +
         "</text>\n";
}

std::string SvgCanvas::legendRow(double y_px) const {
  constexpr double kSample = 22.0, kGap = 14.0, kLetter = 7.4;  // pixels; letters on average
  double total = 0.0;
  for (const LegendEntry& entry : legend_) {
    total += kSample + 6.0 + kGap + kLetter * static_cast<double>(entry.meaning.size());
  }
  double x = width_px_ - total;
  std::string row;
  for (const LegendEntry& entry : legend_) {
    // The samples are drawn in metres too, for the styles are made for the scaled group.
    const double mid = y_px / scale_, left = x / scale_, right = (x + kSample) / scale_;
    std::string shape;
    if (entry.sample == Sample::line) {
      shape = "<path class=\"" + entry.style + "\" d=\"M" + number(left, 5) + " " + number(mid, 5) +
              "H" + number(right, 5) + "\"/>";
    } else if (entry.sample == Sample::dot) {
      shape = "<circle class=\"" + entry.style + "\" cx=\"" + number(0.5 * (left + right), 5) +
              "\" cy=\"" + number(mid, 5) + "\" r=\"" + number(4.0 / scale_, 6) + "\"/>";
    } else {
      shape = "<rect class=\"" + entry.style + "\" x=\"" + number(left, 5) + "\" y=\"" +
              number(mid - 7.0 / scale_, 5) + "\" width=\"" + number(right - left, 5) +
              "\" height=\"" + number(14.0 / scale_, 5) + "\"/>";
    }
    row += "<g transform=\"scale(" + number(scale_, 6) + ")\">" + shape +
           "</g>\n<text class=\"note\" x=\"" + px(x + kSample + 6.0) + "\" y=\"" + px(y_px + 5) +
           "\">" + escape(entry.meaning) + "</text>\n";
    x += kSample + 6.0 + kGap + kLetter * static_cast<double>(entry.meaning.size());
  }
  return row;
}

std::string SvgCanvas::text() const {
  const std::string width = px(width_px_), height = px(height_px_);
  const std::string total = px(height_px_ + kFooter);
  const double middle = height_px_ + 0.5 * kFooter;
  // Inside the group coordinates are the map's: metres, y up.
  const std::string group = "<g transform=\"matrix(" + number(scale_, 6) + " 0 0 " +
                            number(-scale_, 6) + " " + number(-view_.min.x * scale_, 4) + " " +
                            number(view_.max.y * scale_, 4) + ")\">\n";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + total +
         "\" viewBox=\"0 0 " + width + " " + total + "\">\n<style>\n" + styleSheet(scale_) +
         "</style>\n<rect class=\"unknown\" width=\"" + width + "\" height=\"" + total + "\"/>\n" +
         group + shapes_ + "</g>\n" + labels_ +
         // Laid over what reaches out of the picture.
         "<rect class=\"footer\" y=\"" + height + "\" width=\"" + width + "\" height=\"" +
         px(kFooter) + "\"/>\n" + scaleBar(middle) + legendRow(middle) + "</svg>\n";
}

}  // namespace mrpt_polyloc::apps
