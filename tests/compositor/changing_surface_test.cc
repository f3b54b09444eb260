// Objects that change their shape: their light, shadows and contact, against still ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/compare/ciede2000.h"
#include "compositor/light/changing/contact_light.h"
#include "compositor/light/changing/sky_harmonics.h"
#include "compositor/light/changing/surroundings.h"
#include "compositor/light/light_solver.h"
#include "compositor/models/animation/model_animation.h"
#include "tests/compositor/composer_scene.h"
#include "tests/compositor/courtyard_frame.h"

namespace pleinair::compositor {
namespace {

double DifferenceAt(const RgbImage& a, const RgbImage& b, int x, int y) {
  const auto lab = [&](const RgbImage& image) {
    return app::LabFromSrgb8({image(x, y, 0), image(x, y, 1), image(x, y, 2)});
  };
  return app::Ciede2000(lab(a), lab(b));
}

bool SameBytes(const RgbImage& a, const RgbImage& b) {
  return std::equal(a.data(), a.data() + a.size(), b.data(), b.data() + b.size());
}

TEST(ChangingSurface, IsLitAsATracedOneInTheCourtyard) {
  // With few rays, the noise of the traced light alone is 0.24.
  const testing::Courtyard courtyard(LightSolverOptions{}.rays_per_vertex);
  const RgbImage picture = courtyard.Picture(), mask = courtyard.ObjectMask();
  const auto compose = [&](Composer& composer) {
    return composer
        .Compose(picture.view(), courtyard.poses()[testing::Courtyard::kKeyFrame],
                 courtyard.ExposureScale())
        .value();
  };
  const RgbImage still = compose(*courtyard.MakeComposer({}));
  const auto changing = courtyard.MakeChangingComposer({});
  RgbImage composed = compose(*changing);
  for (const char* moment : {"first", "tenth", "rested"}) {
    double body = 0.0, shadow = 0.0;
    int body_pixels = 0, shadow_pixels = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const double difference = DifferenceAt(still, composed, x, y);
        if (mask(x, y, 0) > 127) {
          body += difference;
          ++body_pixels;
        } else if (still(x, y, 1) + 4 < picture(x, y, 1)) {
          shadow += difference;
          ++shadow_pixels;
        }
      }
    }
    ASSERT_GT(body_pixels, 1000);
    ASSERT_GT(shadow_pixels, 1000);
    const std::string frame = moment;
    RecordProperty("body_" + frame, std::to_string(body / body_pixels));
    RecordProperty("shadow_" + frame, std::to_string(shadow / shadow_pixels));
    const bool rested = frame == "rested";
    EXPECT_LE(body / body_pixels, rested ? 0.32 : 3.0) << frame;
    EXPECT_LE(shadow / shadow_pixels, rested ? 1.2 : 3.0) << frame;
    const int skipped = frame == "first" ? 8 : 90;
    for (int i = 0; i < skipped; ++i) {
      ASSERT_TRUE(changing->SkipImage(courtyard.poses()[testing::Courtyard::kKeyFrame]));
    }
    composed = compose(*changing);
  }
}

/// The cube on the ground, which may move.
class MovingCube {
 public:
  MovingCube() {
    cube_.playback.animation = std::make_shared<testing::Unmoved>(cube_.model);
    composer_ = ComposerInTheSun({kGround, cube_});
  }

  /// Puts it below the same sky, with a sun of this illuminance.
  void SetSun(double sun_lux) {
    const SouthernSun day(sun_lux);
    const auto solver = LightSolver::Create({kGround, cube_}, {.rays_per_vertex = 64}).value();
    ASSERT_TRUE(composer_->SetLight(solver->Solve(day, Mat3{}), day, Mat3{}, {1, 1, 1}));
  }

