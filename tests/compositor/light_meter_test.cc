#include "compositor/light_meter.h"

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

namespace pleinair::compositor {
namespace {

constexpr double kAmbientLux = 12000, kSunLux = 80000;

/// Light from straight above and an even sky.
class OverheadSun : public sky::SkyModel {
 public:
  LinearRgb SkyRadiance(Direction<World>) const override { return {1, 1, 1}; }
  LinearRgb SunNormalIrradiance() const override { return {kSunLux, kSunLux, kSunLux}; }
  LinearRgb SkyHorizontalIrradiance() const override {
    return {kAmbientLux, kAmbientLux, kAmbientLux};
  }
  Direction<World> ToSun() const override { return {{0, 0, 1}}; }
};

/// Phantoms that leave half the print (x below `shadow_to_x_m`) in shadow.
class HalfShadow : public LightSolver {
 public:
  explicit HalfShadow(double shadow_to_x_m) : shadow_to_x_m_(shadow_to_x_m) {}
  std::vector<LitMesh> SolveUnderTrees(const sky::SkyModel&, const Mat3&,
                                       const SeenSunlight&) const override {
    return {};
  }
  DaylightCoefficients Coefficients(Vec3, const CoefficientOptions&,
                                    const CoefficientProgress&) const override {
    return {};
  }
  std::vector<LitMesh> Relight(const DaylightCoefficients&, const sky::SkyModel&,
                               const Mat3&) const override {
    return {};
  }
  double SunVisibilityPhantomsOnly(Point<Marker> point, Vec3) const override {
    return point.xyz.x < shadow_to_x_m_ ? 0.0 : 1.0;
  }
  bool ReachesPhantomsOnly(Point<Marker>, Vec3) const override { return true; }
  std::optional<PhantomSurface> FirstPhantom(Point<Marker>, Vec3) const override { return {}; }
  std::vector<LinearRgb> AmbientPhantomsOnly(std::span<const Point<Marker>> points, Vec3,
                                             const sky::SkyModel&, const Mat3&,
                                             std::uint32_t) const override {
    return std::vector<LinearRgb>(points.size(), {kAmbientLux, kAmbientLux, kAmbientLux});
  }
  LinearRgb RadianceFromBelow(const sky::SkyModel&, const Mat3&,
                              const SeenSunlight&) const override {
    return {};
  }

