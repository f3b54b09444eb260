#include "tracker/refinement/marker_alignment.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/srgb.h"
#include "tracker/pose/corner_covariance.h"
#include "tracker/pose/homography.h"
#include "tracker/refinement/marker_fit.h"
#include "tracker/refinement/marker_pixels.h"
#include "tracker/refinement/marker_prediction.h"

namespace pleinair::tracker {
namespace {

/// Node spacing of the level fields.
constexpr double kNodeSpacing_px = 30.0;
constexpr int kMaxNodes = 6;
/// Maximum distance of a square's edge from the detected one. It increases with blur, and where the
/// contrast exceeds kModestContrast residuals: the prediction must then be right. (A camera's
/// sharpening causes residuals of 10 to 20 of 255 digital numbers.)
constexpr double kEdgeMayMove_px = 0.58, kMaxEdgeMotion_px = 2.0, kEdgeMayMovePerBlur = 0.6;
constexpr double kModestContrast = 25.0;
/// Corner error that no residual shows: flatness of the marker, calibration, non-Gaussian blur of
/// the lens.
constexpr double kSystematicCorner_px = 0.005;

/// Uniform black and contrast of a marker.
struct Levels {
  double black = 0.0, contrast = 0.0;  ///< Linear light.

  double ContrastCodes() const {
    return Encode(std::max(black, 0.0) + contrast).code - Encode(std::max(black, 0.0)).code;
  }
};

/// Straight line of linear light over predicted coverage; nullopt without contrast.
std::optional<Levels> FitLevels(const MarkerPattern& pattern, const Mat3& rays_from_marker,
                                const std::vector<MarkerPixel>& pixels) {
  const Mat3 marker_from_rays = Adjugate(rays_from_marker);
  double n = 0.0, sum_t = 0.0, sum_tt = 0.0, sum_i = 0.0, sum_ti = 0.0;
  for (const MarkerPixel& pixel : pixels) {
    const Vec2 marker = Apply(marker_from_rays, pixel.ray);
    const Vec2 d_x = Apply(marker_from_rays, pixel.ray + pixel.ray_d_x) - marker;
    const Vec2 d_y = Apply(marker_from_rays, pixel.ray + pixel.ray_d_y) - marker;
    const double t = CoverageOfPixel(pattern, marker, d_x, d_y, kInitialBlur_px).white;
    const double light = LinearFromSrgb8()[static_cast<std::size_t>(pixel.code)];
    n += 1.0;
    sum_t += t;
    sum_tt += t * t;
    sum_i += light;
    sum_ti += t * light;
  }
  const double determinant = n * sum_tt - sum_t * sum_t;
  if (!(determinant > 1e-6)) return std::nullopt;
  Levels levels;
  levels.contrast = (n * sum_ti - sum_t * sum_i) / determinant;
  levels.black = (sum_i - levels.contrast * sum_t) / n;
  if (!(levels.contrast > 0.002)) return std::nullopt;
  return levels;
}

void FillCorners(const CameraModel& camera, const MarkerFit& fit, MarkerAlignment* alignment) {
  const Mat3& rays_from_marker = fit.state().rays_from_marker;
  const auto pixel_of = [&](Vec2 unit) {
    return PixelOfMarkerPoint(camera, rays_from_marker, unit);
  };
  std::array<FittedCorner, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = CornerAt(kSquareCorners[i], pixel_of);
    alignment->corners_px[i] = corners[i].pixel;
  }
  alignment->corner_covariance_px2 =
      CovarianceOfCorners(corners, fit.MotionCovariance(), kSystematicCorner_px);
}

/// Maximum distance of a corner from the detected one.
double MayMove_px(const MarkerAlignment& alignment, double contrast_codes, int corner) {
  // A detector places the edges of an sRGB image a third of a pixel inside the square, more where
  // it is blurred. The corner is then off by that over the sine of its half angle.
  const Vec2 here = alignment.corners_px[corner];
  const Vec2 a = alignment.corners_px[(corner + 1) % 4] - here;
  const Vec2 b = alignment.corners_px[(corner + 3) % 4] - here;
  const double cosine = (a.x * b.x + a.y * b.y) / std::max(1e-12, Norm(a) * Norm(b));
  const double half_angle_sine = std::sqrt(std::max(0.02, 0.5 * (1.0 - cosine)));
  const double blurred_px =
      kEdgeMayMovePerBlur * std::max(0.0, alignment.blur_px - kInitialBlur_px);
  const double trust = std::max(1.0, contrast_codes / alignment.residual_codes / kModestContrast);
  const double edge_px = std::min(kMaxEdgeMotion_px, kEdgeMayMove_px * trust) + blurred_px;
  return edge_px / half_angle_sine;
}

/// Minimum matching share of a square whose pixels are fitted. The fit is distorted by squares that
/// an occluder touches.
constexpr float kSeen = 0.95F;
/// Factor of the maximum motion if part of the marker is occluded: the occluder misled the
/// detector's corners too.
constexpr double kCoveredMayMoveTimes = 4.0;

/// Removes the pixels of occluded squares; returns the share that remains.
double ExcludeCovered(const MarkerPattern& pattern, const Mat3& rays_from_marker,
                      const VisibilityGrid& visibility, std::vector<MarkerPixel>* pixels) {
  if (visibility.side <= 0 || pixels->empty()) return 1.0;
  const Mat3 marker_from_rays = Adjugate(rays_from_marker);
  const double extent = pattern.Extent();
  const auto square = [&](double from_edge) {
    const double at = from_edge / (2.0 * extent) * visibility.side;
    return static_cast<std::size_t>(std::clamp(at, 0.0, visibility.side - 0.5));
  };
  const std::size_t before = pixels->size();
  std::erase_if(*pixels, [&](const MarkerPixel& pixel) {
    const Vec2 marker = Apply(marker_from_rays, pixel.ray);
    const std::size_t row = square(extent - marker.y), column = square(marker.x + extent);
    return visibility.values[row * visibility.side + column] < kSeen;
  });
  return static_cast<double>(pixels->size()) / static_cast<double>(before);
}

/// `max_motion_beside_cut_px`: minimum of the maximum motion where sides meet that the image's edge
/// cuts.
bool Plausible(const MarkerAlignment& alignment, double contrast_codes,
               const std::array<Vec2, 4>& corners_px, const std::array<bool, 4>& observed,
               double may_move_times, double max_motion_beside_cut_px) {
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner = alignment.corners_px[i];
    if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) return false;
    // Only the corner opposite the cut ones has two complete sides.
    const bool beside_cut = !observed[i] || !observed[(i + 1) % 4] || !observed[(i + 3) % 4];
    const double may_move_px = std::max(beside_cut ? max_motion_beside_cut_px : 0.0,
                                        may_move_times * MayMove_px(alignment, contrast_codes, i));
    if (Norm(corner - corners_px[i]) > may_move_px) return false;
    const double variance = std::max(alignment.corner_covariance_px2[(2 * i) * 8 + 2 * i],
                                     alignment.corner_covariance_px2[(2 * i + 1) * 8 + 2 * i + 1]);
    if (!(variance >= 0.0 && variance < 0.3 * 0.3)) return false;
  }
  return alignment.visible_fraction > 0.4;
}

}  // namespace

