#include "app/calibrate/calibration_drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tracker/calibration/view_coverage.h"

namespace pleinair::app {
namespace {

using tracker::LensCalibration;

constexpr double kWidth = 800.0;
constexpr exports::DrawingColor kSoft{190, 188, 182}, kInk{60, 66, 74}, kBlue{44, 98, 181},
    kRed{194, 69, 45};

exports::DrawingColor Between(exports::DrawingColor a, exports::DrawingColor b, double share) {
  const auto mix = [&](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

/// Blue, green, ochre, red.
exports::DrawingColor Heat(double share) {
  constexpr exports::DrawingColor kSteps[] = {kBlue, {47, 125, 79}, {214, 160, 40}, kRed};
  const double at = std::clamp(share, 0.0, 1.0) * 3.0;
  const int step = std::min(2, static_cast<int>(at));
  return Between(kSteps[step], kSteps[step + 1], at - step);
}

/// An empty drawing of the image with its frame. `scale`: drawing units per pixel.
exports::VectorDrawing PictureFrame(const CameraModel& camera, const std::string& title,
                                    double* scale) {
  *scale = kWidth / camera.width;
  exports::VectorDrawing drawing;
  drawing.width = kWidth;
  drawing.height = camera.height * *scale;
  drawing.title = title;
  const double right = kWidth - 0.5, bottom = drawing.height - 0.5;
  drawing.lines.push_back(
      {{{0.5, 0.5}, {right, 0.5}, {right, bottom}, {0.5, bottom}, {0.5, 0.5}}, kSoft, 1.0, false});
  return drawing;
}

/// Position of a pixel (integer = centre) in the drawing.
Vec2 Place(Vec2 pixel, double scale) { return (pixel + Vec2{0.5, 0.5}) * scale; }

/// Outline of the board in a view: the convex hull of its points, by gift wrapping.
std::vector<Vec2> Outline(const std::vector<Vec2>& points) {
  std::size_t start = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].x < points[start].x) start = i;
  }
  std::vector<Vec2> outline;
  std::size_t at = start;
  do {
    outline.push_back(points[at]);
    std::size_t next = at == 0 ? 1 : 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = points[next] - points[at], b = points[i] - points[at];
      const double cross = a.x * b.y - a.y * b.x;
      if (i != at && (cross < 0.0 || (cross == 0.0 && Norm(b) > Norm(a)))) next = i;
    }
    at = next;
  } while (at != start && outline.size() <= points.size());
  outline.push_back(outline.front());
  return outline;
}

}  // namespace

exports::VectorDrawing CoverageDrawing(const LensCalibration& calibration) {
  const CameraModel& camera = calibration.fit.camera;
  double scale = 1.0;
  exports::VectorDrawing drawing =
      PictureFrame(camera,
                   fmt::format("{} views cover {:.0f} % of the image", calibration.views.size(),
                               100.0 * calibration.coverage.Share()),
                   &scale);
  using Coverage = tracker::ViewCoverage;
  for (int i = 0; i < Coverage::kColumns * Coverage::kRows; ++i) {
    if (calibration.coverage.views[static_cast<std::size_t>(i)] > 0) continue;
    const double side = 0.18 * kWidth / Coverage::kColumns;
    const Vec2 middle{(i % Coverage::kColumns + 0.5) * kWidth / Coverage::kColumns,
                      (i / Coverage::kColumns + 0.5) * drawing.height / Coverage::kRows};
    drawing.lines.push_back(
        {{middle - Vec2{side, side}, middle + Vec2{side, side}}, kSoft, 1.5, false});
    drawing.lines.push_back(
        {{middle + Vec2{side, -side}, middle + Vec2{-side, side}}, kSoft, 1.5, false});
  }
  for (std::size_t view = 0; view < calibration.views.size(); ++view) {
    const auto& seen = calibration.views[view].observed_px;
    std::vector<Vec2> outline = Outline(seen);
    for (Vec2& corner : outline) corner = Place(corner, scale);
    drawing.lines.push_back({std::move(outline), kSoft, 1.0, false});
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double off = Norm(calibration.residuals_px[view][i]);
      drawing.discs.push_back(
          {Place(seen[i], scale), 2.6, Heat(off / std::max(3.0 * calibration.rms_px, 1e-12))});
    }
  }
  return drawing;
}

