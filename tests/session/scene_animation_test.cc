// Objects that play an animation in the time of the scene.

#include "session/scene_animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/image.h"
#include "base/utc_time.h"
#include "scene/described_surface.h"
#include "session/baked_lighting.h"
#include "session/scene_edit.h"
#include "session/scene_renderer.h"
#include "tests/compositor/models/bending_tube.h"
#include "tests/temporary_folder.h"

namespace pleinair::session {
namespace {

const CameraModel kCamera{
    .width = 160, .height = 120, .fx = 150, .fy = 150, .cx = 79.5, .cy = 59.5};
// From the south, 90 cm away and 30 cm above the ground: x is to the right.
const Transform<Camera, Marker> kFromSouth{{{1, 0, 0, 0, 0, -1, 0, 1, 0}}, {0.0, 0.3, 0.9}};

/// A tube on level ground that bends to the right within two seconds.
class BendingScene {
 public:
  BendingScene() {
    const auto tube = compositor::testing::MakeBendingTube(16, 24);
    folder_.Write("tube.bin", tube.buffer);
    scene_.place_time = {50.0875, 14.4213, 200.0, UtcTime::Parse("2025-09-14T11:05:00Z").value()};
    scene_.marker.size_m = 0.2;
    scene_.marker.board_size_m = 0.25;
    scene_.camera.exposure_scale = LinearRgb{3e-5, 3e-5, 3e-5};
    scene_.phantoms.emplace_back().surface = scene::GroundSurface(3.0, 0.0, false);
    scene::ModelReference& object = scene_.objects.emplace_back();
    object.file = folder_.Write("tube.gltf", tube.gltf);
    object.animation = "Bend";
  }

  scene::ModelReference& object() { return scene_.objects[0]; }
  const scene::SceneDescription& scene() const { return scene_; }
  std::unique_ptr<SceneRenderer> Renderer() const {
    auto renderer = SceneRenderer::Create(kCamera, scene_, {});
    EXPECT_TRUE(renderer) << renderer.error().Message();
    return *std::move(renderer);
  }
  std::string Error() const {
    const auto renderer = SceneRenderer::Create(kCamera, scene_, {});
    return renderer ? "no error" : renderer.error().Message();
  }
  /// The image `scene_s` after the scene's beginning.
  RgbImage Image(SceneRenderer& renderer, double scene_s) const {
    RgbImage grey(kCamera.width, kCamera.height, 3);
    std::fill_n(grey.data(), grey.size(), std::uint8_t{150});
    return renderer.Render(grey.view(), kFromSouth, scene_.place_time.start.PlusSeconds(scene_s))
        .value();
  }

 private:
  tests::TemporaryFolder folder_;
  scene::SceneDescription scene_;
};

/// Whether the tube covers a point of the plane y = 0: it is redder than the ground.
bool Covers(const RgbImage& image, double x_m, double z_m) {
  const Vec2 at = ProjectToPixel(kCamera, kFromSouth * Point<Marker>{{x_m, 0.0, z_m}});
  const int x = static_cast<int>(at.x + 0.5), y = static_cast<int>(at.y + 0.5);
  return image(x, y, 0) > image(x, y, 2) + 20;
}

TEST(SceneAnimation, PlaysInTheTimeOfTheFrames) {
  BendingScene scene;
  const auto renderer = scene.Renderer();
  const RgbImage begin = scene.Image(*renderer, 0.0);
  EXPECT_TRUE(Covers(begin, 0.0, 0.55));
  EXPECT_FALSE(Covers(begin, 0.24, 0.42));
  for (const double scene_s : {2.0, 9.0}) {
    const RgbImage end = scene.Image(*renderer, scene_s);
    EXPECT_FALSE(Covers(end, 0.0, 0.55)) << scene_s;
    EXPECT_TRUE(Covers(end, 0.24, 0.42)) << scene_s;
    EXPECT_TRUE(Covers(end, 0.0, 0.1)) << scene_s;
  }
}

TEST(SceneAnimation, StartsAndRepeatsAsStated) {
  BendingScene scene;
  scene.object().animation = "0";
  scene.object().animation_start_s = 1.9;
  scene.object().loop = true;
  const auto renderer = scene.Renderer();
  EXPECT_TRUE(Covers(scene.Image(*renderer, 0.0), 0.24, 0.42));
  EXPECT_FALSE(Covers(scene.Image(*renderer, 0.2), 0.24, 0.42));
  EXPECT_TRUE(Covers(scene.Image(*renderer, 2.0), 0.24, 0.42));
}

TEST(SceneAnimation, StaysWhereItIsDraggedWhenTheLightIsMadeAnew) {
  BendingScene scene;
  const auto renderer = scene.Renderer();
  SceneEdit edit = UneditedScene(scene.scene(), {}, 0.0);
  const auto use_light = [&] {
    const auto light = std::make_shared<BakedLighting>(
        renderer->MakeLightingRequest(scene.scene().place_time.start));
    light->objects = edit.objects;
    ASSERT_TRUE(renderer->UseLight(light));
  };
  use_light();
  edit.objects[0].translation_m.x = 0.25;
  ASSERT_TRUE(renderer->Edit(edit));
  for (const char* light : {"as before", "made anew"}) {
    const RgbImage image = scene.Image(*renderer, 0.0);
    EXPECT_TRUE(Covers(image, 0.25, 0.55)) << light;
    EXPECT_FALSE(Covers(image, 0.0, 0.55)) << light;
    use_light();
  }
}

TEST(SceneAnimation, IsRefusedIfTheFileHasNoneOfThatName) {
  BendingScene scene;
  scene.object().animation = "Walk";
  EXPECT_THAT(scene.Error(), ::testing::HasSubstr("has no animation \"Walk\"; it has Bend"));
}

}  // namespace
}  // namespace pleinair::session
