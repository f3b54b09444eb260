#include "tools/marker_search/marker_views.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "tools/marker_search/surroundings.h"
#include "tracker/golay/golay_code.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::marker_search {
namespace {

using tracker::sg::kModules;

constexpr double kFocal_px = 600.0;
constexpr int kNoiseValues = 1 << 18;
constexpr int kLightSteps = 4096;

}  // namespace

Mat3 MarkerView::PixelsFromModules(Vec2 centre) const {
  // The marker, in units of its edge, is turned about an axis in its plane, then rolled.
  const double ct = std::cos(tilt_rad), st = std::sin(tilt_rad);
  const double ax = std::cos(direction_rad), ay = std::sin(direction_rad);
  // Rodrigues' formula for the first two columns.
  const Vec3 u{ct + ax * ax * (1.0 - ct), ax * ay * (1.0 - ct), -ay * st};
  const Vec3 v{ax * ay * (1.0 - ct), ct + ay * ay * (1.0 - ct), ax * st};
  const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
  const double distance = kFocal_px / edge_px, k = 1.0 / tracker::sg::kEdge;
  const double half = 0.5 * kModules;
  const Vec3 x{k * (cr * u.x - sr * u.y), k * (cr * v.x - sr * v.y), 0.0};
  const Vec3 y{k * (sr * u.x + cr * u.y), k * (sr * v.x + cr * v.y), 0.0};
  const Vec3 z{k * u.z, k * v.z, 0.0};
  const double x0 = -half * (x.x + x.y), y0 = -half * (y.x + y.y);
  const double z0 = distance - half * (z.x + z.y);
  const double f = kFocal_px;
  return {{f * x.x + centre.x * z.x, f * x.y + centre.x * z.y, f * x0 + centre.x * z0,
           f * y.x + centre.y * z.x, f * y.y + centre.y * z.y, f * y0 + centre.y * z0, z.x, z.y,
           z0}};
}

void MarkerView::DrawConditions(int textures, RandomDraws* draws) {
  blur_px = draws->Uniform(0.4, 1.2);
  noise = draws->Uniform(0.5, 6.0);
  ink = draws->Uniform(0.02, 0.08);
  paper = draws->Uniform(0.6, 0.9);
  light = draws->Uniform(0.3, 1.0);
  word = tracker::CodewordOfNumber(draws->Below(tracker::kGolayNumbers));
  texture = textures > 0 ? draws->Below(textures) : -1;
  texture_x = draws->Below(kTextureSide_px);
  texture_y = draws->Below(kTextureSide_px);
  noise_begin = draws->Below(kNoiseValues);
}

ViewRenderer::ViewRenderer(const std::vector<GreyImage>& textures) : textures_(textures) {
  RandomDraws draws(1);
  noise_.resize(kNoiseValues);
  for (float& value : noise_) value = static_cast<float>(draws.Normal());
  for (int i = 0; i <= kLightSteps; ++i) {
    encoded_.push_back(Srgb8FromLinear(static_cast<double>(i) / kLightSteps));
  }
}

void ViewRenderer::Render(const MarkerView& view, const tracker::sg::Border& border,
                          const Mat3& from_modules, int width, int height, GreyImage* image) {
  if (image->width() != width || image->height() != height) *image = {width, height};
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 1.0;
  tracker::LookUpRays(tracker::LensGrid(camera), {0, 0, 0, width, height}, &rays_);
  raster_.Render(tracker::SgMarkerPatternOfWord(view.word, border), tracker::Adjugate(from_modules),
                 rays_, view.blur_px, &map_, &marker_pattern_);
  const float ink = static_cast<float>(view.ink * view.light * kLightSteps);
  const float white = static_cast<float>((view.paper - view.ink) * view.light * kLightSteps);
  const float noise = static_cast<float>(view.noise);
  constexpr int kMask = kTextureSide_px - 1;
  std::size_t n = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++n) {
      float grey = 128.0F;
      if (map_.column[n] > 0.0F && map_.column[n] < kModules && map_.row[n] > 0.0F &&
          map_.row[n] < kModules) {
        const long step = std::lround(ink + white * marker_pattern_.white[n]);
        grey = encoded_[std::clamp<long>(step, 0, kLightSteps)];
      } else if (view.texture >= 0) {
        grey = textures_[view.texture]((x + view.texture_x) & kMask, (y + view.texture_y) & kMask);
      }
      grey += noise * noise_[(view.noise_begin + n) % kNoiseValues];
      image->data()[n] = static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0F, 255.0F)));
    }
  }
}

}  // namespace pleinair::marker_search