std::vector<ResidualRegion> ResidualRegions(const LensCalibration& calibration) {
  const CameraModel& camera = calibration.fit.camera;
  std::vector<ResidualRegion> regions(kRegionColumns * kRegionRows);
  for (std::size_t view = 0; view < calibration.views.size(); ++view) {
    for (std::size_t i = 0; i < calibration.views[view].observed_px.size(); ++i) {
      const Vec2 at = calibration.views[view].observed_px[i];
      const int column = std::clamp(static_cast<int>((at.x + 0.5) / camera.width * kRegionColumns),
                                    0, kRegionColumns - 1);
      const int row = std::clamp(static_cast<int>((at.y + 0.5) / camera.height * kRegionRows), 0,
                                 kRegionRows - 1);
      ResidualRegion& region = regions[static_cast<std::size_t>(row * kRegionColumns + column)];
      const Vec2 residual = calibration.residuals_px[view][i];
      ++region.points;
      region.mean_px = region.mean_px + residual;
      region.rms_px += residual.x * residual.x + residual.y * residual.y;
    }
  }
  for (ResidualRegion& region : regions) {
    if (region.points == 0) continue;
    region.mean_px = region.mean_px * (1.0 / region.points);
    region.rms_px = std::sqrt(region.rms_px / region.points);
  }
  return regions;
}

exports::VectorDrawing ResidualDrawing(const LensCalibration& calibration) {
  double scale = 1.0;
  exports::VectorDrawing drawing =
      PictureFrame(calibration.fit.camera, "Residuals by region", &scale);
  const double cell_width = kWidth / kRegionColumns, cell_height = drawing.height / kRegionRows;
  for (int i = 1; i < kRegionColumns; ++i) {
    drawing.lines.push_back(
        {{{i * cell_width, 0}, {i * cell_width, drawing.height}}, kSoft, 0.7, true});
  }
  for (int i = 1; i < kRegionRows; ++i) {
    drawing.lines.push_back({{{0, i * cell_height}, {kWidth, i * cell_height}}, kSoft, 0.7, true});
  }
  const auto regions = ResidualRegions(calibration);
  // The longest arrow is a third of a cell, unless all are small compared with the noise.
  double longest = 0.5 * calibration.rms_px;
  for (const ResidualRegion& region : regions) longest = std::max(longest, Norm(region.mean_px));
  const double arrow_scale = 0.33 * cell_height / std::max(longest, 1e-12);
  for (int i = 0; i < kRegionColumns * kRegionRows; ++i) {
    const ResidualRegion& region = regions[static_cast<std::size_t>(i)];
    const Vec2 middle{(i % kRegionColumns + 0.5) * cell_width,
                      (i / kRegionColumns + 0.45) * cell_height};
    const Vec2 label = middle + Vec2{0.0, 0.4 * cell_height};
    if (region.points == 0) {
      drawing.texts.push_back({label, 15.0, "nothing seen", kSoft});
      continue;
    }
    const Vec2 end = middle + region.mean_px * arrow_scale;
    const exports::DrawingColor color =
        Heat(Norm(region.mean_px) / std::max(calibration.rms_px, 1e-12));
    drawing.lines.push_back({{middle, end}, color, 2.5, false});
    drawing.discs.push_back({middle, 3.0, color});
    drawing.texts.push_back({label, 15.0, fmt::format("{:.3f} px", region.rms_px), kInk});
  }
  drawing.texts.push_back(
      {{0.5 * kWidth, 14.0},
       15.0,
       fmt::format("mean (longest {:.3f} px) and RMS of seen less predicted", longest),
       kInk});
  return drawing;
}

