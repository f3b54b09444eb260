#include "app/sky/sky_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/sky/sky_exposure.h"
#include "app/sun/sun_path_diagram.h"

namespace pleinair::app {
namespace {

using std::numbers::pi;

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double a = FromDegrees(azimuth_deg).value(), e = FromDegrees(elevation_deg).value();
  return {{std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)}};
}

/// Uniform light from everywhere, and a sun of 50 klx.
class EvenSky : public sky::SkyModel {
 public:
  explicit EvenSky(Direction<World> to_sun) : to_sun_(to_sun) {}
  LinearRgb SkyRadiance(Direction<World> from) const override {
    return from.xyz.z >= 0.0 ? LinearRgb{1000.0, 1000.0, 1000.0} : LinearRgb{};
  }
  LinearRgb SunNormalIrradiance() const override { return {60e3, 50e3, 30e3}; }
  LinearRgb SkyHorizontalIrradiance() const override {
    return LinearRgb{1000.0, 1000.0, 1000.0} * pi;
  }
  Direction<World> ToSun() const override { return to_sun_; }

 private:
  Direction<World> to_sun_;
};

SkyPictureOptions Options(SkyProjection projection, int width_px) {
  SkyPictureOptions options;
  options.projection = projection;
  options.width_px = width_px;
  return options;
}

TEST(SkyPicture, PlacesAndDirectionsAreInverse) {
  for (const SkyProjection projection : {SkyProjection::kFisheye, SkyProjection::kLatLong}) {
    for (const double centre : {90.0, 0.0, -45.0}) {
      SkyPictureOptions options = Options(projection, 300);
      options.centre_azimuth_deg = centre;
      for (double azimuth = 0.5; azimuth < 360.0; azimuth += 17.0) {
        const double lowest = projection == SkyProjection::kFisheye ? 0.5 : -89.0;
        for (double elevation = lowest; elevation < 90.0; elevation += 8.5) {
          const Direction<World> direction = Towards(azimuth, elevation);
          const auto back = DirectionInPicture(options, PlaceInPicture(options, direction));
          ASSERT_TRUE(back);
          EXPECT_LT(Norm(back->xyz - direction.xyz), 1e-12) << azimuth << " " << elevation;
        }
      }
    }
  }
}

TEST(SkyPicture, HasNorthUpAndEastLeftInTheFisheye) {
  const SkyPictureOptions options = Options(SkyProjection::kFisheye, 200);
  const auto expect = [&](double azimuth, double elevation, double x, double y) {
    const Vec2 place = PlaceInPicture(options, Towards(azimuth, elevation));
    EXPECT_NEAR(place.x, x, 1e-9);
    EXPECT_NEAR(place.y, y, 1e-9);
  };
  expect(0.0, 0.0, 100.0, 0.0);
  expect(90.0, 0.0, 0.0, 100.0);
  expect(180.0, 45.0, 100.0, 150.0);
  expect(270.0, 60.0, 100.0 + 100.0 / 3.0, 100.0);
  expect(0.0, 90.0, 100.0, 100.0);
  EXPECT_FALSE(DirectionInPicture(options, {1.0, 1.0}));
}

TEST(SkyPicture, HasEastInTheMiddleOfTheMap) {
  SkyPictureOptions options = Options(SkyProjection::kLatLong, 360);
  const auto column = [&](double azimuth) {
    return PlaceInPicture(options, Towards(azimuth, 10.0)).x;
  };
  EXPECT_NEAR(column(90.0), 180.0, 1e-9);
  EXPECT_NEAR(column(180.0), 270.0, 1e-9);
  EXPECT_NEAR(column(0.0), 90.0, 1e-9);
  EXPECT_NEAR(PlaceInPicture(options, Towards(90.0, 10.0)).y, 80.0, 1e-9);
  options.centre_azimuth_deg = 180.0;
  EXPECT_NEAR(column(180.0), 180.0, 1e-9);
}

