#include "export/print_sheets/sheet_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/srgb.h"
#include "files/png_rows.h"

namespace pleinair::exports {
namespace {

/// Fraction of a pixel's width (or height) covered by one module.
struct Share {
  int module = 0;
  double part = 0.0;
};

/// Coverage of pixels by adjacent modules of equal size along an axis.
class AxisCoverage {
 public:
  AxisCoverage(double start_px, double module_px, int modules, int pixels) {
    // Tolerance for rounding errors at ends on whole pixels.
    constexpr double kNothing = 1e-9;
    const double end_px = start_px + module_px * modules;
    first_ = std::clamp(static_cast<int>(std::floor(start_px + kNothing)), 0, pixels);
    const int last = std::clamp(static_cast<int>(std::ceil(end_px - kNothing)), first_, pixels);
    shares_.resize(last - first_);
    for (int module = 0; module < modules; ++module) {
      const double from = start_px + module_px * module, to = from + module_px;
      const int from_pixel = std::max(first_, static_cast<int>(std::floor(from + kNothing)));
      for (int pixel = from_pixel; pixel < last && pixel < to - kNothing; ++pixel) {
        const double part = std::min(to, pixel + 1.0) - std::max<double>(from, pixel);
        shares_[pixel - first_].push_back({module, part});
      }
    }
  }
  int first() const { return first_; }
  int size() const { return static_cast<int>(shares_.size()); }
  const std::vector<Share>& operator[](int i) const { return shares_[i]; }

 private:
  int first_ = 0;
  std::vector<std::vector<Share>> shares_;
};

/// Darkens pixels by their coverage with black modules; `is_black(column, row)`.
template <typename IsBlack>
void DrawModules(const AxisCoverage& across, const AxisCoverage& down, IsBlack is_black,
                 Image<std::uint8_t>* picture) {
  for (int y = 0; y < down.size(); ++y) {
    for (int x = 0; x < across.size(); ++x) {
      double covered = 0.0;
      for (const Share& row : down[y]) {
        for (const Share& column : across[x]) {
          if (is_black(column.module, row.module)) covered += row.part * column.part;
        }
      }
      std::uint8_t& pixel = (*picture)(across.first() + x, down.first() + y);
      pixel = std::min(pixel, covered == 0.0 ? std::uint8_t{255} : Srgb8FromLinear(1.0 - covered));
    }
  }
}

void DrawMarker(const tracker::MarkerPattern& print, Vec2 top_left_px, double module_px,
                Image<std::uint8_t>* picture) {
  DrawModules(
      AxisCoverage(top_left_px.x, module_px, print.modules, picture->width()),
      AxisCoverage(top_left_px.y, module_px, print.modules, picture->height()),
      [&](int x, int y) {
        return print.white[static_cast<std::size_t>(y) * print.modules + x] == 0;
      },
      picture);
}

void DrawTriangle(const SheetTriangle& triangle, cv::Mat* picture) {
  constexpr int kShift = 8;
  std::vector<cv::Point> corners;
  for (const Vec2 corner : triangle.corners_mm) {
    // OpenCV's integers are pixel centres; ours are a pixel's left edge.
    const Vec2 px = corner * kSheetPixelsPerMm - Vec2{0.5, 0.5};
    corners.emplace_back(static_cast<int>(std::lround(px.x * (1 << kShift))),
                         static_cast<int>(std::lround(px.y * (1 << kShift))));
  }
  cv::fillConvexPoly(*picture, corners, cv::Scalar(0), cv::LINE_AA, kShift);
}

void DrawText(const SheetText& text, cv::Mat* picture) {
  // Hershey's simplex capitals are 21 px high at scale 1, and 0.72 of Helvetica's size.
  const double scale = 0.72 * text.size_mm * kSheetPixelsPerMm / 21.0 * 0.95;
  const cv::Point baseline(static_cast<int>(std::lround(text.baseline_mm.x * kSheetPixelsPerMm)),
                           static_cast<int>(std::lround(text.baseline_mm.y * kSheetPixelsPerMm)));
  cv::putText(*picture, text.text, baseline, cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar(0), 2,
              cv::LINE_AA);
}

}  // namespace

Image<std::uint8_t> RasterizeSheet(const Sheet& sheet) {
  const int width = static_cast<int>(std::lround(sheet.page.width_mm * kSheetPixelsPerMm));
  const int height = static_cast<int>(std::lround(sheet.page.height_mm * kSheetPixelsPerMm));
  Image<std::uint8_t> picture(width, height);
  std::fill_n(picture.data(), picture.size(), std::uint8_t{255});
  for (const SheetMarker& print : sheet.prints) {
    DrawMarker(print.pattern, print.top_left_mm * kSheetPixelsPerMm,
               print.module_mm * kSheetPixelsPerMm, &picture);
  }
  for (const SheetRectangle& r : sheet.rectangles) {
    const Vec2 start = r.top_left_mm * kSheetPixelsPerMm, size = r.size_mm * kSheetPixelsPerMm;
    DrawModules(
        AxisCoverage(start.x, size.x, 1, width), AxisCoverage(start.y, size.y, 1, height),
        [](int, int) { return true; }, &picture);
  }
  cv::Mat canvas(height, width, CV_8UC1, picture.data());
  for (const SheetTriangle& triangle : sheet.triangles) DrawTriangle(triangle, &canvas);
  for (const SheetText& text : sheet.texts) DrawText(text, &canvas);
  return picture;
}

Image<std::uint8_t> RasterizeMarker(const tracker::MarkerPattern& print, int pixels) {
  Image<std::uint8_t> picture(pixels, pixels);
  std::fill_n(picture.data(), picture.size(), std::uint8_t{255});
  DrawMarker(print, {0.0, 0.0}, static_cast<double>(pixels) / print.modules, &picture);
  return picture;
}

Result<std::string> EncodeGrayPng(ImageView<const std::uint8_t> gray, double pixels_per_metre) {
  char* bytes = nullptr;
  std::size_t size = 0;
  std::FILE* file = open_memstream(&bytes, &size);
  bool good = file != nullptr;
  if (good) {
    const auto density = static_cast<std::uint32_t>(std::lround(pixels_per_metre));
    good = files::WritePngRows(gray, {.pixels_per_metre = density}, file);
    good = std::fclose(file) == 0 && good;
  }
  std::string encoded;
  if (good) encoded.assign(bytes, size);
  std::free(bytes);
  if (!good) return SystemError("", "cannot encode a PNG picture", "free some memory");
  return encoded;
}

}  // namespace pleinair::exports
