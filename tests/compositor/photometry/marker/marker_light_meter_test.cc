#include "compositor/photometry/marker/marker_light_meter.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

#include "base/srgb.h"
#include "tests/compositor/gentle_response.h"
#include "tests/compositor/photometry/marker/photographed_marker.h"

namespace pleinair::compositor {
namespace {

using testing::ExpectExposureScale;
using testing::kAmbientLux;
using testing::kCamera;
using testing::kExposureScale;
using testing::kFromAbove;
using testing::kMarker;
using testing::kSunLux;
using testing::MeterFor;
using testing::Photograph;

TEST(MarkerLightMeter, ReadsExposureAndWhiteBalanceOfASunlitMarker) {
  const RgbImage picture = Photograph(kExposureScale, -1.0);
  const auto estimate = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ExpectExposureScale(estimate, kExposureScale);
  EXPECT_LT(std::max({estimate->error.r, estimate->error.g, estimate->error.b}), 0.005);
  EXPECT_FALSE(estimate->dappled);
  EXPECT_EQ(estimate->sunlit_share, 1.0);
}

TEST(MarkerLightMeter, EstimatesHowCertainItsReadingIs) {
  // Green has more noise. The scatter of the estimates must equal the reported errors.
  constexpr int kPictures = 60;
  const RgbImage clean = Photograph(kExposureScale, -1.0);
  const MarkerLightMeter meter = MeterFor(-1.0);
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  LinearRgb said;
  std::array<double, 3> sum{}, squares{};
  for (int i = 0; i < kPictures; ++i) {
    RgbImage picture = Photograph(kExposureScale, -1.0);
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        for (const int c : {0, 1, 2}) {
          const double code = clean(x, y, c) + (c == 1 ? 8.0 : 4.0) * noise(random);
          picture(x, y, c) = static_cast<std::uint8_t>(std::lround(code));
        }
      }
    }
    const auto estimate = meter.Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(estimate);
    ASSERT_FALSE(estimate->dappled);
    said = said + estimate->error * (1.0 / kPictures);
    const LinearRgb off = estimate->exposure_scale / kExposureScale;
    for (const int c : {0, 1, 2}) {
      const std::array values{off.r, off.g, off.b};
      const double value = values[c];
      sum[c] += value / kPictures;
      squares[c] += value * value / kPictures;
    }
  }
  EXPECT_GT(said.g, 1.5 * said.r);
  for (const int c : {0, 1, 2}) {
    const double scatter = std::sqrt(squares[c] - sum[c] * sum[c]);
    const std::array all{said.r, said.g, said.b};
    EXPECT_GT(all[c], 0.7 * scatter) << "channel " << c;
    EXPECT_LT(all[c], 1.5 * scatter) << "channel " << c;
  }
}

TEST(MarkerLightMeter, KnowsWhichPartLiesInThePhantomsShadow) {
  const RgbImage picture = Photograph(kExposureScale, 0.05);
  const auto estimate = MeterFor(0.05).Measure(picture.view(), kCamera, kFromAbove);
  ExpectExposureScale(estimate, kExposureScale);
  EXPECT_GT(estimate->sunlit_share, 0.2);
  EXPECT_LT(estimate->sunlit_share, 0.8);
}

TEST(MarkerLightMeter, ReadsAMarkerThatLiesWhollyInShadow) {
  const RgbImage picture = Photograph(kExposureScale * 5.0, 1.0);
  const auto estimate = MeterFor(1.0).Measure(picture.view(), kCamera, kFromAbove);
  ExpectExposureScale(estimate, kExposureScale * 5.0);
  EXPECT_EQ(estimate->sunlit_share, 0.0);
}

TEST(MarkerLightMeter, TakesTheSunlitPartWhenAnUnknownShadowCrossesTheMarker) {
  const RgbImage picture = Photograph(kExposureScale, 0.05);
  ExpectExposureScale(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove), kExposureScale);
}