 private:
  double shadow_to_x_m_;
};

const MarkerPrint kPrint{.size_m = 0.4, .board_size_m = 0.5, .black_band_m = 0.05};
const CameraModel kCamera{.width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120};
// One metre above the print, looking straight down.
const Transform<Camera, Marker> kFromAbove{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 1}};

/// The print in the light of OverheadSun; left of `shadow_to_x_m` in shadow, and an even veil
/// added.
RgbImage Photograph(LinearRgb gain, double shadow_to_x_m, double veil = 0.0,
                    const MarkerPrint& print = kPrint, const CameraResponse& response = {}) {
  RgbImage picture(kCamera.width, kCamera.height, 3);
  for (int y = 0; y < kCamera.height; ++y) {
    for (int x = 0; x < kCamera.width; ++x) {
      const Vec2 ray = UndistortPixel(kCamera, {static_cast<double>(x), static_cast<double>(y)});
      const double distance = std::max(std::fabs(ray.x), std::fabs(ray.y));
      const double albedo = distance < print.size_m / 2 ? print.albedo_black : print.albedo_white;
      const double lux = kAmbientLux + (ray.x < shadow_to_x_m ? 0.0 : kSunLux);
      const double radiance = albedo * lux / std::numbers::pi;
      picture(x, y, 0) = response.Encoded8(gain.r * radiance + veil, 0);
      picture(x, y, 1) = response.Encoded8(gain.g * radiance + veil, 1);
      picture(x, y, 2) = response.Encoded8(gain.b * radiance + veil, 2);
    }
  }
  return picture;
}

LightMeter MeterFor(double predicted_shadow_to_x_m, const CameraResponse& response = {}) {
  return LightMeter(kPrint, HalfShadow(predicted_shadow_to_x_m), OverheadSun(), Mat3{}, response);
}

const LinearRgb kGain{3.0e-5, 2.5e-5, 2.0e-5};

void ExpectGain(const std::optional<LightReading>& reading, LinearRgb gain) {
  ASSERT_TRUE(reading.has_value());
  EXPECT_NEAR(reading->gain.r / gain.r, 1.0, 0.02);
  EXPECT_NEAR(reading->gain.g / gain.g, 1.0, 0.02);
  EXPECT_NEAR(reading->gain.b / gain.b, 1.0, 0.02);
}

TEST(LightMeter, ReadsExposureAndWhiteBalanceOfASunlitPrint) {
  const RgbImage picture = Photograph(kGain, -1.0);
  const auto reading = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ExpectGain(reading, kGain);
  EXPECT_LT(std::max({reading->error.r, reading->error.g, reading->error.b}), 0.005);
  EXPECT_FALSE(reading->dappled);
  EXPECT_EQ(reading->lit_share, 1.0);
}

TEST(LightMeter, TellsHowCertainItsReadingIs) {
  // More noise in green: gains scatter from picture to picture as each says of itself.
  constexpr int kPictures = 60;
  const RgbImage clean = Photograph(kGain, -1.0);
  const LightMeter meter = MeterFor(-1.0);
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  LinearRgb said;
  std::array<double, 3> sum{}, squares{};
  for (int i = 0; i < kPictures; ++i) {
    RgbImage picture = Photograph(kGain, -1.0);
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        for (const int c : {0, 1, 2}) {
          const double code = clean(x, y, c) + (c == 1 ? 8.0 : 4.0) * noise(random);
          picture(x, y, c) = static_cast<std::uint8_t>(std::lround(code));
        }
      }
    }
    const auto reading = meter.Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(reading);
    ASSERT_FALSE(reading->dappled);
    said = said + reading->error * (1.0 / kPictures);
    const LinearRgb off = reading->gain / kGain;
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

TEST(LightMeter, KnowsWhichPartLiesInThePhantomsShadow) {
  const RgbImage picture = Photograph(kGain, 0.05);
  const auto reading = MeterFor(0.05).Measure(picture.view(), kCamera, kFromAbove);
  ExpectGain(reading, kGain);
  EXPECT_GT(reading->lit_share, 0.2);
  EXPECT_LT(reading->lit_share, 0.8);
}

TEST(LightMeter, ReadsAPrintThatLiesWhollyInShadow) {
  const RgbImage picture = Photograph(kGain * 5.0, 1.0);
  const auto reading = MeterFor(1.0).Measure(picture.view(), kCamera, kFromAbove);
  ExpectGain(reading, kGain * 5.0);
  EXPECT_EQ(reading->lit_share, 0.0);
}

TEST(LightMeter, TakesTheSunlitPartWhenAnUnknownShadowCrossesThePrint) {
  const RgbImage picture = Photograph(kGain, 0.05);
  ExpectGain(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove), kGain);
}