double TotalLight(const LightImage& picture, const SkyPictureOptions& options) {
  double total = 0.0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double light = Luminance({picture(x, y, 0), picture(x, y, 1), picture(x, y, 2)});
      double solid_angle = 0.0;
      if (options.projection == SkyProjection::kLatLong) {
        const double step = 2.0 * pi / options.width_px;
        solid_angle = step * step * std::sin((y + 0.5) * step);
      } else {
        const double step = pi / options.width_px;
        const double z =
            step * std::hypot(x + 0.5 - 0.5 * options.width_px, y + 0.5 - 0.5 * options.width_px);
        solid_angle = step * step * std::sin(z) / z;
      }
      total += light * solid_angle;
    }
  }
  return total;
}

// For every pixel size and sun position.
TEST(SkyPicture, SpreadsTheDiscsLightWithoutLosingAny) {
  for (const SkyProjection projection : {SkyProjection::kFisheye, SkyProjection::kLatLong}) {
    for (const int width : {16, 64, 250, 1000}) {
      for (const auto& [azimuth, elevation] :
           {std::pair{10.0, 50.0}, std::pair{270.1, 3.0}, std::pair{90.0, 89.9},
            std::pair{123.0, 90.0}, std::pair{180.0, 75.0}}) {
        const EvenSky sky(Towards(azimuth, elevation));
        SkyPictureOptions options = Options(projection, width);
        const double without = TotalLight(DrawSky(sky, options), options);
        options.disc = true;
        const double with = TotalLight(DrawSky(sky, options), options);
        EXPECT_NEAR((with - without) / Luminance(sky.SunNormalIrradiance()), 1.0, 2e-3)
            << width << " " << azimuth << " " << elevation;
      }
    }
  }
}

TEST(SkyPicture, KeepsTheDiscAboveTheHorizonWhenItSets) {
  const EvenSky sky(Towards(270.0, -0.1));
  SkyPictureOptions options = Options(SkyProjection::kLatLong, 3600);
  options.disc = true;
  const LightImage picture = DrawSky(sky, options);
  const float ground = static_cast<float>(GroundRadiance(sky, options.ground_albedo).g);
  float brightest_below = 0.0f, brightest_above = 0.0f;
  for (int x = 0; x < picture.width(); ++x) {
    brightest_above = std::max(brightest_above, picture(x, 899, 1));
    brightest_below = std::max(brightest_below, picture(x, 900, 1));
  }
  EXPECT_GT(brightest_above, 1e6f);
  EXPECT_EQ(brightest_below, ground);
}

TEST(SkyPicture, LightsItsGround) {
  const EvenSky sky(Towards(180.0, 30.0));
  const LinearRgb ground = GroundRadiance(sky, 0.2);
  EXPECT_NEAR(ground.g, 0.2 / pi * (1000.0 * pi + 50e3 * 0.5), 1e-6);
  SkyPictureOptions options = Options(SkyProjection::kLatLong, 64);
  options.ground_albedo = 0.2;
  EXPECT_FLOAT_EQ(DrawSky(sky, options)(5, 20, 0), static_cast<float>(ground.r));
}

TEST(SkyExposure, FollowsIso12232) {
  EXPECT_NEAR(ExposureOf(0.0).exposure_scale, 1.0 / 1.2, 1e-12);
  EXPECT_NEAR(ExposureOf(15.0).exposure_scale * 1.2 * 32768.0, 1.0, 1e-12);
  EXPECT_NEAR(ExposureOf(11.5).Ev100(), 11.5, 1e-12);
}

TEST(SkyExposure, ShowsTheNightDarkerThanTheDay) {
  double last = 0.0;
  for (double lux = 1e-4; lux < 2e5; lux *= 1.5) {
    const double shown = AutomaticExposure(Lux(lux)).exposure_scale * lux / pi;
    EXPECT_GE(shown, last) << lux;
    EXPECT_LT(shown, 0.7);
    last = shown;
  }
  EXPECT_GT(last, 0.5);
  EXPECT_TRUE(std::isfinite(AutomaticExposure(Lux(0.0)).exposure_scale));
}