TEST(MarkerLightMeter, EstimatesHowDeepTheShadowIsThatDividesTheMarker) {
  const double contrast = std::log((kAmbientLux + kSunLux) / kAmbientLux);
  const auto expect = [&](const MarkerLightMeter& meter, double shadow_to_x_m, double veil) {
    const RgbImage picture = Photograph(kExposureScale, shadow_to_x_m, veil);
    const auto shadow = meter.FindShadow(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(shadow);
    EXPECT_NEAR(shadow->contrast.r, contrast, 0.05);
    EXPECT_NEAR(shadow->contrast.g, contrast, 0.05);
    EXPECT_NEAR(shadow->contrast.b, contrast, 0.05);
    EXPECT_GT(shadow->lit.xyz.x, 0.05);
    EXPECT_LT(shadow->shaded.xyz.x, 0.05);
  };
  expect(MeterFor(-1.0), 0.05, 0.0);   // Of an unmodelled shadow,
  expect(MeterFor(-1.0), 0.05, 0.05);  // through veiling glare,
  expect(MeterFor(0.05), 0.05, 0.0);   // and of a phantom's shadow.
}

TEST(MarkerLightMeter, TakesNoCoverAndNoLeavesForAShadowsEdge) {
  const auto shadow = [](const RgbImage& picture) {
    const MarkerLightMeter meter = MeterFor(-1.0);
    EXPECT_TRUE(meter.Measure(picture.view(), kCamera, kFromAbove));
    return meter.FindShadow(picture.view(), kCamera, kFromAbove);
  };
  EXPECT_FALSE(shadow(Photograph(kExposureScale, -1.0)));
  // Sunlit grey covers on the marker: over the whole left part, over white alone, over black alone.
  const auto with_cover = [](double share_of_white, const auto& covers) {
    RgbImage picture = Photograph(kExposureScale, -1.0);
    const RgbImage grey = Photograph(kExposureScale * share_of_white, -1.0, 0.0,
                                     {.size_m = 0.0, .board_size_m = 0.5, .black_band_m = 0.05});
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        if (!covers(x - 160, y - 120)) continue;
        for (int c = 0; c < 3; ++c) picture(x, y, c) = grey(x, y, c);
      }
    }
    return picture;
  };
  constexpr int kEdgePx = 60;  // Edge of the black square.
  EXPECT_FALSE(shadow(with_cover(0.3, [](int x, int) { return x < -20; })));
  EXPECT_FALSE(shadow(with_cover(0.3, [](int x, int) { return x < -kEdgePx; })));
  EXPECT_FALSE(
      shadow(with_cover(0.7, [](int x, int) { return x >= -kEdgePx && x < -kEdgePx / 2; })));
}

TEST(MarkerLightMeter, CancelsVeilingGlare) {
  const RgbImage picture = Photograph(kExposureScale, -1.0, 0.05);
  ExpectExposureScale(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove), kExposureScale);
}

TEST(MarkerLightMeter, FallsBackToTheBlackWhereTheWhiteIsClipped) {
  const RgbImage picture = Photograph(kExposureScale * 3.0, -1.0);
  ExpectExposureScale(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove),
                      kExposureScale * 3.0);
}