TEST(LightMeter, TellsHowDeepTheShadowIsThatDividesThePrint) {
  const double contrast = std::log((kAmbientLux + kSunLux) / kAmbientLux);
  const auto expect = [&](const LightMeter& meter, double shadow_to_x_m, double veil) {
    const RgbImage picture = Photograph(kGain, shadow_to_x_m, veil);
    const auto shadow = meter.FindShadow(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(shadow);
    EXPECT_NEAR(shadow->contrast.r, contrast, 0.05);
    EXPECT_NEAR(shadow->contrast.g, contrast, 0.05);
    EXPECT_NEAR(shadow->contrast.b, contrast, 0.05);
    EXPECT_GT(shadow->lit.xyz.x, 0.05);
    EXPECT_LT(shadow->shaded.xyz.x, 0.05);
  };
  expect(MeterFor(-1.0), 0.05, 0.0);   // Of something that no phantom stands for,
  expect(MeterFor(-1.0), 0.05, 0.05);  // through a veil,
  expect(MeterFor(0.05), 0.05, 0.0);   // and of a phantom.
}

TEST(LightMeter, TakesNoCoverAndNoLeavesForAShadowsEdge) {
  const auto shadow = [](const RgbImage& picture) {
    const LightMeter meter = MeterFor(-1.0);
    EXPECT_TRUE(meter.Measure(picture.view(), kCamera, kFromAbove));
    return meter.FindShadow(picture.view(), kCamera, kFromAbove);
  };
  EXPECT_FALSE(shadow(Photograph(kGain, -1.0)));
  // Grey things on the print, in the sun: over all of it to the left, over white or black alone.
  const auto with_cover = [](double share_of_white, const auto& covers) {
    RgbImage picture = Photograph(kGain, -1.0);
    const RgbImage grey = Photograph(kGain * share_of_white, -1.0, 0.0,
                                     {.size_m = 0.0, .board_size_m = 0.5, .black_band_m = 0.05});
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        if (!covers(x - 160, y - 120)) continue;
        for (int c = 0; c < 3; ++c) picture(x, y, c) = grey(x, y, c);
      }
    }
    return picture;
  };
  constexpr int kEdgePx = 60;  // The black square's.
  EXPECT_FALSE(shadow(with_cover(0.3, [](int x, int) { return x < -20; })));
  EXPECT_FALSE(shadow(with_cover(0.3, [](int x, int) { return x < -kEdgePx; })));
  EXPECT_FALSE(
      shadow(with_cover(0.7, [](int x, int) { return x >= -kEdgePx && x < -kEdgePx / 2; })));
}

/// A print under leaves that leave between a quarter and all of the sun; no edge divides light from
/// shade. `blue`: how much of that blue shows, as under a blue sky. `exposure`: of kGain, clipped
/// at white.
RgbImage UnderLeaves(double blue, double* mean, double exposure = 1.0) {
  RgbImage picture = Photograph(kGain, -1.0);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double leaves = std::sin(0.31 * x + 0.05 * y) * std::sin(0.23 * y - 0.08 * x);
      const double sun = std::clamp(0.7 + 0.45 * leaves, 0.25, 1.0);
      const double share = (kAmbientLux + sun * kSunLux) / (kAmbientLux + kSunLux);
      *mean += share / (picture.width() * picture.height());
      for (int c = 0; c < 3; ++c) {
        const double left = c == 2 ? 1.0 - blue * (1.0 - share) : share;
        const double linear = LinearFromSrgb8()[picture(x, y, c)] * left * exposure;
        picture(x, y, c) = Srgb8FromLinear(std::min(linear, 1.0));
      }
    }
  }
  return picture;
}

TEST(LightMeter, TakesTheBrightestSpotsUnderLeaves) {
  double mean = 0.0;
  const RgbImage picture = UnderLeaves(1.0, &mean);
  ASSERT_LT(mean, 0.8) << "the middle of the light is far below the sun";
  const auto reading = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(reading);
  EXPECT_TRUE(reading->dappled);
  EXPECT_FALSE(MeterFor(-1.0).FindShadow(picture.view(), kCamera, kFromAbove));
  EXPECT_GT(reading->error.g, 0.10);
  EXPECT_NEAR(reading->gain.r / kGain.r, 1.0, 0.08);
  EXPECT_NEAR(reading->gain.g / kGain.g, 1.0, 0.08);
  EXPECT_NEAR(reading->gain.b / kGain.b, 1.0, 0.08);
}

TEST(LightMeter, TakesTheSameSpotsUnderLeavesForEachChannel) {
  // So little that blue by itself would be taken for evenly lit, at the middle of its light.
  double mean = 0.0;
  const RgbImage picture = UnderLeaves(0.35, &mean);
  const auto reading = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(reading);
  EXPECT_TRUE(reading->dappled);
  EXPECT_LT(reading->error.b, 0.10);
  EXPECT_GT(reading->error.g, 0.10);
  const double bright_g = reading->gain.g / kGain.g;
  EXPECT_NEAR(reading->gain.b / kGain.b, 1.0 - 0.35 * (1.0 - bright_g), 0.02);
}

