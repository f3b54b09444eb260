#include "accuracy/frame_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "accuracy/background.h"
#include "accuracy/jpeg_loss.h"
#include "accuracy/marker_pose.h"
#include "accuracy/point_spread.h"
#include "accuracy/random.h"
#include "base/check.h"
#include "base/srgb.h"
#include "tracker/pose/homography.h"

namespace pleinair::accuracy {
namespace {

/// Linear reflectance of printed ink and of paper.
constexpr double kInk = 0.035, kPaper = 0.82;

/// Finer pixels along a pixel's side, in which markers are drawn and blurred by the lens. Each is
/// an exact mean over a box of the marker, so the finer pixels only have to follow its rotation and
/// the perspective, and to sample the lens's point spread function finely.
constexpr int kFine = 3;

/// Bilinear interpolation; 0 outside.
float Sample(const Image<float>& image, double x, double y) {
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const auto across = static_cast<float>(x - column), down = static_cast<float>(y - row);
  const auto at = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < image.width() && j < image.height() ? image(i, j) : 0.0F;
  };
  return (1 - down) * ((1 - across) * at(column, row) + across * at(column + 1, row)) +
         down * ((1 - across) * at(column, row + 1) + across * at(column + 1, row + 1));
}

/// 8-bit values of linear light 0…1, from a table: exact except within 1e-4 of a step.
class SrgbTable {
 public:
  SrgbTable() : codes_(kSteps + 1) {
    for (int i = 0; i <= kSteps; ++i) {
      codes_[i] = static_cast<std::uint8_t>(std::lround(SrgbFromLinear(1.0 * i / kSteps) * 255.0));
    }
  }
  std::uint8_t operator()(float linear) const {
    return codes_[std::lround(std::clamp(linear, 0.0F, 1.0F) * kSteps)];
  }

 private:
  static constexpr int kSteps = 1 << 16;
  std::vector<std::uint8_t> codes_;
};

}  // namespace

/// Undistorted rays of all pixels, and their differences from pixel to pixel.
struct FrameRenderer::LensRays {
  struct Ray {
    Vec2 middle, per_x, per_y;
  };
  explicit LensRays(const CameraModel& camera)
      : width(camera.width), rays(static_cast<std::size_t>(camera.width) * camera.height) {
    // One pixel beyond each side gives central differences at the image's edge.
    const int wide = camera.width + 2;
    std::vector<Vec2> middles(static_cast<std::size_t>(wide) * (camera.height + 2));
    for (int y = -1; y <= camera.height; ++y) {
      for (int x = -1; x <= camera.width; ++x) {
        middles[static_cast<std::size_t>(y + 1) * wide + x + 1] =
            UndistortPixel(camera, {1.0 * x, 1.0 * y});
      }
    }
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Vec2* at = &middles[static_cast<std::size_t>(y + 1) * wide + x + 1];
        rays[static_cast<std::size_t>(y) * width + x] = {at[0], (at[1] - at[-1]) * 0.5,
                                                         (at[wide] - at[-wide]) * 0.5};
      }
    }
  }
  const Ray& At(int x, int y) const { return rays[static_cast<std::size_t>(y) * width + x]; }

  int width;
  std::vector<Ray> rays;
};

FrameRenderer::FrameRenderer(const CameraModel& camera, PatternByNumber patterns,
                             std::uint64_t seed, std::uint64_t noise_seed)
    : camera_(camera),
      patterns_(std::move(patterns)),
      seed_(seed),
      noise_seed_(noise_seed),
      rays_(std::make_unique<LensRays>(camera)),
      textures_(kNumbers) {}

FrameRenderer::~FrameRenderer() = default;

const MarkerTexture& FrameRenderer::TextureOf(int number) {
  CHECK_LT(number, kNumbers);
  if (!textures_[number]) {
    const auto pattern = patterns_(number);
    CHECK_EQ(pattern != nullptr, true);
    textures_[number] = std::make_unique<MarkerTexture>(*pattern);
  }
  return *textures_[number];
}

