// Compares composed objects with path-traced ones: shapes whose meshes are hard to light, in sun,
// shade and under an overcast sky.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/compositor/light/shapes.h"
#include "tests/compositor/light/terrace.h"

namespace pleinair::compositor {
namespace {

using testing::HardShapes;
using testing::Icosphere;
using testing::NamedModel;
using testing::ObjectScore;
using testing::ObjectView;
using testing::Shape;
using testing::Terrace;
using testing::Weather;

constexpr LightSolverOptions kOptions{.rays_per_vertex = 64};

/// The hard shapes, 12 cm large, in two rows.
std::vector<std::shared_ptr<const Model>> ShapesInRows() {
  std::vector<std::shared_ptr<const Model>> models;
  for (const NamedModel& shape : HardShapes()) {
    auto moved = std::make_shared<Model>(*shape.model);
    const auto i = static_cast<int>(models.size());
    const float x = 0.19F * static_cast<float>(i % 4) - 0.25F;
    const float y = 0.22F * static_cast<float>(i / 4) - 0.1F;
    for (Mesh& mesh : moved->meshes) {
      for (auto& p : mesh.positions) p = {0.6F * p[0] + x, 0.6F * p[1] + y, 0.6F * p[2]};
    }
    models.push_back(std::move(moved));
  }
  return models;
}

TEST(ObjectLight, OfHardShapesIsThatOfPaths) {
  const Terrace terrace(ShapesInRows(), kOptions);
  const CameraModel camera = Terrace::Camera(400, 1.0);
  const auto names = HardShapes();
  for (const auto& [weather, light] : {std::pair{Weather::kSun, "in the sun"},
                                       {Weather::kShade, "in the shade"},
                                       {Weather::kOvercast, "under clouds"}}) {
    const RgbImage composed = terrace.Compose(weather, camera);
    const ObjectView truth = terrace.Trace(weather, camera, 3, 6);
    double brightness = 0.0;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const ObjectScore score = ScoreOf(static_cast<int>(i), truth, composed);
      SCOPED_TRACE(names[i].name + " " + light);
      EXPECT_GT(score.pixels, 90);
      EXPECT_LE(score.far_off, 0.03);
      EXPECT_LE(score.mean, 2.0);
      EXPECT_LE(score.darkest_group, 30);
      EXPECT_NEAR(score.brightness, 1.0, 0.03);
      brightness += score.brightness / static_cast<double>(names.size());
    }
    EXPECT_NEAR(brightness, 1.0, 0.015) << light;
  }
}

TEST(SphereLight, IsThatOfAFinerSphere) {
  const auto sphere = [](int level) {
    const Shape shape = Icosphere(level).Placed({0.0, 0.0, 0.1}, 0.099);
    return ModelOf(std::array{shape}, NormalsMode::kSmooth);
  };
  const auto coarse = sphere(2), fine = sphere(4);  // 320 and 5,120 faces.
  const Terrace with_coarse({coarse}, kOptions), with_fine({fine}, kOptions);
  const CameraModel camera = Terrace::Camera(240, 1.5);
  const RgbImage of_coarse = with_coarse.Compose(Weather::kSun, camera);
  const RgbImage of_fine = with_fine.Compose(Weather::kSun, camera);
  const ObjectView view = with_coarse.Trace(Weather::kSun, camera, 1, 1);
  double sum = 0.0;
  int pixels = 0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (view.pixels[i].object < 0) continue;
    sum += testing::Cie76(view.At(of_coarse, i), view.At(of_fine, i));
    ++pixels;
  }
  ASSERT_GT(pixels, 2000);
  EXPECT_LE(sum / pixels, 1.0);
}

}  // namespace
}  // namespace pleinair::compositor