TEST(LightMeter, TakesTheSameSpotsUnderLeavesWhereOneChannelIsClipped) {
  double mean = 0.0;
  RgbImage picture = UnderLeaves(1.0, &mean);
  // Half as much again of red: clipped on the very brightest spots, though not on most.
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double red = 1.5 * LinearFromSrgb8()[picture(x, y, 0)];
      picture(x, y, 0) = Srgb8FromLinear(std::min(red, 1.0));
    }
  }
  const auto reading = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(reading);
  ASSERT_TRUE(reading->dappled);
  EXPECT_NEAR(reading->gain.r / reading->gain.g, 1.5 * kGain.r / kGain.g, 0.03);
  EXPECT_NEAR(reading->gain.b / reading->gain.g, kGain.b / kGain.g, 0.03);
}

TEST(LightMeter, ReadsTheSunUnderLeavesWhereItClipsEvenMostOfThePrint) {
  // White clips wherever more than half of the sun is: most spots that are left are half-lit.
  for (const double exposure : {1.6, 2.2}) {
    double mean = 0.0;
    const RgbImage picture = UnderLeaves(1.0, &mean, exposure);
    const auto reading = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(reading);
    EXPECT_TRUE(reading->dappled);
    EXPECT_NEAR(reading->gain.r / (exposure * kGain.r), 1.0, 0.1) << exposure;
    EXPECT_NEAR(reading->gain.g / (exposure * kGain.g), 1.0, 0.1) << exposure;
    EXPECT_NEAR(reading->gain.b / (exposure * kGain.b), 1.0, 0.1) << exposure;
  }
}

/// Phantoms leave the print's right side in the sun, and something else of that side a strip of
/// `sunlit_m`. `half_light`: of the strip's light, where it ends; towards its middle all is left.
RgbImage SunlitStrip(double sunlit_m, double half_light) {
  RgbImage picture = Photograph(kGain, 1.0);
  const RgbImage sunlit = Photograph(kGain, -1.0);
  const int half = static_cast<int>(sunlit_m / 2 * kCamera.fy);
  for (int y = 120 - half; y <= 120 + half; ++y) {
    const double left = 1.0 - (1.0 - half_light) * std::abs(y - 120) / half;
    for (int x = 0; x < picture.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        picture(x, y, c) = Srgb8FromLinear(left * LinearFromSrgb8()[sunlit(x, y, c)]);
      }
    }
  }
  return picture;
}

constexpr double kStripFromX_m = 0.17;

TEST(LightMeter, ReadsTheSunOffTheFewSpotsThatAShadowLeavesIt) {
  const RgbImage picture = SunlitStrip(0.06, 1.0);
  const auto reading = MeterFor(kStripFromX_m).Measure(picture.view(), kCamera, kFromAbove);
  ExpectGain(reading, kGain);
  EXPECT_LT(reading->pairs, LightMeter::kMinimumPairs);
  EXPECT_FALSE(reading->dappled) << "a sharp edge and one level are no leaves";
}

TEST(LightMeter, TakesAFewSpotsOfUnevenLightForASpotBetweenLeaves) {
  const RgbImage picture = SunlitStrip(0.06, 0.5);
  const auto reading = MeterFor(kStripFromX_m).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(reading);
  EXPECT_LT(reading->pairs, LightMeter::kMinimumPairs);
  EXPECT_TRUE(reading->dappled);
  EXPECT_GT(reading->error.g, 0.1);
}

TEST(LightMeter, SaysNothingWhereAShadowLeavesFewerThanSixSpotsInTheSun) {
  // Of the right side's pairs something covers half, so that few are enough for a level.
  const auto measure = [](double sunlit_m) {
    RgbImage picture = SunlitStrip(sunlit_m, 1.0);
    for (int y = 0; y < 114; ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        for (int c = 0; c < 3; ++c) picture(x, y, c) = 90;
      }
    }
    return MeterFor(kStripFromX_m).Measure(picture.view(), kCamera, kFromAbove);
  };
  EXPECT_FALSE(measure(0.026));
  ExpectGain(measure(0.06), kGain);
}

