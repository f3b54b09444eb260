#include "compositor/photometry/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "compositor/photometry/linear_sampling.h"

namespace pleinair::compositor {
namespace {

// Approximate number of new surface samples per frame, one every few pixels.
constexpr double kSamplesPerFrame = 32000.0;
constexpr std::size_t kMaxSamples = 150'000;
// Width of a cell in pixels. It is wide enough for both sides of a soft edge. It is so narrow that
// little but the light changes across it.
constexpr double kCellPx = 32.0;
constexpr double kMinCell_m = 0.02;
constexpr double kNormalSteps = 16.0;
// 8-bit pixel values beyond which a value is clipped or mostly noise.
constexpr int kClippedCode = 250, kDarkCode = 5;
constexpr double kBoardMarginM = 0.02;
constexpr int kMarkerSurface = -1;
constexpr int kMarkerSamples = 96;  // Per side of the white margin.

constexpr double kPlaneSteps = 1e3;

}  // namespace

SurfacePlane PlaneOf(int surface, Vec3 normal) {
  const auto rounded = [](double value) {
    return static_cast<int>(std::lround(value * kPlaneSteps));
  };
  return {std::max(surface, kMarkerSurface),
          {rounded(normal.x), rounded(normal.y), rounded(normal.z)}};
}

SurfaceSamples::SurfaceSamples(const PhantomRays& phantoms, const CameraModel& camera,
                               const scene::MarkerReflectance& marker,
                               const CameraResponse& response)
    : phantoms_(phantoms), camera_(camera), marker_(marker), response_(response) {}

bool SurfaceSamples::IsOnMargin(Point<Marker> point) const {
  const double half = marker_.board_size_m / 2 + kBoardMarginM;
  return std::fabs(point.xyz.x) < half && std::fabs(point.xyz.y) < half &&
         std::fabs(point.xyz.z) < half / 4;
}

bool SurfaceSamples::Observe(CameraImageView image, const Transform<Camera, Marker>& pose,
                             LinearRgb exposure_scale, SurfaceSample* sample, Vec2* pixel) const {
  const Point<Camera> in_camera = pose * sample->point;
  const Vec3 eye = pose.Inverse().translation_m;
  const Vec3 to_eye = eye - sample->point.xyz;
  const double distance = Norm(to_eye);
  if (in_camera.xyz.z <= 0.0 || Dot(sample->normal, to_eye) < 0.1 * distance) return false;
  *pixel = ProjectToPixel(camera_, in_camera);
  const auto linear = SampleLinear(image, *pixel, response_);
  if (!linear) return false;
  const auto seen = phantoms_.First({eye}, to_eye * (-1.0 / distance));
  if (seen && Norm(seen->point.xyz - eye) < distance - 3 * sample->footprint_m - 0.01) return false;
  const std::array<double, 3> scale{exposure_scale.r, exposure_scale.g, exposure_scale.b};
  for (int c = 0; c < 3; ++c) {
    const auto& light = response_.Linear(c);
    if ((*linear)[c] >= light[kClippedCode] || (*linear)[c] <= light[kDarkCode]) return true;
  }
  ++sample->frames;
  for (int c = 0; c < 3; ++c) {
    sample->log_rgb[c] += (std::log((*linear)[c] / scale[c]) - sample->log_rgb[c]) / sample->frames;
  }
  return true;
}

void SurfaceSamples::AddSurfaceSample(const PhantomSurface& surface_sample, double distance_m) {
  const auto& [point, normal, surface, albedo, is_foliage, placed_model] = surface_sample;
  SurfaceSample sample;
  sample.point = point;
  sample.normal = normal;
  sample.surface = surface;
  sample.placed_model = surface < 0 ? -1 : placed_model;
  sample.albedo = albedo;
  sample.footprint_m = distance_m / std::max(1.0, std::min(camera_.fx, camera_.fy));
  const int level =
      static_cast<int>(std::lround(std::log2(std::max(kCellPx * sample.footprint_m, kMinCell_m))));
  const double size_m = std::exp2(level);
  const auto step = [](double value, double size) {
    return static_cast<int>(std::floor(value / size + 0.5));
  };
  const CellKey key{surface,
                    level,
                    step(normal.x, 1 / kNormalSteps),
                    step(normal.y, 1 / kNormalSteps),
                    step(normal.z, 1 / kNormalSteps),
                    step(point.xyz.x, size_m),
                    step(point.xyz.y, size_m),
                    step(point.xyz.z, size_m)};
  sample.cell = cells_.try_emplace(key, cells()).first->second;
  samples_.push_back(sample);
}

void SurfaceSamples::AddMarker(double distance_m) {
  // The middle half of the white around the square.
  const double half = marker_.size_m / 2;
  const double margin_m = (marker_.board_size_m - marker_.size_m) / 2;
  if (margin_m <= 0.0) return;
  const LinearRgb white = LinearRgb{1, 1, 1} * marker_.albedo_white;
  for (int side = 0; side < 4; ++side) {
    const double c = std::array{1.0, 0.0, -1.0, 0.0}[side];
    const double s = std::array{0.0, 1.0, 0.0, -1.0}[side];
    for (int i = 0; i < kMarkerSamples; ++i) {
      const double x = half * (2.0 * (i + 0.5) / kMarkerSamples - 1.0);
      for (const double outwards : {0.3, 0.5, 0.7}) {
        const double y = half + outwards * margin_m;
        AddSurfaceSample(
            {{{c * x - s * y, s * x + c * y, 0.0}}, {0, 0, 1}, kMarkerSurface - side, white},
            distance_m);
      }
    }
  }
}

void SurfaceSamples::AddFrame(CameraImageView image, const Transform<Camera, Marker>& pose,
                              LinearRgb exposure_scale, bool shows_marker) {
  const int step = std::max(2, static_cast<int>(std::sqrt(static_cast<double>(image.width()) *
                                                          image.height() / kSamplesPerFrame)));
  if (frames_++ == 0 && shows_marker) AddMarker(Norm(pose.translation_m));
  const int columns = image.width() / step, rows = image.height() / step;
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(columns) * rows);
  const auto take = [&](Vec2 pixel) {
    const int x = static_cast<int>(pixel.x) / step, y = static_cast<int>(pixel.y) / step;
    if (x < columns && y < rows) taken[static_cast<std::size_t>(y) * columns + x] = 1;
  };
  Vec2 pixel;
  for (SurfaceSample& sample : samples_) {
    if (Observe(image, pose, exposure_scale, &sample, &pixel)) take(pixel);
  }
  const auto marker_from_camera = pose.Inverse();
  const Point<Marker> eye{marker_from_camera.translation_m};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (taken[static_cast<std::size_t>(row) * columns + column] != 0) continue;
      if (samples_.size() >= kMaxSamples) return;
      const Vec2 ray =
          UndistortPixel(camera_, {column * step + step / 2.0, row * step + step / 2.0});
      const Vec3 direction = Normalized(marker_from_camera.rotation * Vec3{ray.x, ray.y, 1.0});
      const auto seen = phantoms_.First(eye, direction);
      if (!seen || seen->is_foliage || IsOnMargin(seen->point)) continue;
      AddSurfaceSample(*seen, Norm(seen->point.xyz - eye.xyz));
      Observe(image, pose, exposure_scale, &samples_.back(), &pixel);
    }
  }
}

}  // namespace pleinair::compositor