std::array<bool, 4> CornersSeen(ImageView<const std::uint8_t> grey,
                                const std::array<Vec2, 4>& corners_px) {
  std::array<bool, 4> observed{};
  for (int i = 0; i < 4; ++i) observed[i] = IsInImage(grey, corners_px[i]);
  return observed;
}

std::optional<MarkerAlignment> AlignMarker(const CameraModel& camera, const MarkerPattern& pattern,
                                           ImageView<const std::uint8_t> grey,
                                           const std::array<Vec2, 4>& corners_px,
                                           const VisibilityGrid& visibility) {
  std::array<Vec2, 4> rays;
  double perimeter_px = 0.0;
  for (int i = 0; i < 4; ++i) {
    rays[i] = UndistortPixel(camera, corners_px[i]);
    perimeter_px += Norm(corners_px[(i + 1) % 4] - corners_px[i]);
  }
  const double side_px = perimeter_px / 4.0;
  MarkerFitState start;
  start.rays_from_marker = HomographyToQuad(rays);
  for (const double value : start.rays_from_marker.m) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  MarkerPixels gathered = GatherMarkerPixels(camera, pattern, grey, start.rays_from_marker);
  const double kept = ExcludeCovered(pattern, start.rays_from_marker, visibility, &gathered.pixels);
  if (gathered.pixels.size() < 40) return std::nullopt;
  const std::optional<Levels> levels = FitLevels(pattern, start.rays_from_marker, gathered.pixels);
  if (!levels) return std::nullopt;
  start.log_blur = std::log(kInitialBlur_px);
  start.nodes =
      std::clamp(static_cast<int>(std::lround(side_px / kNodeSpacing_px)) + 1, 2, kMaxNodes);
  const int nodes = start.nodes * start.nodes;
  start.levels.resize(2 * nodes);
  for (int node = 0; node < nodes; ++node) {
    start.levels[LevelIndex(node, 0)] = std::max(levels->black, 0.0005);
    start.levels[LevelIndex(node, 1)] = std::max(levels->black, 0.0005) + levels->contrast;
  }

  MarkerFit fit(pattern, gathered.pixels, levels->contrast, side_px);
  if (!fit.Run(start)) return std::nullopt;
  MarkerAlignment alignment;
  alignment.blur_px = std::exp(fit.state().log_blur);
  alignment.residual_codes = fit.ResidualCodes();
  alignment.visible_fraction = gathered.observed_share * fit.AgreeingShare();
  FillCorners(camera, fit, &alignment);
  const double may_move_times = kept < 1.0 ? kCoveredMayMoveTimes : 1.0;
  // Cut sides may meet anywhere, but within a distance at which cells are still decoded.
  const double module_px = side_px / pattern.edge_modules;
  if (!Plausible(alignment, levels->ContrastCodes(), corners_px, CornersSeen(grey, corners_px),
                 may_move_times, module_px)) {
    return std::nullopt;
  }
  alignment.visible_fraction *= kept;
  return alignment;
}

}  // namespace pleinair::tracker