  /// Composes an image of the cube and of a second one beside it, which is of the same body.
  RgbImage Twice(double right_m) {
    std::vector<MeshShape> shape = cube_.playback.animation->At(0.0);
    shape[0].indices = cube_.model->meshes[0].indices;
    const MeshShape first = shape[0];
    const auto count = static_cast<std::uint32_t>(first.positions.size());
    for (auto position : first.positions) {
      position[0] += static_cast<float>(right_m);
      shape[0].positions.push_back(position);
    }
    shape[0].normals.insert(shape[0].normals.end(), first.normals.begin(), first.normals.end());
    for (const std::uint32_t index : first.indices) shape[0].indices.push_back(count + index);
    return Composed(shape);
  }
  /// Composes an image of one cube, whatever its triangles were.
  RgbImage Once() {
    std::vector<MeshShape> shape = cube_.playback.animation->At(0.0);
    shape[0].indices = cube_.model->meshes[0].indices;
    return Composed(shape);
  }
  /// Composes an image with the cube moved to the right.
  RgbImage At(double right_m) {
    std::vector<MeshShape> shape = cube_.playback.animation->At(0.0);
    for (auto& position : shape[0].positions) position[0] += static_cast<float>(right_m);
    return Composed(shape);
  }

 private:
  RgbImage Composed(const std::vector<MeshShape>& shape) {
    composer_->SetShape(1, shape);
    return composer_->Compose(EvenPicture(150).view(), kFromAbove, exposure_).value();
  }

  PlacedModel cube_ = kCube;
  LinearRgb exposure_{kExposureScale, kExposureScale, kExposureScale};
  std::unique_ptr<Composer> composer_;
};

TEST(ChangingSurface, TakesItsShadowAlong) {
  MovingCube cube;
  const double ground = SeenAt(EvenPicture(150), {});
  const Vec3 on_top{0, 0, 0.3}, in_shadow{0, 0.3, 0}, moved{0.7, 0, 0};
  const RgbImage before = cube.At(0.0);
  EXPECT_NEAR(SeenAt(before, on_top), Level(0.5), 0.02);
  EXPECT_LT(SeenAt(before, in_shadow), 0.4 * ground);
  EXPECT_NEAR(SeenAt(before, in_shadow + moved), ground, 0.01);
  RgbImage after = cube.At(0.7);
  EXPECT_NEAR(SeenAt(after, on_top + moved), Level(0.5), 0.02);
  EXPECT_LT(SeenAt(after, in_shadow + moved), 0.4 * ground);
  // Where it was, the ground is lit again; what it took of the sky comes back within some frames.
  for (int i = 0; i < 40; ++i) after = cube.At(0.7);
  EXPECT_NEAR(SeenAt(after, in_shadow), ground, 0.01);
  EXPECT_NEAR(SeenAt(after, {}), ground, 0.01);
}

TEST(ChangingSurface, TakesOtherTriangles) {
  MovingCube cube;
  cube.At(0.0);
  const Vec3 on_top{0, 0, 0.3}, in_shadow{0, 0.3, 0}, second{0.7, 0, 0};
  const RgbImage two = cube.Twice(second.x);
  const double ground = SeenAt(EvenPicture(150), {});
  EXPECT_NEAR(SeenAt(two, on_top), Level(0.5), 0.02);
  EXPECT_NEAR(SeenAt(two, on_top + second), Level(0.5), 0.02);
  EXPECT_LT(SeenAt(two, in_shadow), 0.4 * ground);
  EXPECT_LT(SeenAt(two, in_shadow + second), 0.4 * ground);
  // Again the triangles of one cube.
  EXPECT_NEAR(SeenAt(cube.Once(), in_shadow + second), ground, 0.05);
}

TEST(ChangingSurface, LetsLightThroughLeaves) {
  // A level leaf shows what the ground below it reflects.
  Model leaf = MakeBox({-0.5, -0.5, 0.4}, {0.5, 0.5, 0.4}, 0.0F);
  leaf.materials[0].detail.transmission.color.fill(0.5F);
  const PlacedModel still = Place(leaf, false);
  PlacedModel moving = still;
  moving.playback.animation = std::make_shared<testing::Unmoved>(moving.model);
  const Vec3 middle{0.0, 0.0, 0.4};
  const double expected = SeenAt(Compose({kGround, still}, EvenPicture(0)), middle);
  EXPECT_GT(expected, 0.01);
  // One pixel value is 2.5 %. The first image has few rays.
  const auto composer = ComposerInTheSun({kGround, moving});
  const auto seen = [&] {
    return SeenAt(*composer->Compose(EvenPicture(0).view(), kFromAbove,
                                     {kExposureScale, kExposureScale, kExposureScale}),
                  middle);
  };
  EXPECT_NEAR(seen(), expected, 0.15 * expected);
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(composer->SkipImage(kFromAbove));
  EXPECT_NEAR(seen(), expected, 0.1 * expected);
}

