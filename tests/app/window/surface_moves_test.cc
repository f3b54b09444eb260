// Ground, boxes and walls dragged by the mouse.

#include "app/window/surface_moves.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/window/window_state.h"
#include "scene/scene_facts.h"

namespace pleinair::app {
namespace {

constexpr const char* kLying = R"(time = 2025-09-14T13:05:00+02:00
place = {latitude_deg = 50, longitude_deg = 14}
marker = {size_mm = 480, heading_deg = 0}
ground = {size_m = 20}
[[box]]
from_m = [0, 0, 0]
to_m = [1, 1, 0.5]
[[wall]]
corners_m = [[-1, 3, 0], [2, 3, 0], [2, 3, 2], [-1, 3, 2]]
)";
constexpr int kBox = 0, kWall = 1, kGround = 2;

scene::SceneDescription SceneOf(const std::string& text) {
  const auto facts = scene::ParseSceneToml(text, "scene.toml");
  EXPECT_TRUE(facts) << facts.error().Message();
  return scene::CompleteScene(*facts, "scene.toml").value();
}

void ExpectPoint(Vec3 a, Vec3 b) {
  EXPECT_LT(Norm(a - b), 1e-9) << a.x << ' ' << a.y << ' ' << a.z;
}

/// Somebody looks at a scene and drags from one point to another.
class SurfaceMoves : public testing::Test {
 protected:
  static constexpr Vec3 kEye{-1.0, -5.0, 2.0};
  static constexpr double kRadius = 0.01;

  static Sight At(Vec3 point) { return {kEye, Normalized(point - kEye)}; }
  std::optional<SurfaceGrip> Pick(Vec3 point) const {
    return PickSurface(scene_, At(point), kRadius);
  }
  std::optional<session::SurfacePlace> Drag(Vec3 from, Vec3 to, bool upright = false) const {
    const auto grip = Pick(from);
    EXPECT_TRUE(grip);
    if (!grip) return std::nullopt;
    return DraggedSurface(scene_, edit_.phantoms.at(static_cast<std::size_t>(grip->phantom)), *grip,
                          At(from), At(to), upright);
  }

