// Focus and aperture from prints through a ray-traced thin lens.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "base/camera_response.h"
#include "compositor/picture/side_profile.h"
#include "session/scene_marker.h"
#include "tests/tracker/lens_rendering.h"

namespace pleinair::session {
namespace {

using compositor::FocusFit;

const CameraModel kCamera{
    .width = 320, .height = 240, .fx = 605, .fy = 605, .cx = 159.5, .cy = 119.5};

struct Filmed {
  MarkerName marker{"sg", 17};
  double size_m = 0.2;
  double aperture_m = 0.012, focus_m = 1.1;
  double own_blur_px = 0.3;
  double nearest_m = 0.6, farthest_m = 1.7;
  double tilt = 0.4;          ///< Radians.
  double moved_px = 0.0;      ///< During an exposure.
  double shutter = 0.5;       ///< Share of the interval between frames.
  bool knows_motion = false;  ///< Whether poses show the motion.
  int frames = 14;
  std::uint32_t seed = 1;
};

Transform<Camera, Marker> PoseAt(double distance_m, double tilt, double roll, Vec2 shift_m) {
  const Mat3 flip{{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  const Mat3 turned{
      {std::cos(roll), -std::sin(roll), 0, std::sin(roll), std::cos(roll), 0, 0, 0, 1}};
  const Mat3 tilted{
      {1, 0, 0, 0, std::cos(tilt), -std::sin(tilt), 0, std::sin(tilt), std::cos(tilt)}};
  return {turned * tilted * flip, {shift_m.x, shift_m.y, distance_m}};
}

/// The side profiles of a film of a print that comes nearer.
std::vector<compositor::SideProfile> Film(const Filmed& how) {
  scene::MarkerDescription described;
  described.size_m = how.size_m;
  const scene::MarkerReflectance reflectance = MarkerReflectanceOf(described, how.marker);
  std::mt19937 random(how.seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<compositor::SideProfile> film;
  for (int i = 0; i < how.frames; ++i) {
    const double share = (i + 0.5) / how.frames;
    const double distance = how.farthest_m + share * (how.nearest_m - how.farthest_m);
    const double tilt = how.tilt * (1.0 + 0.2 * uniform(random)),
                 roll = 0.1 + 0.3 * uniform(random);
    const Vec2 shift{0.01 * uniform(random), 0.01 * uniform(random)};
    // To the side: sides that stand across it blur.
    const double moved_m = how.moved_px * (0.6 + 0.4 * uniform(random)) * distance / kCamera.fx;
    const auto pose = [&](double exposures) {
      return PoseAt(distance, tilt, roll, {shift.x + moved_m * exposures, shift.y});
    };
    tracker::LensPicture picture;
    picture.pattern = PatternOf(how.marker);
    picture.size = Metres(how.size_m);
    picture.camera_from_marker = pose;
    picture.aperture_m = how.aperture_m;
    picture.focus_dioptres = 1.0 / how.focus_m;
    picture.own_blur_px = how.own_blur_px;
    picture.noise_codes = 1.0;
    picture.seed = how.seed * 100U + static_cast<std::uint32_t>(i);
    const GreyImage grey = RenderThroughLens(kCamera, picture);
    RgbImage rgb(grey.width(), grey.height(), 3);
    for (int y = 0; y < grey.height(); ++y) {
      for (int x = 0; x < grey.width(); ++x) {
        for (int c = 0; c < 3; ++c) rgb(x, y, c) = grey(x, y);
      }
    }
    const auto camera_from_marker = pose(0.0);
    const CameraResponse response;
    const compositor::MarkerInImage in_image(rgb.view(), kCamera, camera_from_marker, reflectance,
                                             response);
    std::optional<compositor::MarkerMotion> motion;
    const double interval_s = 1.0 / 30.0, exposures = 1.0 / how.shutter;
    if (how.knows_motion) motion = {pose(-exposures), pose(exposures), 2.0 * interval_s};
    for (compositor::SideProfile& profile : ReadSideProfiles(in_image, motion)) {
      profile.place.frame_index = i;
      profile.place.timestamp_s = i * interval_s;
      film.push_back(std::move(profile));
    }
  }
  return film;
}

FocusFit Measured(const Filmed& how) { return MeasureFocus(Film(how), kCamera.fx, {}, nullptr); }

TEST(LensMeasurement, ReadsFocusAndApertureOffThePrint) {
  for (const Filmed& how :
       {Filmed{}, Filmed{.marker = {"tag36h11", 3}, .own_blur_px = 0.6, .seed = 4},
        Filmed{.aperture_m = 0.02, .seed = 2}, Filmed{.focus_m = 8.0, .seed = 3}}) {
    const FocusFit fit = Measured(how);
    ASSERT_TRUE(fit.is_measured()) << fit.reason;
    EXPECT_NEAR(fit.aperture_m, how.aperture_m, 0.06 * how.aperture_m);
    EXPECT_NEAR(fit.focus_dioptres, 1.0 / how.focus_m, 0.03);
    EXPECT_LE(std::fabs(fit.aperture_m - how.aperture_m),
              3.0 * fit.aperture_relative_error * how.aperture_m);
    EXPECT_LE(std::fabs(fit.focus_dioptres - 1.0 / how.focus_m), 3.0 * fit.focus_dioptres_error);
    // The lens's own blur, and the pixel's box.
    EXPECT_NEAR(fit.in_focus_blur_px, std::hypot(how.own_blur_px, 1.0 / std::sqrt(12.0)), 0.03);
    EXPECT_EQ(fit.exposure_s, 0.0);
  }
}

TEST(LensMeasurement, DeclinesWhatTheFramesDoNotTell) {
  const FocusFit pinhole = Measured({.aperture_m = 0.0});
  EXPECT_EQ(pinhole.reason, "the marker's blur hardly depends on its distance");
  // However much a print is tilted, its sides at one distance are no evidence.
  const FocusFit still = Measured({.nearest_m = 0.8, .farthest_m = 0.81, .tilt = 0.9});
  EXPECT_EQ(still.reason, "the marker's distance hardly changes");
}

TEST(LensMeasurement, SeparatesMotionFromFocus) {
  const Filmed how{.moved_px = 3.0, .knows_motion = true};
  const FocusFit fit = Measured(how);
  ASSERT_TRUE(fit.is_measured()) << fit.reason;
  EXPECT_NEAR(fit.aperture_m, how.aperture_m, 0.06 * how.aperture_m);
  EXPECT_NEAR(fit.focus_dioptres, 1.0 / how.focus_m, 0.03);
  EXPECT_NEAR(fit.exposure_s, 0.5 / 30.0, 0.1 * 0.5 / 30.0);
  // Motion that the poses do not show: sides across it are left out.
  const FocusFit unseen = Measured({.moved_px = 3.0});
  EXPECT_LT(unseen.readings, 50U);
  ASSERT_TRUE(unseen.is_measured()) << unseen.reason;
  EXPECT_NEAR(unseen.aperture_m, how.aperture_m, 0.06 * how.aperture_m);
}

TEST(LensMeasurement, ReadsTheExposureAtOneDistance) {
  // A lens in focus, and one 3 pixels out of it.
  for (const double aperture_m : {0.0, 0.012}) {
    const Filmed how{.aperture_m = aperture_m,
                     .focus_m = aperture_m > 0.0 ? 1.35 : 1.0,
                     .nearest_m = 0.98,
                     .farthest_m = 1.02,
                     .moved_px = 5.0,
                     .knows_motion = true};
    const auto fit = compositor::MeasureExposure(Film(how), 0.0, 1.0 / 30.0);
    ASSERT_TRUE(fit.is_measured()) << fit.reason;
    EXPECT_NEAR(fit.exposure_s, 0.5 / 30.0, 0.06 * 0.5 / 30.0) << aperture_m;
    EXPECT_LT(fit.error_s, 0.1 * fit.exposure_s);
  }
  // Motion of which the exposure shows nothing.
  Filmed sharp{.aperture_m = 0.0, .nearest_m = 0.98, .farthest_m = 1.02};
  std::vector<compositor::SideProfile> film = Film(sharp);
  for (compositor::SideProfile& side : film) {
    side.place.squared_speed = side.place.side % 2 == 1 ? 1e5 : 1e3;
  }
  EXPECT_FALSE(compositor::MeasureExposure(film, 0.0, 1.0 / 30.0).is_measured());
}

}  // namespace
}  // namespace pleinair::session