exports::VectorDrawing DistortionDrawing(const LensCalibration& calibration) {
  const CameraModel& camera = calibration.fit.camera;
  double scale = 1.0;
  exports::VectorDrawing drawing = PictureFrame(camera, "Distortion", &scale);
  const auto add_line = [&](bool upright, double at_px) {
    const int length = upright ? camera.height : camera.width;
    exports::DrawingLine plain{{}, kSoft, 1.0, true}, bent{{}, kBlue, 1.6, false};
    for (int i = 0; i <= 60; ++i) {
      const double along = i / 60.0 * length - 0.5;
      const Vec2 pixel = upright ? Vec2{at_px, along} : Vec2{along, at_px};
      const Vec2 ray{(pixel.x - camera.cx) / camera.fx, (pixel.y - camera.cy) / camera.fy};
      plain.points.push_back(Place(pixel, scale));
      bent.points.push_back(
          Place(ProjectToPixel(camera, Point<Camera>{{ray.x, ray.y, 1.0}}), scale));
    }
    drawing.lines.push_back(std::move(plain));
    drawing.lines.push_back(std::move(bent));
  };
  constexpr int kLines = 9;
  for (int i = 0; i <= kLines; ++i) {
    add_line(true, i * camera.width / static_cast<double>(kLines) - 0.5);
    add_line(false, i * camera.height / static_cast<double>(kLines) - 0.5);
  }
  const Vec2 centre = Place({camera.cx, camera.cy}, scale);
  drawing.discs.push_back({centre, 4.0, kRed});
  drawing.texts.push_back({centre + Vec2{0.0, 16.0}, 14.0, "principal point", kRed});
  return drawing;
}

exports::VectorDrawing PlacesDrawing(const LensCalibration& calibration) {
  struct Side {
    Vec2 from, to;
  };
  const CameraModel& camera = calibration.fit.camera;
  exports::VectorDrawing drawing;
  drawing.width = kWidth;
  drawing.height = 0.45 * kWidth;
  drawing.title = "Where the board stood";
  double farthest = 0.0;
  // From above: x to the right, z up the page. From the side: z to the right, y down.
  std::vector<Side> above, beside;
  for (std::size_t i = 0; i < calibration.views.size(); ++i) {
    const auto& on_board = calibration.views[i].on_board_m;
    Vec2 minimum = on_board.front(), maximum = minimum;
    for (const Vec2 at : on_board) {
      minimum = {std::min(minimum.x, at.x), std::min(minimum.y, at.y)};
      maximum = {std::max(maximum.x, at.x), std::max(maximum.y, at.y)};
    }
    const auto in_camera = [&](double x, double y) {
      return (calibration.fit.camera_from_board[i] * Point<Marker>{{x, y, 0.0}}).xyz;
    };
    const Vec2 middle = (minimum + maximum) * 0.5;
    // Both centre lines of the board: from above, one of them appears at full length.
    for (const auto& [a, b] :
         {std::pair{in_camera(minimum.x, middle.y), in_camera(maximum.x, middle.y)},
          std::pair{in_camera(middle.x, minimum.y), in_camera(middle.x, maximum.y)}}) {
      above.push_back({{a.x, a.z}, {b.x, b.z}});
      beside.push_back({{a.y, a.z}, {b.y, b.z}});
      farthest = std::max({farthest, a.z, b.z});
    }
  }
  const double unit = 0.82 * drawing.height / std::max(farthest, 1e-9);
  const auto draw = [&](double left, double half_extent, const std::vector<Side>& sides,
                        const std::string& name, double field) {
    const Vec2 origin{left + 0.25 * kWidth, drawing.height - 32.0};
    const auto place = [&](Vec2 at) { return origin + Vec2{at.x * unit, -at.y * unit}; };
    const double end = 1.05 * farthest;
    for (const double edge : {-field, field}) {
      const double reach = std::min(end, half_extent / std::max(std::fabs(edge), 1e-9) / unit);
      drawing.lines.push_back({{origin, place({edge * reach, reach})}, kSoft, 1.0, true});
    }
    for (const Side& side : sides) {
      drawing.lines.push_back({{place(side.from), place(side.to)}, kBlue, 1.4, false});
    }
    drawing.discs.push_back({origin, 5.0, kRed});
    drawing.texts.push_back({origin + Vec2{0.0, 14.0}, 14.0, name, kInk});
  };
  draw(0.0, 0.24 * kWidth, above, "camera, from above", 0.5 * camera.width / camera.fx);
  draw(0.5 * kWidth, 0.24 * kWidth, beside, "camera, from the side (left is up)",
       0.5 * camera.height / camera.fy);
  drawing.texts.push_back(
      {{0.5 * kWidth, 14.0}, 14.0, fmt::format("farthest {:.2f} m", farthest), kInk});
  return drawing;
}

}  // namespace pleinair::app