TEST(MarkerLightMeter, ReadsAnEvenMarkerThroughNoiseAndGlareWhereItBeginsToClip) {
  constexpr double kVeil = 0.006;
  const MarkerLightMeter meter = MeterFor(-1.0);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 4.0);
  double before = 1.0;
  // Red clips from exposure 1.4 on, green from 1.7, blue from 2.1.
  for (int step = 0; step < 70; ++step) {
    const double exposure = 1.2 + 0.02 * step;
    RgbImage picture = Photograph(kExposureScale * exposure, -1.0, kVeil);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const double code = std::clamp(picture.data()[i] + noise(random), 0.0, 255.0);
      picture.data()[i] = static_cast<std::uint8_t>(std::lround(code));
    }
    const auto estimate = meter.Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(estimate) << exposure;
    EXPECT_FALSE(estimate->dappled) << exposure;
    const LinearRgb off = estimate->exposure_scale / (kExposureScale * exposure);
    // Estimates from black modules alone contain the glare: 0.006 of 0.05.
    const double most = exposure < 2.0 ? 0.07 : 0.18;
    EXPECT_NEAR(off.r, 1.0, most) << exposure;
    EXPECT_NEAR(off.g, 1.0, most) << exposure;
    EXPECT_NEAR(off.b, 1.0, most) << exposure;
    EXPECT_NEAR(off.r / off.b, 1.0, 0.07) << "no cast where a channel is read by its blacks";
    if (step > 0) {
      EXPECT_NEAR(off.g / before, 1.0, 0.15) << exposure;
    }
    before = off.g;
  }
}

TEST(MarkerLightMeter, ReadsCodesByTheCamerasOwnResponse) {
  const CameraResponse gentle = testing::GentleResponse();
  // Well exposed, and so bright that the white is clipped.
  for (const double exposure : {1.0, 3.0}) {
    const RgbImage picture = Photograph(kExposureScale * exposure, -1.0, 0.0, kMarker, gentle);
    ExpectExposureScale(MeterFor(-1.0, gentle).Measure(picture.view(), kCamera, kFromAbove),
                        kExposureScale * exposure);
    const auto wrong = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(wrong);
    EXPECT_GT(std::fabs(std::log(wrong->exposure_scale.b / (kExposureScale.b * exposure))), 0.15)
        << exposure;
  }
}

TEST(MarkerLightMeter, ReportsNothingOfAMarkerWithBlackOutsideAndWhiteInside) {
  scene::MarkerReflectance reversed = kMarker;
  std::swap(reversed.albedo_black, reversed.albedo_white);
  // Dark, well exposed, and so bright that the white is clipped.
  for (const double exposure : {0.2, 1.0, 1.3, 3.0}) {
    const RgbImage picture = Photograph(kExposureScale * exposure, -1.0, 0.0, reversed);
    EXPECT_FALSE(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove).has_value())
        << exposure;
  }
}

TEST(MarkerLightMeter, ReportsNothingOfAnEvenlyColoredSurface) {
  scene::MarkerReflectance even = kMarker;
  even.albedo_black = even.albedo_white;
  const RgbImage picture = Photograph(kExposureScale, -1.0, 0.0, even);
  EXPECT_FALSE(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove).has_value());
}

TEST(MarkerLightMeter, ReadsThePartOfAMarkerThatGlareLeaves) {
  // A strip over the marker's right side reflects the sun: black looks like white there.
  RgbImage picture = Photograph(kExposureScale, -1.0);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 200; x < picture.width(); ++x) {
      for (int c = 0; c < 3; ++c) picture(x, y, c) = 180;
    }
  }
  ExpectExposureScale(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove), kExposureScale);
}

TEST(MarkerLightMeter, ReportsNothingOfAMarkerThatIsTooSmallOrOutOfThePicture) {
  const RgbImage picture = Photograph(kExposureScale, -1.0);
  Transform<Camera, Marker> far = kFromAbove;
  far.translation_m.z = 8.0;
  EXPECT_FALSE(MeterFor(-1.0).Measure(picture.view(), kCamera, far).has_value());
  Transform<Camera, Marker> aside = kFromAbove;
  aside.translation_m.x = 3.0;
  EXPECT_FALSE(MeterFor(-1.0).Measure(picture.view(), kCamera, aside).has_value());
  Transform<Camera, Marker> behind = kFromAbove;
  behind.translation_m.z = -1.0;
  EXPECT_FALSE(MeterFor(-1.0).Measure(picture.view(), kCamera, behind).has_value());
}

}  // namespace
}  // namespace pleinair::compositor
