
#include <gmock/gmock.h>

#include <cmath>

#include "app/window/cities.h"
#include "app/window/window_layout.h"
#include "app/window/window_state.h"
#include "scene/sun_over_place.h"

namespace pleinair::app {
namespace {

using testing::DoubleNear;

WindowState State() {
  scene::SceneDescription scene;
  scene.place_time.start = *UtcTime::Parse("2025-09-14T11:05:00Z");
  scene.place_time.latitude_deg = 50.0875;
  scene.place_time.longitude_deg = 14.4213;
  scene.marker.size_m = 0.5;
  scene.marker.heading = FromDegrees(342.0);
  scene::ModelReference object;
  object.translation_m = {0.2, 0.3, 0.0};
  object.rotation_deg = {10.0, 20.0, 30.0};
  object.scale = 0.5;
  scene.objects = {object};
  WindowState state = WindowState::For(scene, {});
  state.boxes = {{"box", {-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}}};
  // A camera 3 m above the marker looks straight down; its right is the marker's x.
  state.frame.camera.width = 640;
  state.frame.camera.height = 480;
  state.frame.camera.fx = state.frame.camera.fy = 600.0;
  state.frame.camera.cx = 319.5;
  state.frame.camera.cy = 239.5;
  state.frame.camera_from_marker = {{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 3}};
  return state;
}

void ExpectNear(Vec3 a, Vec3 b) { EXPECT_LT(Norm(a - b), 1e-9) << a.x << ' ' << a.y << ' ' << a.z; }

TEST(WindowState, KeysMoveTheChosenObjectAsTheViewerSeesItAndPutItBack) {
  WindowState state = State();
  ASSERT_EQ(state.selected, 0) << "the only object is chosen from the start";
  const session::ObjectPlace before = state.edit.objects[0];
  Do(Action::kMoveRight, false, {}, &state);
  const Vec3 step = state.edit.objects[0].translation_m - before.translation_m;
  EXPECT_GT(step.x, 0.01);
  ExpectNear(step, {step.x, 0.0, 0.0});
  Do(Action::kMoveAway, true, {}, &state);
  EXPECT_NEAR(state.edit.objects[0].translation_m.y - before.translation_m.y, step.x / 10, 1e-9);
  Do(Action::kRaise, false, {}, &state);
  EXPECT_GT(state.edit.objects[0].translation_m.z, 0.01);
  Do(Action::kResetObject, false, {}, &state);
  EXPECT_EQ(state.edit.objects[0], before);
  Do(Action::kDeselect, false, {}, &state);
  Do(Action::kMoveRight, false, {}, &state);
  EXPECT_EQ(state.edit.objects[0], before) << "nothing is chosen";
}

TEST(WindowState, AKeyShowsTheShadowMapsAndHidesThem) {
  WindowState state = State();
  Do(Action::kShadowMaps, false, {}, &state);
  EXPECT_TRUE(state.edit.drawing.show_shadow_maps);
  Do(Action::kShadowMaps, false, {}, &state);
  EXPECT_EQ(state.edit, state.unedited);
}

TEST(WindowState, TurningAndScalingKeepTheFootWhereItIs) {
  const WindowState state = State();
  const Vec3 up{0, 0, 1};
  const session::ObjectPlace& place = state.edit.objects[0];
  session::ObjectPlace turned = place;
  for (int i = 0; i < 36; ++i) turned = Turned(state.boxes[0], turned, 10.0, up);
  ExpectNear(turned.translation_m, place.translation_m);
  ExpectNear(turned.rotation_deg, place.rotation_deg);
  const session::ObjectPlace quarter = Turned(state.boxes[0], place, 90.0, up);
  const Vec3 was = session::LinearOf(place) * Vec3{1, 2, 3};
  ExpectNear(session::LinearOf(quarter) * Vec3{1, 2, 3}, {-was.y, was.x, was.z});
  const session::ObjectPlace scaled = Scaled(state.boxes[0], place, 3.0, up);
  EXPECT_NEAR(scaled.scale, 1.5, 1e-12);
  ExpectNear(BoxFoot(state.boxes[0], scaled, up), BoxFoot(state.boxes[0], place, up));
}

TEST(WindowState, TheMouseTakesHoldOfWhatItPointsAtAndTheGroundFollowsIt) {
  WindowState state = State();
  session::ObjectPlace& place = state.edit.objects[0];
  place = {{0.2, 0.3, 0.0}, {}, 0.1};
  const auto pixel = [&](Vec3 point) {
    return ProjectToPixel(state.frame.camera,
                          *state.frame.camera_from_marker * Point<Marker>{point});
  };
  const Sight at =
      SightThrough(state.frame.camera, *state.frame.camera_from_marker, pixel({0.2, 0.3, 0.1}));
  EXPECT_EQ(PickObject(state.boxes, state.edit.objects, at), 0);
  const Sight beside =
      SightThrough(state.frame.camera, *state.frame.camera_from_marker, pixel({0.5, 0.3, 0}));
  EXPECT_EQ(PickObject(state.boxes, state.edit.objects, beside), std::nullopt);
  const Vec3 hold{0.2, 0.3, 0.1};
  const Sight to =
      SightThrough(state.frame.camera, *state.frame.camera_from_marker, pixel({0.4, 0.0, 0.1}));
  ExpectNear(DraggedLevel(place, at, to, hold, {0, 0, 1}).translation_m, {0.4, 0.0, 0.0});
}

TEST(WindowState, TheScrubBarKeepsTheDayAndNowIsNow) {
  WindowState state = State();
  SetTimeOfDay(15.5 * 3600.0, 3600.0, &state);
  EXPECT_EQ(state.shown_time().ToString(), "2025-09-14T14:30:00Z");
  Do(Action::kLater, false, {}, &state);
  EXPECT_EQ(state.shown_time().ToString(), "2025-09-14T14:40:00Z");
  Do(Action::kNow, false, *UtcTime::Parse("2026-01-02T03:04:05Z"), &state);
  EXPECT_EQ(state.shown_time().ToString(), "2026-01-02T03:04:05Z");
  Do(Action::kAsRecorded, false, {}, &state);
  EXPECT_EQ(state.shown_time(), state.frame.moment);
}

TEST(WindowState, TheExposureLockHoldsTheCameraAndTheBrightnessOfObjects) {
  WindowState state = State();
  Do(Action::kLockExposure, false, {}, &state);
  EXPECT_TRUE(state.exposure_locked && state.edit.lock_exposure && state.requests.exposure_change);
  Do(Action::kLockExposure, false, {}, &state);
  EXPECT_FALSE(state.exposure_locked || state.edit.lock_exposure);
}

TEST(WindowLayout, GivesThePictureTheLargestPlaceThatThePanelLeaves) {
  const Vec2 pixels{640, 480};
  const WindowLayout wide = WindowLayout::For({1280, 800}, 15.0, true, pixels);
  EXPECT_EQ(wide.picture.x + wide.panel_size.x, 1280.0) << "beside";
  EXPECT_TRUE(wide.OnPanel({1279, 0}));
  EXPECT_FALSE(wide.OnPanel({900, 400}));
  const WindowLayout tall = WindowLayout::For({480, 800}, 15.0, true, pixels);
  EXPECT_EQ(tall.picture.x, 480.0) << "below";
  EXPECT_NEAR(tall.picture.y, 360.0, 1e-9);
  EXPECT_EQ(tall.panel_corner.y + tall.panel_size.y, 800.0);
  EXPECT_FALSE(tall.OnPanel({479, 300}));
  const WindowLayout small = WindowLayout::For({320, 240}, 15.0, true, pixels);
  EXPECT_EQ(small.picture.x, 320.0) << "over it";
  EXPECT_FALSE(small.OnPanel({50, 100})) << "some of the picture is seen";
  const WindowLayout alone = WindowLayout::For({320, 240}, 15.0, false, pixels);
  EXPECT_FALSE(alone.OnPanel({319, 100}));
  for (const Vec2 window : {Vec2{1, 1}, Vec2{4000, 60}, Vec2{60, 4000}}) {
    const WindowLayout layout = WindowLayout::For(window, 30.0, true, pixels);
    EXPECT_GT(layout.picture.x, 0.0);
    EXPECT_GT(layout.picture.y, 0.0);
  }
}

TEST(NorthPole, GivesTheHeadingAtWhichItsShadowFallsWhereItWasDragged) {
  for (const bool upright : {false, true}) {
    scene::MarkerDescription marker = State().scene.marker;
    marker.upright = upright;
    const Vec3 to_sun =
        scene::SunOver(State().scene.place_time, State().scene.place_time.start).ToSun().xyz;
    NorthPole pole;
    pole.foot = {0.1, 0.2, 0.3};
    pole.height_m = 2.0;
    const auto tip = pole.ShadowTip(marker, to_sun);
    ASSERT_TRUE(tip);
    EXPECT_NEAR(Dot(*tip - pole.foot, UpOf(marker)), 0.0, 1e-9) << "it lies on the ground";
    EXPECT_NEAR(Norm(*tip - pole.foot), 2.0 * std::sqrt(1 - to_sun.z * to_sun.z) / to_sun.z, 1e-9);
    scene::MarkerDescription other = marker;
    other.heading = FromDegrees(17.0);
    EXPECT_THAT(*HeadingForShadow(other, pole, *tip, to_sun), DoubleNear(342.0, 1e-9));
    EXPECT_EQ(HeadingForShadow(marker, pole, *tip, {0.0, 1.0, 0.0}), std::nullopt) << "at sunset";
  }
}

TEST(Cities, AreFoundByTheBeginningOfAnyWordWithoutAccents) {
  EXPECT_EQ(FindCities("").size(), Cities().size());
  ASSERT_EQ(FindCities("paulo").size(), 1U);
  EXPECT_EQ(FindCities("paulo")[0].name, "São Paulo");
  EXPECT_EQ(FindCities("REYKJAVIK")[0].name, "Reykjavík");
  EXPECT_NEAR(FindCities("prague")[0].latitude_deg, 50.0875, 0.01);
  EXPECT_TRUE(FindCities("xyz").empty());
  for (const City& city : Cities()) {
    EXPECT_LE(std::abs(city.latitude_deg), 90.0) << city.name;
    EXPECT_LE(std::abs(city.longitude_deg), 180.0) << city.name;
  }
}

}  // namespace
}  // namespace pleinair::app
