// Tests the estimates of blur and noise on images with known blur and noise.
#include "compositor/picture/camera_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "compositor/picture/edge_profile.h"
#include "compositor/picture/grain.h"
#include "tests/compositor/gentle_response.h"

namespace pleinair::compositor {
namespace {

constexpr scene::MarkerReflectance kMarker{
    .size_m = 0.4, .board_size_m = 0.52, .black_band_m = 0.05};
const CameraModel kCamera{
    .width = 400, .height = 300, .fx = 380, .fy = 380, .cx = 199.5, .cy = 149.5};
// A metre away and oblique, so that no edge is parallel to the pixel grid.
const Transform<Camera, Marker> kPose = [] {
  const double a = 0.2, t = 0.5;
  const Mat3 roll{{std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1}};
  const Mat3 tilt{{1, 0, 0, 0, std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t)}};
  const Mat3 flip{{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  return Transform<Camera, Marker>{roll * tilt * flip, {0.01, -0.02, 1.0}};
}();

struct Photograph {
  double blur_px = 0.0;         ///< Beyond the pixel's own width.
  double noise_constant = 0.0;  ///< Variances of linear light.
  double noise_slope = 0.0;
  bool textured = false;  ///< The ground around the marker.
  double hand_to_x_px = 0.0;
};

/// The marker on grey ground through a camera: 8 × 8 samples per pixel, Gaussian blur, noise, 8
/// bits.
RgbImage Take(const Photograph& how, std::uint32_t seed = 1, const CameraResponse& response = {}) {
  const auto from_camera = kPose.Inverse();
  const auto albedo = [&](Vec3 at) {
    const double m = std::max(std::fabs(at.x), std::fabs(at.y));
    if (m > kMarker.board_size_m / 2) {
      const double waves = std::sin(170 * at.x) * std::sin(140 * at.y);
      return how.textured ? 0.25 * (1 + 0.5 * waves) : 0.25;
    }
    if (m > kMarker.size_m / 2) return 0.6;
    return m > kMarker.size_m / 2 - kMarker.black_band_m || at.x > 0.05 ? 0.03 : 0.6;
  };
  constexpr int kSub = 8;
  Image<float> light(kCamera.width, kCamera.height);
  for (int y = 0; y < kCamera.height; ++y) {
    for (int x = 0; x < kCamera.width; ++x) {
      double sum = 0.0;
      for (int i = 0; i < kSub * kSub; ++i) {
        const Vec2 px{x - 0.5 + (i % kSub + 0.5) / kSub, y - 0.5 + (i / kSub + 0.5) / kSub};
        const Vec2 ray = UndistortPixel(kCamera, px);
        const Vec3 direction = from_camera.rotation * Vec3{ray.x, ray.y, 1.0};
        const Vec3 eye = from_camera.translation_m;
        sum += px.x < how.hand_to_x_px ? 0.2 : albedo(eye + direction * (-eye.z / direction.z));
      }
      light(x, y) = static_cast<float>(sum / (kSub * kSub));
    }
  }
  const int reach = static_cast<int>(std::ceil(3 * how.blur_px));
  for (const bool along : {true, false}) {
    if (reach == 0) break;
    Image<float> blurred(kCamera.width, kCamera.height);
    for (int y = 0; y < kCamera.height; ++y) {
      for (int x = 0; x < kCamera.width; ++x) {
        double sum = 0.0, weights = 0.0;
        for (int i = -reach; i <= reach; ++i) {
          const double weight = std::exp(-0.5 * i * i / (how.blur_px * how.blur_px));
          const int u = std::clamp(along ? x + i : x, 0, kCamera.width - 1);
          const int v = std::clamp(along ? y : y + i, 0, kCamera.height - 1);
          sum += weight * light(u, v);
          weights += weight;
        }
        blurred(x, y) = static_cast<float>(sum / weights);
      }
    }
    light = blurred;
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  RgbImage picture(kCamera.width, kCamera.height, 3);
  for (int y = 0; y < kCamera.height; ++y) {
    for (int x = 0; x < kCamera.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double l = light(x, y);
        const double sigma = std::sqrt(how.noise_constant + how.noise_slope * l);
        picture(x, y, c) = response.Encoded8(l + sigma * normal(random), c);
      }
    }
  }
  return picture;
}

std::optional<CameraLook> Measure(const Photograph& how) {
  return MeasureCameraLook(Take(how).view(), kCamera, kPose, kMarker, {});
}

TEST(CameraLook, ReadsCodesByTheCamerasOwnResponse) {
  const CameraResponse gentle = testing::GentleResponse();
  const Photograph how{.blur_px = 1.0, .noise_constant = 1e-5, .noise_slope = 2e-4};
  const auto srgb = Measure(how);
  const RgbImage picture = Take(how, 1, gentle);
  const auto read_as = [&](const CameraResponse& response) {
    return MeasureCameraLook(picture.view(), kCamera, kPose, kMarker, response);
  };
  const auto look = read_as(gentle), wrong = read_as({});
  ASSERT_TRUE(srgb && look && wrong);
  EXPECT_NEAR(look->blur_px, srgb->blur_px, 0.02);
  EXPECT_GT(std::fabs(wrong->blur_px - srgb->blur_px), 0.04);
  constexpr double kBlack = 0.03, kWhite = 0.6;
  for (const int c : {0, 1, 2}) {
    for (const double light : {kBlack, kWhite}) {
      EXPECT_NEAR(look->NoiseSigma(c, light) / srgb->NoiseSigma(c, light), 1.0, 0.04) << c;
    }
    EXPECT_LT(wrong->NoiseSigma(c, kBlack), 0.85 * look->NoiseSigma(c, kBlack)) << c;
  }
}

TEST(CameraLook, KnowsTheSecondMomentOfAMovedEdge) {
  constexpr double kCircle_px = 3.0, kStreak_px = 5.0, kBlur_px = 0.5, kStep_px = 0.02;
  double sum = 0.0, squares = 0.0;
  for (int i = -800; i <= 800; ++i) {
    const double at = i * kStep_px;
    const EdgeProfile edge = MovedEdge(at, kCircle_px, kStreak_px, kBlur_px);
    sum += edge.slope * kStep_px;
    squares += edge.slope * at * at * kStep_px;
    EXPECT_NEAR(MovedEdge(at, kCircle_px, 0.0, kBlur_px).value,
                DefocusedEdge(at, kCircle_px, kBlur_px).value, 1e-12);
  }
  EXPECT_NEAR(sum, 1.0, 1e-4);
  // A disc has d²/16, a box L²/12.
  EXPECT_NEAR(squares,
              kCircle_px * kCircle_px / 16 + kStreak_px * kStreak_px / 12 + kBlur_px * kBlur_px,
              0.02);
}

TEST(CameraLook, ReadsTheBlurOffTheMarkersEdges) {
  for (const double blur : {0.0, 0.5, 1.0, 2.0}) {
    const auto look = Measure({.blur_px = blur});
    ASSERT_TRUE(look) << blur;
    // The added blur, per pixel, combined with the pixel's own width.
    double variance = 1 / 12.0, weights = 1.0, squares = 0.0;
    for (int i = 1; i <= 6 && blur > 0.0; ++i) {
      const double weight = std::exp(-0.5 * i * i / (blur * blur));
      weights += 2 * weight;
      squares += 2 * weight * i * i;
    }
    variance += squares / weights;
    const double whole = std::sqrt(variance);
    EXPECT_NEAR(look->blur_px, whole, 0.05 + 0.04 * whole) << blur;
    // A noise-free image is reported as such, however sharp its edges are.
    EXPECT_LT(look->NoiseSigma(1, 0.2), 0.0015) << blur;
  }
}

TEST(CameraLook, ReadsTheNoiseOffTheFlatPartsOfTheMarker) {
  for (const bool textured : {false, true}) {
    const Photograph how{
        .blur_px = 0.6, .noise_constant = 1e-5, .noise_slope = 3e-4, .textured = textured};
    const auto look = Measure(how);
    ASSERT_TRUE(look);
    for (const double light : {0.05, 0.2, 0.6}) {
      const double truth = std::sqrt(how.noise_constant + how.noise_slope * light);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(look->NoiseSigma(c, light) / truth, 1.0, 0.2);
    }
    EXPECT_LT(look->neighbour_correlation, 0.15);
    EXPECT_LT(look->channel_correlation, 0.2);
    EXPECT_NEAR(look->blur_px, std::hypot(0.6, 1 / std::sqrt(12.0)), 0.1);
  }
}

TEST(CameraLook, IsNotMisledByAHandOverASideOfTheMarker) {
  const auto look = Measure({.blur_px = 1.0, .hand_to_x_px = 150});
  ASSERT_TRUE(look);
  EXPECT_NEAR(look->blur_px, std::hypot(1.0, 1 / std::sqrt(12.0)), 0.12);
}

TEST(CameraLook, ReportsNothingOfAMarkerThatIsHiddenOrTooSmall) {
  EXPECT_FALSE(Measure({.hand_to_x_px = 400}));
  auto far = kPose;
  far.translation_m = far.translation_m * 30.0;
  EXPECT_FALSE(MeasureCameraLook(Take({}).view(), kCamera, far, kMarker, {}));
}

TEST(PictureGrain, HasTheCorrelationAskedForAndNoSeam) {
  for (const double rho : {0.0, 0.3, 0.6}) {
    constexpr int kSide = 128;
    const Image<float> grain = MakeGrain(kSide, rho);
    double mean = 0.0, variance = 0.0, beside = 0.0, channels = 0.0, over_seam = 0.0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        mean += grain(x, y, 0);
        variance += grain(x, y, 0) * grain(x, y, 0);
        beside += grain(x, y, 0) * grain((x + 1) % kSide, y, 0);
        channels += grain(x, y, 0) * grain(x, y, 3);
      }
      over_seam += grain(kSide - 1, y, 0) * grain(0, y, 0);
    }
    constexpr double kAll = kSide * kSide;
    EXPECT_NEAR(mean / kAll, 0.0, 0.03);
    EXPECT_NEAR(variance / kAll, 1.0, 0.06);
    EXPECT_NEAR(beside / kAll, rho, 0.04);
    EXPECT_NEAR(channels / kAll, 0.0, 0.04);
    EXPECT_NEAR(over_seam / kSide, rho, 0.35);
  }
}

}  // namespace
}  // namespace pleinair::compositor