  scene::SceneDescription scene_ = SceneOf(kLying);
  session::SceneEdit edit_ = session::UneditedScene(scene_, {});
};

TEST_F(SurfaceMoves, TheMouseTakesTheSurfaceInFront) {
  EXPECT_EQ(Pick({0.5, 0.0, 0.3})->phantom, kBox);
  EXPECT_EQ(Pick({1.5, 3.0, 1.0})->phantom, kWall);
  EXPECT_FALSE(Pick({1.5, 3.0, 1.0})->corner);
  EXPECT_EQ(Pick({-2.0, 1.0, -0.001})->phantom, kGround);
  ExpectPoint(Pick({-2.0, 1.0, -0.001})->hold, {-2.0, 1.0, -0.001});
  EXPECT_EQ(Pick({2.01, 3.0, 2.01})->corner, 2) << "near the corner, beside the wall";
  EXPECT_FALSE(Pick({0.0, 5.0, 50.0})) << "the sky";
}

TEST_F(SurfaceMoves, ABoxFollowsTheMouseOverTheGround) {
  const auto moved = Drag({0.5, 0.0, 0.3}, {1.2, 1.5, 0.3});
  ASSERT_TRUE(moved);
  ExpectPoint(moved->translation_m, {0.7, 1.5, 0.0});
  const auto raised = Drag({0.5, 0.0, 0.3}, {0.5, 0.0, 0.6}, true);
  ASSERT_TRUE(raised);
  ExpectPoint(raised->translation_m, {0.0, 0.0, 0.3});
  edit_.phantoms[kBox] = *moved;
  EXPECT_EQ(session::WithEdit(scene_, edit_).phantoms[kBox].translation_m, moved->translation_m);
}

TEST_F(SurfaceMoves, AWallMovesAlongItsNormal) {
  const auto moved = Drag({1.5, 3.0, 1.0}, {1.5, 3.5, 1.0});
  ASSERT_TRUE(moved);
  ASSERT_EQ(moved->corners_m.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    ExpectPoint(moved->corners_m[i], edit_.phantoms[kWall].corners_m[i] + Vec3{0.0, 0.5, 0.0});
  }
  edit_.phantoms[kWall] = *moved;
  ExpectPoint(PlacedPolygons(session::WithEdit(scene_, edit_).phantoms[kWall])[0][0],
              {-1.0, 3.5, 0.0});
}

TEST_F(SurfaceMoves, ACornerOfATurnedWallMovesInItsPlaneAndMakesNoDent) {
  scene_ = SceneOf(std::string(kLying) + "rotation_deg = [0, 0, 90]\ntranslation_m = [4, 2, 0]\n");
  edit_ = session::UneditedScene(scene_, {});
  const Vec3 corner = PlacedPolygons(scene_.phantoms[kWall])[0][2];
  ExpectPoint(corner, {1.0, 4.0, 2.0});
  const auto moved = Drag(corner, corner + Vec3{0.0, 0.25, 0.5});
  ASSERT_TRUE(moved);
  edit_.phantoms[kWall] = *moved;
  const auto corners = PlacedPolygons(session::WithEdit(scene_, edit_).phantoms[kWall])[0];
  ExpectPoint(corners[2], corner + Vec3{0.0, 0.25, 0.5});
  ExpectPoint(corners[1], PlacedPolygons(scene_.phantoms[kWall])[0][1]);
  EXPECT_FALSE(Drag(corner, corner + Vec3{0.0, -2.5, -1.5})) << "a dent";
}

TEST_F(SurfaceMoves, GroundBelowAnUprightMarkerMovesUpAndDown) {
  scene_ = SceneOf(R"(time = 2025-09-14T13:05:00+02:00
place = {latitude_deg = 50, longitude_deg = 14}
marker = {size_mm = 480, heading_deg = 0, upright = true}
ground = {height_m = 1.5}
)");
  edit_ = session::UneditedScene(scene_, {});
  // The marker's y is up, and its z points to the viewer.
  const Vec3 eye{0.0, 0.5, 5.0};
  const auto at = [&](Vec3 point) { return Sight{eye, Normalized(point - eye)}; };
  const auto grip = PickSurface(scene_, at({0.0, -1.5, 1.0}), kRadius);
  ASSERT_TRUE(grip);
  const auto lower = DraggedSurface(scene_, edit_.phantoms[0], *grip, at({0.0, -1.5, 1.0}),
                                    at({0.0, -1.7, 1.0}), false);
  ASSERT_TRUE(lower);
  ExpectPoint(lower->translation_m, {0.0, -0.2, 0.0});
  edit_.phantoms[0] = *lower;
  const scene::SceneDescription edited = session::WithEdit(scene_, edit_);
  EXPECT_NEAR(GroundHeight(edited, edited.phantoms[0]), 1.7, 1e-9);
  EXPECT_FALSE(DraggedSurface(scene_, edit_.phantoms[0], *grip, at({0.0, -1.5, 1.0}),
                              at({0.0, 0.6, 1.0}), false))
      << "above the marker";
}

TEST_F(SurfaceMoves, AKeyBeginsThemAndHomePutsThemBack) {
  WindowState state = WindowState::For(scene_, {});
  Do(Action::kSurfaces, false, {}, &state);
  ASSERT_TRUE(state.overlays.moving_surfaces);
  state.selected_surface = kBox;
  state.edit.phantoms[kBox].translation_m.x = 3.0;
  Do(Action::kResetObject, false, {}, &state);
  EXPECT_EQ(state.edit, state.unedited);
  Do(Action::kDeselect, false, {}, &state);
  EXPECT_FALSE(state.overlays.moving_surfaces);
}

}  // namespace
}  // namespace pleinair::app
