#include "session/scene_saving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "scene/scene_facts.h"

namespace pleinair::session {
namespace {

constexpr const char* kYard = R"(# Our yard
time = 2025-09-14T13:05:00+02:00
cloudiness = "clear"   # not a cloud

[place]
latitude_deg = 50
longitude_deg = 14

[marker]
size_mm = 480
heading_magnetic_deg = 5.0  # compass

[[object]]
file = "chair.glb"  # bought in spring

[[object]]
file = "lamp.glb"
translation_m = [0.123456, 2, 0]  # measured
scale = 0.5
)";

scene::SceneDescription SceneOf(const std::string& text) {
  const auto facts = scene::ParseSceneToml(text, "scene.toml");
  EXPECT_TRUE(facts) << facts.error().Message();
  const auto scene = scene::CompleteScene(*facts, "scene.toml");
  EXPECT_TRUE(scene) << scene.error().Message();
  return scene.value_or(scene::SceneDescription());
}

class SceneSaving : public testing::Test {
 protected:
  std::string Save(const SceneEdit& edit) const {
    const auto text = WithSavedEdit(kYard, scene_, before_, edit);
    return text ? *text : "error: " + text.error().Message();
  }
  /// The text with one piece in place of another.
  static std::string With(std::string text, const std::string& was, const std::string& is) {
    const std::size_t at = text.find(was);
    EXPECT_NE(at, std::string::npos) << was;
    return text.replace(at, was.size(), is);
  }

  scene::SceneDescription scene_ = SceneOf(kYard);
  SceneEdit before_ = UneditedScene(scene_, {});
};

TEST_F(SceneSaving, WritesNothingWithoutAChange) {
  SceneEdit edit = before_;
  edit.later_s = 3600.0;  // The hour is no part of the scene.
  edit.drawing.show_shadow_maps = true;
  EXPECT_EQ(Save(edit), kYard);
}

TEST_F(SceneSaving, WritesMovedObjectsAndKeepsCommentsAndOtherNumbers) {
  SceneEdit edit = before_;
  edit.objects[0].translation_m = {1.0 / 3.0, -1e-9, 0.1 + 0.2};
  edit.objects[1].translation_m.y = 2.5;
  edit.objects[1].scale = 0.55;
  std::string expected =
      With(kYard, "bought in spring\n", "bought in spring\ntranslation_m = [0.3333, 0.0, 0.3]\n");
  expected = With(expected, "[0.123456, 2, 0]  #", "[0.123456, 2.5, 0]  #");
  expected = With(expected, "scale = 0.5", "scale = 0.55");
  EXPECT_EQ(Save(edit), expected);
}

TEST_F(SceneSaving, WritesTheHeadingInPlaceOfTheCompasses) {
  SceneEdit edit = before_;
  edit.heading_deg = -17.5;
  EXPECT_EQ(Save(edit), With(kYard, "heading_magnetic_deg = 5.0", "heading_deg = 342.5"));
}

TEST_F(SceneSaving, WritesPlaceAndAir) {
  SceneEdit edit = before_;
  edit.latitude_deg = 48.5;
  edit.sky = {3.25, 0.55};
  std::string expected = With(kYard, "latitude_deg = 50", "latitude_deg = 48.5");
  expected = With(expected, "\"clear\"   # not a cloud\n",
                  "\"partly cloudy\"   # not a cloud\nturbidity = 3.25\n");
  EXPECT_EQ(Save(edit), expected);
}

TEST_F(SceneSaving, WritesMovedBoxesWallsAndGround) {
  const std::string text = std::string(kYard) + R"(
[[wall]]
corners_m = [[2, 0, 0], [2, 3, 0],  # the barn
             [2, 3, 2.5], [2, 0, 2.5]]
[[box]]
from_m = [0, 0, 0]
to_m = [1, 1, 1]
[[box]]
from_m = [3, 0, 0]
to_m = [4, 1, 1]
[ground]
size_m = 8
)";
  const scene::SceneDescription scene = SceneOf(text);
  const SceneEdit before = UneditedScene(scene, {});
  ASSERT_EQ(before.phantoms.size(), 4U) << "boxes, walls, ground";
  SceneEdit edit = before;
  edit.phantoms[1].translation_m = {0.25, 0.5, 0.0};
  edit.phantoms[2].corners_m[2] = {2.0, 3.25, 2.75};
  edit.phantoms[3].translation_m = {0.0, 0.0, -0.3};
  const auto saved = WithSavedEdit(text, scene, before, edit);
  ASSERT_TRUE(saved) << saved.error().Message();
  std::string expected = With(text, "[2, 3, 2.5]", "[2, 3.25, 2.75]");
  expected =
      With(expected, "to_m = [4, 1, 1]\n", "to_m = [4, 1, 1]\ntranslation_m = [0.25, 0.5, 0.0]\n");
  EXPECT_EQ(*saved, With(expected, "size_m = 8\n", "size_m = 8\nheight_m = 0.301\n"));
  const SceneEdit read = UneditedScene(SceneOf(*saved), {});
  EXPECT_EQ(read.phantoms[1], edit.phantoms[1]);
  EXPECT_EQ(read.phantoms[2], edit.phantoms[2]);
}

