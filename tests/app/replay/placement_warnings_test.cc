#include "app/replay/placement_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "session/scene_edit.h"

namespace pleinair::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Level ground of any size, this high.
class Ground : public compositor::PhantomRays {
 public:
  explicit Ground(double height_m) : height_m_(height_m) {}
  double SunVisibility(Point<Marker>, Vec3) const override { return 1.0; }
  bool IsUnoccluded(Point<Marker>, Vec3) const override { return true; }
  std::optional<compositor::PhantomSurface> First(Point<Marker> eye,
                                                  Vec3 direction) const override {
    const double along = (height_m_ - eye.xyz.z) / direction.z;
    if (!(along > 0.0)) return std::nullopt;
    compositor::PhantomSurface surface;
    surface.point = {eye.xyz + direction * along};
    return surface;
  }
  std::vector<LinearRgb> Ambient(std::span<const compositor::FacingPoint>, const sky::SkyModel&,
                                 const Mat3&, std::uint32_t) const override {
    return {};
  }

 private:
  double height_m_;
};

/// A box 1 m wide and high, in front of a camera that looks down on the marker from 4 m.
struct Placing {
  scene::ModelReference reference;
  compositor::Model model;
  double ground_m = 0.0;
  bool upright = false;

  Placing() {
    reference.file = "box.obj";
    compositor::Mesh& mesh = model.meshes.emplace_back();
    mesh.positions = {
        {-0.5F, -0.5F, 0.0F}, {0.5F, -0.5F, 0.0F}, {0.5F, 0.5F, 0.2F}, {-0.5F, 0.5F, 1.0F}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
  }

  std::vector<std::string> Warnings() const {
    compositor::PlacedModel placed;
    placed.model = std::make_shared<const compositor::Model>(model);
    session::MoveTo({reference.translation_m, reference.rotation_deg, reference.scale}, &placed);
    scene::SceneDescription scene;
    scene.marker.upright = upright;
    scene.objects = {reference};
    const CameraModel camera{640, 480, 600.0, 600.0, 319.5, 239.5};
    session::Observation view;
    view.camera_from_marker = {{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 4}};
    const Ground ground(ground_m);
    return PlacementWarnings({placed}, scene, {camera, {view, view}}, &ground);
  }
};

TEST(PlacementWarnings, AreSilentAboutWhatIsInView) {
  EXPECT_THAT(Placing().Warnings(), IsEmpty());
  Placing huge_by_intent;
  huge_by_intent.reference.scale = 1000.0;
  huge_by_intent.reference.unit_m = 1.0;
  EXPECT_THAT(huge_by_intent.Warnings(), IsEmpty());
}

TEST(PlacementWarnings, ReportAnObjectInMillimetres) {
  Placing placing;
  placing.reference.scale = 1000.0;
  EXPECT_THAT(placing.Warnings(),
              ElementsAre("box.obj is 1.732 km large, and the camera 4 m from the marker: if its "
                          "file is in millimetres, add unit = \"mm\" to its [[object]]; unit = "
                          "\"m\" if it is meant so."));
  placing.reference.scale = 1e-3;
  EXPECT_THAT(placing.Warnings(), ElementsAre(HasSubstr("is only 1.732 mm large")));
}

TEST(PlacementWarnings, ReportAnObjectAroundTheCamera) {
  Placing around;
  around.reference.scale = 6.0;  // The camera is 4 m above the marker.
  around.ground_m = -1.0;
  EXPECT_THAT(around.Warnings(),
              ElementsAre("box.obj is 10.39 m large and surrounds the camera, which is 4 m from "
                          "the marker: state its unit, reduce it by scale or move it by "
                          "translation_m; add unit = \"m\" to its [[object]] if it is meant so."));
  around.reference.scale = 3.0;  // Below the camera.
  EXPECT_THAT(around.Warnings(), IsEmpty());
  around.reference.scale = 6.0;
  around.reference.unit_m = 1.0;  // A pavilion that the camera walks through.
  EXPECT_THAT(around.Warnings(), IsEmpty());
}

TEST(PlacementWarnings, ReportSurveyCoordinatesUntilTheyAreOffset) {
  Placing placing;
  placing.model.origin_m = {458000.0, 5548000.0, 220.0};
  EXPECT_THAT(placing.Warnings(), ElementsAre(HasSubstr("add origin = \"bottom centre\"")));
  placing.reference.translation_m = -placing.model.origin_m;
  EXPECT_THAT(placing.Warnings(), IsEmpty());
}

TEST(PlacementWarnings, ReportWhatNoFrameShows) {
  Placing aside;
  aside.reference.translation_m = {30, 0, 0};
  EXPECT_THAT(aside.Warnings(), ElementsAre(HasSubstr("is in view in no frame")));
  EXPECT_THAT(aside.Warnings(), ElementsAre(HasSubstr("[30.00, 0.00, 0.50], 30 m from")));
  Placing behind;
  behind.reference.translation_m = {0, 0, 9};
  EXPECT_THAT(behind.Warnings(), ElementsAre(HasSubstr("is in view in no frame")));
}

TEST(PlacementWarnings, ReportWhatPhantomsHide) {
  Placing buried;
  buried.ground_m = 1.5;
  EXPECT_THAT(buried.Warnings(), ElementsAre(HasSubstr("is hidden by phantoms in every frame")));
  buried.ground_m = 0.9;  // One corner is above.
  EXPECT_THAT(buried.Warnings(), IsEmpty());
}

TEST(PlacementWarnings, ReportAModelThatLiesOnItsBack) {
  Placing lying;
  for (auto& p : lying.model.meshes[0].positions) p = {p[0], p[2], -p[1]};
  lying.ground_m = -2.0;
  EXPECT_THAT(lying.Warnings(), ElementsAre(HasSubstr("add up = \"y\" to its [[object]]")));
  lying.reference.up = UpAxis::kZ;
  EXPECT_THAT(lying.Warnings(), IsEmpty());
  lying.reference.up.reset();
  lying.upright = true;  // y is up there.
  EXPECT_THAT(lying.Warnings(), IsEmpty());
}

}  // namespace
}  // namespace pleinair::app