TEST(LightMeter, ChangesLittleWhereLeavesBeginToShow) {
  double before = 0.0;
  bool even = false, dappled = false;
  for (int step = 10; step <= 60; ++step) {
    RgbImage picture = Photograph(kGain, -1.0);
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const double leaves = std::sin(0.31 * x + 0.05 * y) * std::sin(0.23 * y - 0.08 * x);
        const double share = 1.0 - 0.005 * step * (1.0 - leaves);
        for (int c = 0; c < 3; ++c) {
          picture(x, y, c) = Srgb8FromLinear(LinearFromSrgb8()[picture(x, y, c)] * share);
        }
      }
    }
    const auto reading = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(reading);
    (reading->dappled ? dappled : even) = true;
    if (step > 10) {
      EXPECT_NEAR(reading->gain.g / before, 1.0, 0.03) << step;
    }
    before = reading->gain.g;
  }
  EXPECT_TRUE(even && dappled);
}

TEST(LightMeter, CancelsVeilingGlare) {
  const RgbImage picture = Photograph(kGain, -1.0, 0.05);
  ExpectGain(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove), kGain);
}

TEST(LightMeter, FallsBackToTheBlackWhereTheWhiteIsClipped) {
  const RgbImage picture = Photograph(kGain * 3.0, -1.0);
  ExpectGain(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove), kGain * 3.0);
}

TEST(LightMeter, ReadsAnEvenPrintThroughNoiseAndGlareWhereItBeginsToClip) {
  constexpr double kVeil = 0.006;
  const LightMeter meter = MeterFor(-1.0);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 4.0);
  double before = 1.0;
  // Red clips from 1.4 on, green from 1.7, blue from 2.1.
  for (int step = 0; step < 70; ++step) {
    const double exposure = 1.2 + 0.02 * step;
    RgbImage picture = Photograph(kGain * exposure, -1.0, kVeil);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const double code = std::clamp(picture.data()[i] + noise(random), 0.0, 255.0);
      picture.data()[i] = static_cast<std::uint8_t>(std::lround(code));
    }
    const auto reading = meter.Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(reading) << exposure;
    EXPECT_FALSE(reading->dappled) << exposure;
    const LinearRgb off = reading->gain / (kGain * exposure);
    // Blacks alone have the glare in them: 0.006 of 0.05.
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

TEST(LightMeter, ReadsCodesByTheCamerasOwnResponse) {
  const CameraResponse gentle = testing::GentleResponse();
  // Well exposed, and so bright that the white clips.
  for (const double exposure : {1.0, 3.0}) {
    const RgbImage picture = Photograph(kGain * exposure, -1.0, 0.0, kPrint, gentle);
    ExpectGain(MeterFor(-1.0, gentle).Measure(picture.view(), kCamera, kFromAbove),
               kGain * exposure);
    const auto wrong = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(wrong);
    EXPECT_GT(std::fabs(std::log(wrong->gain.b / (kGain.b * exposure))), 0.15) << exposure;
  }
}

TEST(LightMeter, SaysNothingOfAPrintWithBlackOutsideAndWhiteInside) {
  MarkerPrint reversed = kPrint;
  std::swap(reversed.albedo_black, reversed.albedo_white);
  // Dark, well exposed, and so bright that the white clips.
  for (const double exposure : {0.2, 1.0, 1.3, 3.0}) {
    const RgbImage picture = Photograph(kGain * exposure, -1.0, 0.0, reversed);
    EXPECT_FALSE(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove).has_value())
        << exposure;
  }
}

TEST(LightMeter, SaysNothingOfAnEvenlyColouredSurface) {
  MarkerPrint even = kPrint;
  even.albedo_black = even.albedo_white;
  const RgbImage picture = Photograph(kGain, -1.0, 0.0, even);
  EXPECT_FALSE(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove).has_value());
}

TEST(LightMeter, ReadsThePartOfAPrintThatGlareLeaves) {
  // A strip over the print's right side reflects the sun: there black looks like white.
  RgbImage picture = Photograph(kGain, -1.0);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 200; x < picture.width(); ++x) {
      for (int c = 0; c < 3; ++c) picture(x, y, c) = 180;
    }
  }
  ExpectGain(MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove), kGain);
}

TEST(LightMeter, SaysNothingOfAMarkerThatIsTooSmallOrOutOfThePicture) {
  const RgbImage picture = Photograph(kGain, -1.0);
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
