// Tests which conclusions the light estimator draws from frames, and which it must not draw.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/srgb.h"
#include "compositor/photometry/light_estimator.h"
#include "compositor/photometry/sky_state.h"
#include "scene/sun_over_place.h"
#include "tests/yard_scene.h"

namespace pleinair::compositor {
namespace {

using testing::PhotographedYard;

const PhotographedYard& Yard() {
  static const PhotographedYard yard;
  return yard;
}

/// Light estimate from a sunny yard whose scene description places the sun `off_deg` off its true
/// azimuth.
LightEstimate Estimate(double off_deg, const PhotographedYard::Light& light,
                       const LightOverrides& overrides = {},
                       const char* said_time = "2025-09-14T13:50:00Z") {
  const PhotographedYard& yard = Yard();
  const UtcTime time = *UtcTime::Parse(said_time);
  const scene::SceneDescription scene = tests::YardScene(yard, off_deg, time);
  const std::shared_ptr<const PhantomRays> phantoms(&yard.phantoms(), [](const auto*) {});
  LightEstimator look(phantoms, yard.camera(), yard.marker(), scene, overrides, time, {});
  for (const int i : {0, 1}) look.Add(yard.Photograph(i, light).view(), PhotographedYard::Pose(i));
  LightFilter light_filter;
  return look.Estimate(&light_filter);
}

LightOverrides SunToSkyOf(double ratio) {
  LightOverrides overrides;
  overrides.sun_to_sky = ratio;
  return overrides;
}

TEST(LightEstimator, SeesThatTheSunShines) {
  const LightEstimate found = Estimate(0.0, {});
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_GT(found.skies.source->ForSun({{0, 0, 1}}, 1.0)->SunNormalIrradiance().g, 0.0);
  EXPECT_EQ(found.skies.marker_shade, (LinearRgb{1, 1, 1}));
}

TEST(LightEstimator, SeesThatNoSunShines) {
  const LightEstimate found = Estimate(0.0, {.sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_EQ(found.skies.source->ForSun({{0, 0, 1}}, 1.0)->SunNormalIrradiance().g, 0.0);
}

TEST(LightEstimator, SeesByPlanesThatNoSunShinesWhereAllLiesBehindAWall) {
  // The described sun is low behind the yard's wall: hardly any shadow edge is visible.
  const auto settle = [](const PhotographedYard::Light& light) {
    return Estimate(245.0, light, {}, "2025-09-14T16:45:00Z");
  };
  const LightEstimate veiled = settle({.sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_LT(veiled.measured.evidence.edges, 3);
  EXPECT_EQ(veiled.measured.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_FALSE(veiled.measured.sun_shines);
  ASSERT_NE(veiled.skies.source, nullptr);
  EXPECT_EQ(veiled.skies.source->ForSun({{0, 0, 1}}, 1.0)->SunNormalIrradiance().g, 0.0);
  // Under a sun in another direction the planes do not look overcast either.
  EXPECT_EQ(settle({}).measured.sun_source, MeasuredLight::Source::kDescription);
}

TEST(LightEstimator, SeesByStatedColorsThatNoSunShinesWherePlanesOfOneMaterialDoNotTell) {
  // Beside the wall, which faces another part of the sky.
  const auto settle = [](PhotographedYard::Light light) {
    light.colors_as_described = true;
    return Estimate(230.0, light, {}, "2025-09-14T16:45:00Z").measured;
  };
  const MeasuredLight veiled = settle({.sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_LT(veiled.evidence.edges, 3);
  EXPECT_EQ(veiled.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_FALSE(veiled.sun_shines);
  EXPECT_EQ(settle({}).sun_source, MeasuredLight::Source::kDescription);
}

TEST(LightEstimator, ReadsTheSkyFromTheShadeOfATreeThatHidesAllEdges) {
  const PhotographedYard& yard = Yard();
  const auto tree = [&](Vec3 p) {
    return yard.IsBesideShadowEdge(p) || std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > 0.0;
  };
  const LightEstimate hazy = Estimate(0.0, {.sky_radiance_scale = {2.5, 2.5, 2.5}, .shaded = tree});
  EXPECT_FALSE(hazy.measured.sun_doubtful);
  EXPECT_EQ(hazy.measured.sun_source, MeasuredLight::Source::kShade);
  EXPECT_GE(hazy.measured.evidence.shade_places, 4);
  EXPECT_GT(hazy.measured.sun_to_sky_error, 0.1);
  ASSERT_NE(hazy.skies.source, nullptr);
  EXPECT_NE(hazy.skies.sun_transmittance, nullptr);
  // A description with a much fainter sky influences the estimate, but by less than half.
  const sky::SkyModel& model = yard.model();
  const auto off = [&](const sky::SkySource& skies, LinearRgb scale) {
    const auto day = skies.ForSun(model.ToSun(), 1.0);
    const auto share = [](const sky::SkyModel& of) {
      return of.SkyHorizontalIrradiance().g / of.SunNormalIrradiance().g;
    };
    return std::fabs(std::log(share(*day) * scale.g / (2.5 * share(model))));
  };
  scene::SceneDescription words;
  words.cloudiness = scene::Cloudiness::kClear;
  const double stated = off(*DescribedSky(words), {1, 1, 1});
  EXPECT_GT(stated, 0.8);
  EXPECT_LT(off(*hazy.skies.source, hazy.skies.scale), 0.5 * stated);
}

/// A marker on bare ground without phantom shadows.
class BareGround {
 public:
  BareGround() {
    scene_.place_time.latitude_deg = 50.0;
    scene_.cloudiness = scene::Cloudiness::kClear;
    const sky::SunPosition sun = scene::SunOver(scene_.place_time, time_);
    day_ = SunlitSky(scene_)->ForSun(sun.ToSun(), sun.distance_au);
  }

  /// Light estimate from frames whose sky-to-sun ratio is `sky_radiance_scale` times that of a
  /// clear day. An unmodelled shadow covers points within `reach_m` of the marker's centre with x
  /// below `shadow_to_x_m`.
  LightEstimate Estimate(scene::Cloudiness said, double sky_radiance_scale, double shadow_to_x_m,
                         double reach_m = 0.4) const {
    const LinearRgb sky = day_->SkyHorizontalIrradiance() * sky_radiance_scale;
    const LinearRgb open = sky + day_->SunNormalIrradiance() * day_->ToSun().xyz.z;
    RgbImage picture(camera_.width, camera_.height, 3);
    const auto marker_from_camera = camera_from_marker_.Inverse();
    const Vec3 eye = marker_from_camera.translation_m;
    for (int y = 0; y < camera_.height; ++y) {
      for (int x = 0; x < camera_.width; ++x) {
        const Vec2 ray = UndistortPixel(camera_, {static_cast<double>(x), static_cast<double>(y)});
        const Vec3 way = marker_from_camera.rotation * Vec3{ray.x, ray.y, 1};
        const Vec3 p = eye + way * (-eye.z / way.z);
        const double from_middle = std::max(std::fabs(p.x), std::fabs(p.y));
        double albedo = 0.3;
        if (from_middle < print_.board_size_m / 2) albedo = print_.albedo_white;
        if (from_middle < print_.size_m / 2) albedo = print_.albedo_black;
        const bool shaded = from_middle < reach_m && p.x < shadow_to_x_m;
        const LinearRgb light =
            (shaded ? sky : open) * (albedo / std::numbers::pi * kExposureScale);
        picture(x, y, 0) = Srgb8FromLinear(light.r);
        picture(x, y, 1) = Srgb8FromLinear(light.g);
        picture(x, y, 2) = Srgb8FromLinear(light.b);
      }
    }
    scene::SceneDescription scene = scene_;
    scene.cloudiness = said;
    LightEstimator look({solver_, &solver_->phantoms()}, camera_, print_, scene, {}, time_, {});
    for (int i = 0; i < 2; ++i) look.Add(picture.view(), camera_from_marker_);
    LightFilter light_filter;
    return look.Estimate(&light_filter);
  }

  /// Estimated sky-to-sun ratio relative to that of the clear day.
  double SkyScaleOf(const LightEstimate& found) const {
    const auto day = found.skies.source->ForSun(day_->ToSun(), 1.0);
    return SunToSky(*day_) / SunToSky(*day) * found.skies.scale.g;
  }

 private:
  static constexpr double kExposureScale = 3.0e-5;
  UtcTime time_ = *UtcTime::Parse("2025-09-14T13:50:00Z");
  scene::SceneDescription scene_;
  std::unique_ptr<sky::SkyModel> day_;
  std::shared_ptr<const LightSolver> solver_ = *LightSolver::Create(
      {testing::Phantom(testing::Ground(3.0, {0.3F, 0.3F, 0.3F}))}, {.rays_per_vertex = 64});
  CameraModel camera_{.width = 400, .height = 300, .fx = 330, .fy = 330, .cx = 200, .cy = 150};
  scene::MarkerReflectance print_{.size_m = 0.6, .board_size_m = 0.8, .black_band_m = 0.1};
  Transform<Camera, Marker> camera_from_marker_ = PhotographedYard::Pose(0);
};

TEST(LightEstimator, ReadsTheSkyFromAShadowAcrossTheMarkerThatNoPhantomCasts) {
  using scene::Cloudiness;
  const BareGround ground;
  constexpr double kSkyScale = 2.5;
  const auto expect_told = [&](const LightEstimate& found) {
    EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kMarker);
    EXPECT_FALSE(found.measured.sun_doubtful);
    EXPECT_GT(found.measured.sun_to_sky_error, 0.1);
    ASSERT_NE(found.skies.source, nullptr);
    const double off = std::fabs(std::log(ground.SkyScaleOf(found) / kSkyScale));
    EXPECT_LT(off, 0.5 * std::log(kSkyScale)) << "weighed against the words, less certain than it";
  };
  expect_told(ground.Estimate(Cloudiness::kClear, kSkyScale, 0.1));
  expect_told(ground.Estimate(Cloudiness::kHazy, kSkyScale, 0.1));
  // If the description has no sun, the ground must show the shadow too.
  constexpr double kBeyondMarker = 1.5;
  expect_told(ground.Estimate(Cloudiness::kOvercast, kSkyScale, 0.1, kBeyondMarker));
  const auto source = [&](Cloudiness said, double shadow_to_x_m) {
    return ground.Estimate(said, kSkyScale, shadow_to_x_m).measured.sun_source;
  };
  EXPECT_EQ(source(Cloudiness::kOvercast, 0.1), MeasuredLight::Source::kDescription);
  EXPECT_EQ(source(Cloudiness::kClear, -1.0), MeasuredLight::Source::kDescription);
}

TEST(LightEstimator, KeepsTheMapUnderAGivenRatio) {
  const PhotographedYard& yard = Yard();
  const auto leaves = [&](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y) > 0.0; };
  const LightEstimate found = Estimate(0.0, {.shaded = leaves}, SunToSkyOf(2.0));
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_NE(found.skies.sun_transmittance, nullptr);
  ASSERT_NE(found.skies.source, nullptr);
  EXPECT_GT(found.skies.source->ForSun(yard.model().ToSun(), 1.0)->SunNormalIrradiance().g, 0.0);
}

LightOverrides Fitted() {
  LightOverrides overrides;
  overrides.fitted = true;
  return overrides;
}

TEST(FittedLight, TellsSunCloudsAndASunElsewhereApart) {
  const LightEstimate sunny = Estimate(0.0, {.sky_radiance_scale = {1.5, 1.5, 1.5}}, Fitted());
  EXPECT_EQ(sunny.measured.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_FALSE(sunny.measured.sun_doubtful);
  EXPECT_EQ(sunny.skies.marker_shade, (LinearRgb{1, 1, 1}));
  ASSERT_TRUE(sunny.measured.sun_to_sky_error);
  EXPECT_LT(*sunny.measured.sun_to_sky_error, 0.15);
  const LightEstimate veiled =
      Estimate(0.0, {.sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0}, Fitted());
  EXPECT_EQ(veiled.measured.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_FALSE(veiled.measured.sun_shines);
  ASSERT_NE(veiled.skies.source, nullptr);
  EXPECT_EQ(veiled.skies.source->ForSun({{0, 0, 1}}, 1.0)->SunNormalIrradiance().g, 0.0);
  const LightEstimate elsewhere = Estimate(60.0, {}, Fitted());
  EXPECT_TRUE(elsewhere.measured.sun_doubtful);
  EXPECT_EQ(elsewhere.measured.sun_source, MeasuredLight::Source::kDescription);
  EXPECT_EQ(elsewhere.skies.source, nullptr);
}

TEST(FittedLight, ReadsTheSkyFromTheShadeOfATreeThatHidesAllEdges) {
  const PhotographedYard& yard = Yard();
  const auto tree = [&](Vec3 p) {
    return yard.IsBesideShadowEdge(p) || std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > 0.0;
  };
  const LightEstimate hazy =
      Estimate(0.0, {.sky_radiance_scale = {2.5, 2.5, 2.5}, .shaded = tree}, Fitted());
  EXPECT_FALSE(hazy.measured.sun_doubtful);
  EXPECT_GT(hazy.measured.sun_to_sky_error, 0.1);
  EXPECT_NE(hazy.skies.sun_transmittance, nullptr);
}

TEST(FittedLight, LeavesANightToTheWords) {
  const LightEstimate found = Estimate(0.0, {.sun_scale = 0.0}, Fitted(), "2025-09-14T23:00:00Z");
  EXPECT_EQ(found.skies.source, nullptr);
  EXPECT_FALSE(found.measured.sun_doubtful);
}

/// Sky state under user-provided light `overrides`; determines the test for unmodelled shadows.
SkyState GivenSkies(const LightOverrides& overrides, const PhotographedYard::Light& light) {
  const LightEstimate found = Estimate(0.0, light, overrides);
  EXPECT_EQ(found.measured.heading_source, MeasuredLight::Source::kDescription);
  EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kDescription);
  EXPECT_EQ(found.measured.heading_offset.value(), 0.0);
  EXPECT_NE(found.skies.source, nullptr);
  return found.skies;
}

TEST(LightEstimator, AsksUnderAStatedLightForShadeAlone) {
  LightOverrides stated;
  stated.as_described = true;
  const SkyState open = GivenSkies(stated, {});
  EXPECT_FALSE(open.unmodelled_shadows) << "joints and edges would look shaded";
  EXPECT_EQ(open.scale, (LinearRgb{1, 1, 1}));
  const SkyState hazy = GivenSkies(stated, {.sky_radiance_scale = {1.5, 1.5, 1.5}});
  EXPECT_FALSE(hazy.unmodelled_shadows);
  const auto of = [](const SkyState& skies) {
    return skies.source->ForSun({{0.6, 0.0, 0.8}}, 1.0)->SkyHorizontalIrradiance();
  };
  EXPECT_EQ(of(hazy), of(open)) << "measured, though it is stated";
  const auto leaves = [](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y) > 0.0; };
  const SkyState shaded = GivenSkies(stated, {.shaded = leaves});
  EXPECT_TRUE(shaded.unmodelled_shadows);
  EXPECT_EQ(shaded.sun_transmittance, nullptr);
  EXPECT_EQ(shaded.marker_shade, (LinearRgb{1, 1, 1}));
}

TEST(LightEstimator, AsksForShadeWhereRatioAndHeadingAreGiven) {
  LightOverrides given = SunToSkyOf(3.0);
  given.heading_deg = 0.0;  // Only its presence matters; the scene has the same value.
  EXPECT_FALSE(GivenSkies(given, {}).unmodelled_shadows);
  const auto leaves = [](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y) > 0.0; };
  const SkyState shaded = GivenSkies(given, {.shaded = leaves});
  EXPECT_TRUE(shaded.unmodelled_shadows);
  EXPECT_NE(shaded.sun_transmittance, nullptr);
}

TEST(LightEstimator, DoubtsNoSunThatIsGiven) {
  // The shadows contradict the sun's position. The description would be doubtful, the user's value
  // is not.
  const LightEstimate found = Estimate(60.0, {}, SunToSkyOf(2.0));
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_EQ(found.skies.sun_transmittance, nullptr);
}

TEST(LightEstimator, SettlesANightWhoseRatioIsGiven) {
  // The yard may be lit by a lamp: no ratio can put the sun above the horizon.
  const PhotographedYard::Light lamp{.sun_scale = 0.0};
  for (const double ratio : {0.0, 2.0}) {
    const LightEstimate found = Estimate(0.0, lamp, SunToSkyOf(ratio), "2025-09-14T23:00:00Z");
    EXPECT_EQ(found.skies.sun_transmittance, nullptr);
    EXPECT_EQ(found.skies.marker_shade, (LinearRgb{1, 1, 1}));
    if (found.skies.source == nullptr) continue;
    const auto sky = found.skies.source->ForSun({{0.8, 0.0, -0.6}}, 1.0);
    EXPECT_EQ(sky->SunNormalIrradiance().g, 0.0);
    EXPECT_TRUE(std::isfinite(sky->SkyHorizontalIrradiance().g));
  }
}

TEST(LightEstimator, BelievesTheWordsAloneWhereTheSunStandsElsewhere) {
  for (const double off_deg : {60.0, 30.0, -30.0}) {
    const LightEstimate found = Estimate(off_deg, {});
    EXPECT_TRUE(found.measured.sun_doubtful) << off_deg;
    EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kDescription) << off_deg;
    EXPECT_EQ(found.measured.heading_source, MeasuredLight::Source::kDescription) << off_deg;
    EXPECT_EQ(found.skies.source, nullptr) << off_deg;
    EXPECT_EQ(found.skies.sun_transmittance, nullptr) << "phantoms' own shadows would be leaves'";
  }
}

}  // namespace
}  // namespace pleinair::compositor