TEST(ToneMap, KeepsOrderAndHueAndStaysOnTheScreen) {
  LightImage light(256, 1, 3);
  for (int x = 0; x < 256; ++x) {
    const auto level = static_cast<float>(std::exp2(x / 16.0));
    light(x, 0, 0) = 0.5f * level;
    light(x, 0, 1) = 0.8f * level;
    light(x, 0, 2) = 2.0f * level;
  }
  const RgbImage shown = ToneMap(light, {0.01});
  for (int x = 0; x < 256; ++x) {
    EXPECT_LE(shown(x, 0, 0), shown(x, 0, 1)) << x;
    EXPECT_LE(shown(x, 0, 1), shown(x, 0, 2)) << x;
    if (x == 0) continue;
    EXPECT_GE(shown(x, 0, 1), shown(x - 1, 0, 1)) << x;
    EXPECT_GE(shown(x, 0, 2), shown(x - 1, 0, 2)) << x;
  }
  EXPECT_LT(shown(0, 0, 1), 30);
  EXPECT_EQ(shown(255, 0, 0), 255);  // Far above white is clipped to white.
}

// Stereographic: tan(45°) at the horizon, and circles of the sky stay circles. At an equinox the
// sun's path runs through east and west, and its centre lies on the meridian.
TEST(SunPath, IsStereographic) {
  const Vec2 zenith = ProjectOnSunPath(Radians(0.0), FromDegrees(90.0));
  const Vec2 north = ProjectOnSunPath(Radians(0.0), Radians(0.0));
  const Vec2 east = ProjectOnSunPath(FromDegrees(90.0), Radians(0.0));
  const double radius = Norm(north - zenith);
  EXPECT_NEAR(north.x, zenith.x, 1e-9);
  EXPECT_LT(north.y, zenith.y);
  EXPECT_NEAR(east.x - zenith.x, radius, 1e-9);
  const Vec2 middle = ProjectOnSunPath(FromDegrees(180.0), FromDegrees(30.0));
  EXPECT_NEAR(middle.y - zenith.y, radius * std::tan(FromDegrees(30.0).value()), 1e-9);
  // The great circle through east, west and 40° in the south is the equator at latitude 50°.
  const double tilt = FromDegrees(40.0).value();
  const Vec2 centre{zenith.x, zenith.y - radius * std::tan(tilt)};
  for (double t = 0.1; t < pi; t += 0.3) {
    const Vec3 d{std::cos(t), -std::sin(t) * std::cos(tilt), std::sin(t) * std::sin(tilt)};
    const Vec2 place = ProjectOnSunPath(Radians(std::atan2(d.x, d.y)), Radians(std::asin(d.z)));
    EXPECT_NEAR(Norm(place - centre), radius / std::cos(tilt), 1e-6);
  }
}

TEST(SunPath, DrawsTwelveDaysAndTheHoursOfTheClock) {
  const sky::Observer prague{.latitude = FromDegrees(50.0875), .longitude = FromDegrees(14.4213)};
  const exports::VectorDrawing drawing =
      DrawSunPath({prague, 2025, {60}, sky::SunModel::kPrecise, {}});
  const auto has = [&](const std::string& text) {
    return std::any_of(drawing.texts.begin(), drawing.texts.end(),
                       [&](const exports::DrawingText& t) { return t.text == text; });
  };
  for (const char* month :
       {"Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"}) {
    EXPECT_TRUE(has(std::string("21 ") + month)) << month;
  }
  // At midsummer the sun rises at 4:52 summer time = 3:52 of this clock and sets at 20:15.
  EXPECT_FALSE(has("3"));
  EXPECT_TRUE(has("5") && has("12") && has("20"));
  EXPECT_FALSE(has("21"));
  EXPECT_TRUE(drawing.discs.empty());
  // Everything lies inside the image, and the sun's paths inside its circle.
  for (const exports::DrawingLine& line : drawing.lines) {
    for (const Vec2 p : line.points) EXPECT_LT(Norm(p - Vec2{500.0, 550.0}), 410.0);
  }
}

TEST(SunPath, HasNoWinterDaysInThePolarNight) {
  const sky::Observer tromso{.latitude = FromDegrees(69.65), .longitude = FromDegrees(18.96)};
  const exports::VectorDrawing drawing =
      DrawSunPath({tromso, 2025, {60}, sky::SunModel::kPrecise, {}});
  const auto count = [&](const std::string& text) {
    return std::count_if(drawing.texts.begin(), drawing.texts.end(),
                         [&](const exports::DrawingText& t) { return t.text == text; });
  };
  EXPECT_EQ(count("21 Dec"), 0);
  EXPECT_EQ(count("21 Jun"), 1);
  EXPECT_EQ(count("0"), 1);  // Midnight sun.
}

}  // namespace
}  // namespace pleinair::app