TEST(ChangingSurface, ForgetsASunThatIsGone) {
  const Vec3 before_the_sunny_side{0, -0.2, 0};
  MovingCube at_rest, fresh;
  for (int i = 0; i < 10; ++i) at_rest.At(0.0);
  at_rest.SetSun(0.0);
  fresh.SetSun(0.0);
  const double expected = SeenAt(fresh.At(0.0), before_the_sunny_side);
  EXPECT_NEAR(SeenAt(at_rest.At(0.0), before_the_sunny_side), expected, 0.03 * expected);
}

TEST(ContactLight, FadesTheMissingSunlightWhenABodyMoves) {
  // A cube shades the ground before a wall, which then has less light.
  const PlacedModel ground = Place(MakeBox({-2, -2, 0}, {2, 2, 0}, 0.6F), true);
  const PlacedModel wall = Place(MakeBox({-1, 0.5, 0.01}, {1, 0.55, 0.5}, 0.6F), true);
  const SouthernSun day;
  const auto still =
      LightSolver::Create({ground, wall}, {.rays_per_vertex = 64}).value()->Solve(day, Mat3{});
  const auto bodies =
      LightSolver::Create({kCube}, {.rays_per_vertex = 16}).value()->Solve(day, Mat3{});
  Surroundings surroundings;
  surroundings.SetDaylight(day, Mat3{});
  ASSERT_TRUE(surroundings.SetStill(PairedSides(still)));
  ASSERT_TRUE(surroundings.SetBodies(PairedSides(bodies)));
  ContactLight contacts(still);
  // Mean light on the wall's side to the sun.
  const auto on_wall = [&] {
    std::vector<LitMesh> drawn = still;
    contacts.Light(drawn);
    double sum = 0.0;
    int count = 0;
    for (const LitMesh& mesh : drawn) {
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto& [x, y, z] = mesh.positions[v];
        if (mesh.normals[v][1] > -0.9F || std::fabs(x) > 0.2F || z > 0.3F) continue;
        sum += mesh.ambient_with[v][1];
        ++count;
      }
    }
    EXPECT_GT(count, 3);
    return sum / count;
  };
  contacts.FollowBodies(bodies, 0.0);
  contacts.Refresh(surroundings, contacts.size());
  const double begins = on_wall();
  for (int i = 0; i < 10; ++i) contacts.Refresh(surroundings, contacts.size());
  const double rested = on_wall(), missing = begins - rested;
  ASSERT_GT(missing, 0.02 * begins);
  contacts.FollowBodies(bodies, 2e-3);
  contacts.Refresh(surroundings, contacts.size());
  EXPECT_NEAR(on_wall(), rested, 0.3 * missing);
  for (int i = 0; i < 40; ++i) contacts.FadeOut();
  EXPECT_NEAR(on_wall(), begins, 0.3 * missing);
}

TEST(ChangingSurface, DependsOnTheSequenceOfShapesAlone) {
  MovingCube a, b;
  for (const double right_m : {0.0, 0.05, 0.1, 0.2, -0.1}) {
    EXPECT_TRUE(SameBytes(a.At(right_m), b.At(right_m))) << right_m;
  }
}

TEST(SkyHarmonics, ReproduceAUniformSkyThroughAnyCone) {
  const SouthernSun day;
  const SkyHarmonics harmonics(SkyTable(day, Mat3{}, 0.2));
  for (const double open : {0.0, 0.1, 0.5, 1.0}) {
    for (const Vec3 bent : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{0, -1, 0}}) {
      EXPECT_NEAR(harmonics.Irradiance(bent, open)[1], open * kSkyLux, 0.01 * kSkyLux) << open;
    }
  }
}

}  // namespace
}  // namespace pleinair::compositor