TEST_F(SceneSaving, ReadsBackAsTheEditedScene) {
  SceneEdit edit = before_;
  for (ObjectPlace& place : edit.objects) {
    place.translation_m = place.translation_m + Vec3{0.71238, -3.9, 123456.78914};
    place.rotation_deg = {12.3456, -90.0, 359.9};
    place.scale *= 1234.567;
  }
  edit.longitude_deg = -122.4194155;
  const SceneEdit read = UneditedScene(SceneOf(Save(edit)), {});
  EXPECT_EQ(read.longitude_deg, edit.longitude_deg);
  for (std::size_t i = 0; i < edit.objects.size(); ++i) {
    EXPECT_LT(Norm(read.objects[i].translation_m - edit.objects[i].translation_m), 1e-4);
    EXPECT_LT(Norm(read.objects[i].rotation_deg - edit.objects[i].rotation_deg), 1e-3);
    EXPECT_NEAR(read.objects[i].scale / edit.objects[i].scale, 1.0, 5e-6);
  }
}

TEST_F(SceneSaving, GoesOnFromWhatWasSaved) {
  SceneEdit edit = before_;
  edit.objects[1].translation_m.x = 9.0;
  const std::string saved = Save(edit);
  // Back at its first place: the value in the file changes back, too.
  const auto again = WithSavedEdit(saved, scene_, edit, before_);
  ASSERT_TRUE(again) << again.error().Message();
  EXPECT_EQ(*again, With(kYard, "0.123456", "0.1235"));
}

TEST_F(SceneSaving, RefusesWhatASceneCannotHold) {
  SceneEdit edit = before_;
  edit.objects[1].translation_m.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Save(edit).substr(0, 26), "error: scene.toml: cannot ");
  edit = before_;
  edit.latitude_deg = 91.0;
  EXPECT_EQ(Save(edit).substr(0, 26), "error: scene.toml: cannot ");
  edit = before_;
  edit.objects[0].scale = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Save(edit).substr(0, 26), "error: scene.toml: cannot ");
}

TEST_F(SceneSaving, RefusesATextOfAnotherScene) {
  SceneEdit edit = before_;
  edit.objects[0].scale = 2.0;
  const std::string one_object = std::string(kYard).substr(0, std::string(kYard).rfind("[["));
  EXPECT_FALSE(WithSavedEdit(one_object, scene_, before_, edit));
  EXPECT_FALSE(WithSavedEdit("not = toml = at all", scene_, before_, edit));
}

}  // namespace
}  // namespace pleinair::session
