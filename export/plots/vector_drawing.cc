#include "export/plots/vector_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include <fmt/format.h>

#include "devices/images/resize_image.h"
#include "export/plots/svg_file.h"
#include "files/markup_escape.h"

namespace pleinair::exports {
namespace {

constexpr double kDash = 5.0;  // Length of a dash and of a gap.
constexpr int kSupersampling = 3;
constexpr double kHalo =
    0.22;  // Width of the white halo around letters, relative to the font size.

std::string Number(double value) { return ShortNumber(value, 2); }

std::string Hex(DrawingColor c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

/// Divides a line into dashes.
std::vector<std::vector<Vec2>> CutDashes(const std::vector<Vec2>& points) {
  std::vector<std::vector<Vec2>> dashes;
  std::vector<Vec2> dash{points.front()};
  double left = kDash;
  bool drawn = true;
  for (std::size_t i = 1; i < points.size(); ++i) {
    Vec2 from = points[i - 1];
    double length = Norm(points[i] - from);
    while (length > left) {
      from = from + (points[i] - from) * (left / length);
      length -= left;
      dash.push_back(from);
      if (drawn) dashes.push_back(dash);
      dash = {from};
      drawn = !drawn;
      left = kDash;
    }
    left -= length;
    dash.push_back(points[i]);
  }
  if (drawn) dashes.push_back(dash);
  return dashes;
}

/// Draws into an image `scale` times as large as the drawing.
class Canvas {
 public:
  Canvas(cv::Mat* picture, double scale) : picture_(picture), scale_(scale) {}

  void Draw(const DrawingLine& line) {
    if (line.points.size() < 2) return;
    const int width = std::max(1, static_cast<int>(std::lround(line.width * scale_)));
    const auto pieces =
        line.dashed ? CutDashes(line.points) : std::vector<std::vector<Vec2>>{line.points};
    for (const std::vector<Vec2>& piece : pieces) {
      std::vector<cv::Point> points;
      points.reserve(piece.size());
      for (const Vec2 p : piece) points.push_back(ToFixed(p));
      cv::polylines(*picture_, points, false, ToScalar(line.color), width, cv::LINE_AA, kShift);
    }
  }

  void Draw(const DrawingDisc& disc) {
    cv::circle(*picture_, ToFixed(disc.centre),
               static_cast<int>(std::lround(disc.radius * scale_ * (1 << kShift))),
               ToScalar(disc.fill), cv::FILLED, cv::LINE_AA, kShift);
  }

  void Draw(const DrawingText& text) {
    // Hershey's simplex capitals are 21 px high at scale 1, and 0.72 of Helvetica's size.
    constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
    const double size_px = text.size * scale_;
    const double scale = 0.72 * size_px / 21.0;
    const int pen = std::max(1, static_cast<int>(std::lround(size_px * 0.085)));
    int below = 0;
    const cv::Size box = cv::getTextSize(text.text, kFont, scale, pen, &below);
    const cv::Point at(static_cast<int>(std::lround(text.centre.x * scale_ - 0.5 * box.width)),
                       static_cast<int>(std::lround(text.centre.y * scale_ + 0.36 * size_px)));
    const int halo = pen + static_cast<int>(std::lround(size_px * kHalo));
    cv::putText(*picture_, text.text, at, kFont, scale, cv::Scalar::all(255), halo, cv::LINE_AA);
    cv::putText(*picture_, text.text, at, kFont, scale, ToScalar(text.color), pen, cv::LINE_AA);
  }

 private:
  static constexpr int kShift = 4;

  cv::Point ToFixed(Vec2 p) const {
    // OpenCV's integers are pixel centres; ours are a pixel's left edge.
    const auto fixed = [&](double v) {
      return static_cast<int>(std::lround((v * scale_ - 0.5) * (1 << kShift)));
    };
    return {fixed(p.x), fixed(p.y)};
  }
  static cv::Scalar ToScalar(DrawingColor c) {
    return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
  }

  cv::Mat* picture_;
  double scale_;
};

}  // namespace

std::string DrawingSvg(const VectorDrawing& drawing, int width_px) {
  const double height_px = width_px * drawing.height / drawing.width;
  std::string svg = SvgFileHead(
      {std::to_string(width_px), Number(height_px), Number(drawing.width), Number(drawing.height)},
      drawing.title);
  svg +=
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<g fill=\"none\" stroke-linejoin=\"round\">\n";
  auto out = std::back_inserter(svg);
  for (const DrawingLine& line : drawing.lines) {
    if (line.points.size() < 2) continue;
    svg += "<polyline points=\"";
    const char* separator = "";
    for (const Vec2 p : line.points) {
      fmt::format_to(out, "{}{},{}", separator, Number(p.x), Number(p.y));
      separator = " ";
    }
    fmt::format_to(out, "\" stroke=\"{}\" stroke-width=\"{}\"", Hex(line.color),
                   Number(line.width));
    if (line.dashed) fmt::format_to(out, " stroke-dasharray=\"{}\"", Number(kDash));
    svg += "/>\n";
  }
  svg += "</g>\n";
  for (const DrawingDisc& disc : drawing.discs) {
    fmt::format_to(out, "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n",
                   Number(disc.centre.x), Number(disc.centre.y), Number(disc.radius),
                   Hex(disc.fill));
  }
  svg += "<g font-family=\"Helvetica, Arial, sans-serif\" text-anchor=\"middle\">\n";
  for (const DrawingText& text : drawing.texts) {
    // The halo is a second text beneath, because not every viewer supports paint-order.
    const std::string place =
        fmt::format("x=\"{}\" y=\"{}\" font-size=\"{}\"", Number(text.centre.x),
                    Number(text.centre.y + 0.36 * text.size), Number(text.size));
    fmt::format_to(out,
                   "<text {0} stroke=\"#fff\" stroke-width=\"{1}\" stroke-linejoin=\"round\">{2}"
                   "</text><text {0} fill=\"{3}\">{2}</text>\n",
                   place, Number(kHalo * text.size), files::EscapeMarkup(text.text),
                   Hex(text.color));
  }
  return svg + "</g>\n</svg>\n";
}

RgbImage RasterizeDrawing(const VectorDrawing& drawing, int width_px) {
  const int height_px = static_cast<int>(std::lround(width_px * drawing.height / drawing.width));
  RgbImage large(width_px * kSupersampling, height_px * kSupersampling, 3);
  std::fill_n(large.data(), large.size(), std::uint8_t{255});
  cv::Mat picture(large.height(), large.width(), CV_8UC3, large.data());
  Canvas canvas(&picture, width_px * kSupersampling / drawing.width);
  for (const DrawingLine& line : drawing.lines) canvas.Draw(line);
  for (const DrawingDisc& disc : drawing.discs) canvas.Draw(disc);
  for (const DrawingText& text : drawing.texts) canvas.Draw(text);
  return devices::ResizeRgb(large.view(), width_px, height_px);
}

}  // namespace pleinair::exports