void FrameRenderer::Paint(const MarkerSpec& marker, const Occluder* occluder,
                          const PhotoSpec& photo, Image<float>* picture) {
  const MarkerTexture& texture = TextureOf(marker.number);
  const double reach = std::max(texture.extent(), occluder != nullptr ? occluder->extent : 0.0);
  const PixelBox box = BoxOf(camera_, marker.camera_from_marker, kMarkerEdge, reach);
  const int rim = static_cast<int>(std::ceil(4.0 * photo.lens.psf_px));
  const auto clamped = [](double at, int most) {
    return static_cast<int>(std::clamp(at, 0.0, 1.0 * most));
  };
  const int left = clamped(box.left - rim, camera_.width - 1);
  const int right = clamped(box.right + rim, camera_.width - 1);
  const int top = clamped(box.top - rim, camera_.height - 1);
  const int bottom = clamped(box.bottom + rim, camera_.height - 1);
  Image<float> fine((right - left + 1) * kFine, (bottom - top + 1) * kFine);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      PaintPixel(marker, texture, occluder, photo.light, {x, y},
                 {(x - left) * kFine, (y - top) * kFine}, &fine);
    }
  }
  fine = GaussianBlurred(fine, photo.lens.psf_px * kFine);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      float sum = 0.0F;
      for (int k = 0; k < kFine * kFine; ++k) {
        sum += fine((x - left) * kFine + k % kFine, (y - top) * kFine + k / kFine);
      }
      (*picture)(x, y) = sum / (kFine * kFine);
    }
  }
}

void FrameRenderer::PaintPixel(const MarkerSpec& marker, const MarkerTexture& texture,
                               const Occluder* occluder, double light, Place pixel, Place first,
                               Image<float>* fine) const {
  const double modules_per_unit = texture.modules() / (2.0 * texture.extent());
  const Mat3 plane_from_rays = PlaneFromRays(marker.camera_from_marker, kMarkerEdge);
  const LensRays::Ray& ray = rays_->At(pixel.x, pixel.y);
  // Distances of neighbouring samples on the marker.
  const Vec2 middle = tracker::Apply(plane_from_rays, ray.middle);
  const Vec2 step_x =
      (tracker::Apply(plane_from_rays, ray.middle + ray.per_x) - middle) * modules_per_unit;
  const Vec2 step_y =
      (tracker::Apply(plane_from_rays, ray.middle + ray.per_y) - middle) * modules_per_unit;
  const double half_width = 0.5 * std::hypot(step_x.x, step_y.x) / kFine;
  const double half_height = 0.5 * std::hypot(step_x.y, step_y.y) / kFine;
  const double behind = background_(pixel.x, pixel.y);
  for (int j = 0; j < kFine; ++j) {
    for (int i = 0; i < kFine; ++i) {
      const double dx = (i + 0.5) / kFine - 0.5, dy = (j + 0.5) / kFine - 0.5;
      const Vec2 at = tracker::Apply(plane_from_rays, ray.middle + ray.per_x * dx + ray.per_y * dy);
      double value = behind;
      if (std::fabs(at.x) < texture.extent() && std::fabs(at.y) < texture.extent()) {
        const Vec2 place{(at.x + texture.extent()) * modules_per_unit,
                         (texture.extent() - at.y) * modules_per_unit};
        value = light * (kInk + (kPaper - kInk) * texture.White(place, half_width, half_height));
      }
      if (occluder != nullptr) {
        const auto texel = [](double edges) {
          return (edges - Occluder::kFirst) * Occluder::kTexelsPerEdge - 0.5;
        };
        const double u = texel(0.5 + 0.5 * at.x), v = texel(0.5 - 0.5 * at.y);
        const double cover = Sample(occluder->cover, u, v);
        value *= 1.0 - Sample(occluder->shadow, u, v);
        value = value * (1.0 - cover) + light * Sample(occluder->light, u, v) * cover;
      }
      (*fine)(first.x + i, first.y + j) = static_cast<float>(value);
    }
  }
}

