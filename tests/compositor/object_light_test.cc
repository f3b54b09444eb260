// Compares composed objects with path-traced ones: shapes whose meshes are hard to light, in sun,
// shade and under an overcast sky.
#include <gtest/gtest.h>

#include <algorithm>
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
using testing::NamedModel;
using testing::ObjectScore;
using testing::ObjectView;
using testing::Shape;
using testing::Terrace;
using testing::Torus;
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

TEST(RingLight, IsThatOfAFinerRing) {
  const auto ring = [](double faces) {
    const Shape shape = Torus(faces).Placed({0.0, 0.0, 0.036}, 0.076);
    return ModelOf(std::array{shape}, NormalsMode::kSmooth);
  };
  const Terrace with_coarse({ring(500)}, kOptions), with_fine({ring(5'000)}, kOptions);
  const CameraModel camera = Terrace::Camera(240, 1.5);
  for (const Weather weather : {Weather::kSun, Weather::kOvercast}) {
    const ObjectView view = with_coarse.Trace(weather, camera, 1, 1);
    ASSERT_GT(std::ranges::count_if(view.pixels, [](const auto& p) { return p.object == 0; }),
              2000);
    EXPECT_LE(MeanDifference(view, with_coarse.Compose(weather, camera),
                             with_fine.Compose(weather, camera)),
              1.0);
  }
}

}  // namespace
}  // namespace pleinair::compositor