void FrameRenderer::AddLightPatterns(const FrameSpec& frame, const MarkerTruth& first,
                                     Image<float>* picture) {
  const PhotoSpec& photo = frame.photo;
  if (!photo.gradient && !photo.shadow && !photo.glare) return;
  Vec2 middle;
  double edge = 0.0;
  for (int i = 0; i < 4; ++i) {
    middle = middle + first.corners_px[i] * 0.25;
    edge = std::max(edge, Norm(first.corners_px[i] - first.corners_px[(i + 1) % 4]));
  }
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const Vec2 away = Vec2{1.0 * x, 1.0 * y} - middle;
      const auto along = [&](const LightPattern& light) {
        return (away.x * std::cos(light.angle) + away.y * std::sin(light.angle)) / edge;
      };
      double value = (*picture)(x, y);
      if (photo.gradient) {  // The ratio is over one edge; uniform far away.
        const double ratio = photo.gradient->value;
        const double at = std::clamp(along(*photo.gradient), -0.7, 0.7);
        value *= 1.3 / std::sqrt(ratio) * std::exp(-std::log(ratio) * at);
      }
      if (photo.shadow) {  // A hard edge with 1.5 px of penumbra.
        const double at_px = (along(*photo.shadow) + photo.shadow->offset.x) * edge;
        const double dark = 1.0 / photo.shadow->value;
        value *= dark + (1.0 - dark) / (1.0 + std::exp(std::clamp(-at_px / 0.6, -60.0, 60.0)));
      }
      if (photo.glare) {  // A saturated spot that covers about `value` per cent of the marker.
        const double radius = edge * std::sqrt(photo.glare->value / 100.0 / M_PI);
        const double distance = Norm(away - photo.glare->offset * edge) / radius;
        value += 1.6 * std::exp(-std::log(2.0) * std::pow(distance, 4));
      }
      (*picture)(x, y) = static_cast<float>(value);
    }
  }
}

Image<float> FrameRenderer::Expose(const PhotoSpec& photo, Image<float> light) const {
  constexpr double kMinDefocus_px = 0.3, kMinMotion_px = 0.2;
  if (photo.exposure != 1.0) {
    for (std::size_t i = 0; i < light.size(); ++i) {
      light.data()[i] *= static_cast<float>(photo.exposure);
    }
  }
  if (photo.lens.defocus_px > kMinDefocus_px) light = DiscBlurred(light, photo.lens.defocus_px);
  if (photo.motion.length_px > kMinMotion_px) {
    light = StreakBlurred(light, photo.motion.length_px, photo.motion.angle);
  }
  const double corner2 =
      0.25 * (1.0 * camera_.width * camera_.width + 1.0 * camera_.height * camera_.height);
  for (int y = 0; y < camera_.height; ++y) {
    const double dy = y - 0.5 * camera_.height;
    for (int x = 0; x < camera_.width; ++x) {
      const double dx = x - 0.5 * camera_.width;
      light(x, y) *= static_cast<float>(1.0 - photo.lens.vignette * (dx * dx + dy * dy) / corner2);
    }
  }
  return light;
}

GreyImage FrameRenderer::Develop(const FrameSpec& frame, const Image<float>& light) const {
  static const SrgbTable codes;
  RandomStream random(noise_seed_, "noise/" + frame.name);
  const auto shot = static_cast<float>(frame.photo.noise.shot);
  const auto read2 = static_cast<float>(frame.photo.noise.read * frame.photo.noise.read);
  GreyImage grey(light.width(), light.height());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float value = light.data()[i];
    const float sigma = std::sqrt(shot * std::clamp(value, 0.0F, 1.0F) + read2);
    grey.data()[i] = codes(value + sigma * random.NormalFromWord());
  }
  return grey;
}

RenderedFrame FrameRenderer::Render(const FrameSpec& frame) {
  if (background_.empty() || background_key_ != frame.background) {
    background_ = MakeBackground(camera_.width, camera_.height, seed_, frame.background);
    background_key_ = frame.background;
  }
  RenderedFrame rendered;
  Image<float> light = GaussianBlurred(background_, frame.photo.lens.psf_px);
  for (const MarkerSpec& marker : frame.markers) {
    MarkerTruth truth{.number = marker.number,
                      .camera_from_marker = marker.camera_from_marker,
                      .corners_px = SquareCorners(camera_, marker.camera_from_marker, kMarkerEdge)};
    if (marker.occluder) {
      const Occluder occluder = MakeOccluder(*marker.occluder, seed_);
      truth.covered = occluder.shares;
      Paint(marker, &occluder, frame.photo, &light);
    } else {
      Paint(marker, nullptr, frame.photo, &light);
    }
    rendered.truth.push_back(truth);
  }
  if (!rendered.truth.empty()) AddLightPatterns(frame, rendered.truth[0], &light);
  rendered.grey = Develop(frame, Expose(frame.photo, std::move(light)));
  if (frame.photo.jpeg_quality > 0) {
    rendered.grey = AfterJpeg(rendered.grey, frame.photo.jpeg_quality);
  }
  return rendered;
}

}  // namespace pleinair::accuracy
