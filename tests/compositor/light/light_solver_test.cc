#include "compositor/light/light_solver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "compositor/light/scaled_sky.h"
#include "sky/daylight.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::AddQuad;
using testing::BoxModel;
using testing::FoundVertex;
using testing::Ground;
using testing::MakeSolver;
using testing::ModelOf;
using testing::Nearest;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

constexpr double kPi = std::numbers::pi;
constexpr Vec3 kUp{0.0, 0.0, 1.0};

/// Brighter towards the zenith and, steeply, towards the sun, like a clear sky.
class ClearDay : public UniformDay {
 public:
  ClearDay() : UniformDay({1000.0, 2000.0, 4000.0}, {70e3, 65e3, 55e3}, {-0.1, -0.7, 0.7}) {}
  LinearRgb SkyRadiance(Direction<World> from) const override {
    const double aureole = std::exp(20.0 * (Dot(from.xyz, ToSun().xyz) - 1.0));
    return UniformDay::SkyRadiance(from) * (1.0 + 0.5 * from.xyz.z + 6.0 * aureole);
  }
  LinearRgb SkyHorizontalIrradiance() const override {
    // Midpoint rule over the hemisphere.
    constexpr int kSteps = 400;
    LinearRgb sum;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = std::sqrt((i + 0.5) / kSteps);
      const double sine = std::sqrt(1.0 - cosine * cosine);
      for (int j = 0; j < kSteps; ++j) {
        const double phi = 2.0 * kPi * (j + 0.5) / kSteps;
        sum = sum + SkyRadiance({{sine * std::cos(phi), sine * std::sin(phi), cosine}});
      }
    }
    return sum * (kPi / (kSteps * kSteps));
  }
};

TEST(LightSolver, GivesOpenGroundTheWholeSky) {
  const ClearDay day;
  const double whole = day.SkyHorizontalIrradiance().g;
  const auto meshes = MakeSolver({Phantom(Ground(3.0, {0.3F, 0.3F, 0.3F}))})->Solve(day, Mat3{});
  ASSERT_FALSE(meshes.empty());
  double sum = 0.0;
  for (const auto& light : meshes[0].ambient_with) {
    EXPECT_NEAR(light[1], whole, 0.03 * whole);
    sum += light[1];
  }
  EXPECT_NEAR(sum / static_cast<double>(meshes[0].positions.size()), whole, 0.01 * whole);
}

TEST(LightSolver, TurnsTheSkyWithTheMarker) {
  // The marker is vertical: its y axis points up, its z axis south.
  Mat3 marker_from_world;
  marker_from_world.m = {1, 0, 0, 0, 0, 1, 0, -1, 0};
  const auto solver = MakeSolver({Phantom(Ground(1.0, {0.0F, 0.0F, 0.0F}))});
  const UniformDay day({1.0, 1.0, 1.0});
  const std::array<Point<Marker>, 1> above{{{{0.0, 0.0, 5.0}}}};
  const LinearRgb wall = solver->phantoms().Ambient(above, {0, 0, 1}, day, marker_from_world)[0];
  const LinearRgb level = solver->phantoms().Ambient(above, {0, 1, 0}, day, marker_from_world)[0];
  EXPECT_NEAR(level.g, kPi, 0.01 * kPi);
  // Half the sky and half the land; the land has albedo 0.2 under the whole sky.
  EXPECT_NEAR(wall.g, 0.5 * kPi + 0.5 * 0.2 * kPi, 0.01 * kPi);
}

/// Light of meshes without what they reflect of the sun.
std::vector<std::array<float, 3>> FromSky(const LitMesh& mesh) {
  std::vector<std::array<float, 3>> light;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    light.push_back(mesh.AmbientWith(i, {.sun = {0, 0, 0}}));
  }
  return light;
}

TEST(LightSolver, KeepsSunAndSkyApart) {
  // A box in a corner of the ground, so that sunlight comes by one and by two reflections and from
  // the land.
  const auto solver =
      MakeSolver({Phantom(Ground(1.0, {0.5F, 0.4F, 0.3F})),
                  Object(BoxModel({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.4}, {0.5F, 0.6F, 0.7F}))});
  const ClearDay day;
  const ScaledSky without_sun(day, {1, 1, 1}, {});
  const auto coefficients = solver->Coefficients(kUp, {}, {});
  const auto expect_apart = [](const std::vector<LitMesh>& both, const std::vector<LitMesh>& sky) {
    ASSERT_EQ(both.size(), sky.size());
    double reflected = 0.0;
    for (std::size_t mesh = 0; mesh < both.size(); ++mesh) {
      const auto from_sky = FromSky(both[mesh]);
      ASSERT_EQ(from_sky.size(), sky[mesh].ambient_with.size());
      for (std::size_t i = 0; i < from_sky.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
          const float expected = sky[mesh].ambient_with[i][c];
          ASSERT_NEAR(from_sky[i][c], expected, 1e-4 * (expected + 1000.0F));
          reflected = std::max<double>(reflected, both[mesh].ambient_with[i][c] / expected);
        }
      }
    }
    EXPECT_GT(reflected, 1.5) << "the sun must matter";
  };
  expect_apart(solver->Solve(day, Mat3{}), solver->Solve(without_sun, Mat3{}));
  expect_apart(solver->Relight(coefficients, day, Mat3{}),
               solver->Relight(coefficients, without_sun, Mat3{}));
}

TEST(LightSolver, LightsAConvexBodyByTheTiltOfItsFacesAlone) {
  // The white furnace test: no part of a convex body shades or lights another.
  const auto meshes =
      MakeSolver({Object(BoxModel({-0.3, -0.3, 0.5}, {0.3, 0.3, 1.1}, {0.0F, 0.0F, 0.0F}))})
          ->Solve(UniformDay({1.0, 1.0, 1.0}), Mat3{});
  for (const LitMesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      // Visible share of the sky: (1 + n·up)/2; the rest is land of albedo 0.2.
      const double above = (1.0 + mesh.normals[i][2]) / 2.0;
      EXPECT_NEAR(mesh.ambient_with[i][1], kPi * (above + 0.2 * (1.0 - above)), 0.01 * kPi);
    }
  }
}

TEST(LightSolver, TintsTheGroundBesideASunlitRedWall) {
  const auto meshes =
      MakeSolver({Phantom(Ground(4.0, {0.3F, 0.3F, 0.3F})),
                  Object(BoxModel({-0.1, -1.0, 0.0}, {0.0, 1.0, 1.0}, {0.8F, 0.05F, 0.05F}))})
          ->Solve(UniformDay({1e3, 1e3, 1e3}, {60e3, 60e3, 60e3}, {1, 0, 1}), Mat3{});
  const FoundVertex near = Nearest(meshes, {0.3, 0.0, 0.0}, kUp);
  EXPECT_GT(near.with[0], 2.0F * near.with[1]);
  EXPECT_NEAR(near.without[0], near.without[1], 1e-3F * near.without[1]);
}

TEST(LightSolver, LetsAMetalSendAsMuchLightBackAsAMattThingOfItsColor) {
  const auto beside = [](float metallic) {
    auto box = BoxModel({-0.1, -1.0, 0.0}, {0.0, 1.0, 1.0}, {0.9F, 0.6F, 0.3F});
    box->materials[0].metallic = metallic;
    const auto meshes = MakeSolver({Phantom(Ground(4.0, {0.3F, 0.3F, 0.3F})), Object(box)})
                            ->Solve(UniformDay({1e3, 1e3, 1e3}), Mat3{});
    return Nearest(meshes, {0.1, 0.0, 0.0}, kUp).with;
  };
  EXPECT_EQ(beside(1.0F), beside(0.0F));
  EXPECT_GT(beside(1.0F)[0], 1.1F * beside(1.0F)[2]);
}

TEST(LightSolver, WarmsTheSunsSideOfABodyAtDawnAndLeavesTheOtherBlue) {
  // Uniformly grey, under a clear sky with the sun 4 degrees high in the east.
  const auto sky = sky::CreateDaylight({sky::SkyCondition::kClear, 0.0});
  const double elevation = 4.0 * kPi / 180.0;
  const Vec3 to_sun{std::cos(elevation), 0.0, std::sin(elevation)};
  const auto day = sky->ForSun({to_sun}, 1.0);
  const auto meshes =
      MakeSolver({Phantom(Ground(3.0, {0.3F, 0.3F, 0.3F})),
                  Object(BoxModel({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.6}, {0.5F, 0.5F, 0.5F}))})
          ->Solve(*day, Mat3{});
  const auto light_on = [&](Vec3 point, Vec3 normal) {
    const FoundVertex at = Nearest(meshes, point, normal);
    EXPECT_LT(at.distance_m, 0.05);
    const LinearRgb sky_and_ground{at.with[0], at.with[1], at.with[2]};
    return sky_and_ground + day->SunNormalIrradiance() * std::max(0.0, Dot(normal, to_sun));
  };
  const LinearRgb sunny = light_on({0.2, 0.0, 0.4}, {1, 0, 0});
  const LinearRgb shady = light_on({-0.2, 0.0, 0.4}, {-1, 0, 0});
  EXPECT_GT(sunny.r, 1.5 * sunny.b);
  EXPECT_GT(sunny.r, sunny.g);
  EXPECT_GT(shady.b, 1.1 * shady.r);
  EXPECT_GT(shady.b, shady.g);
  EXPECT_GT(Luminance(sunny), 2.0 * Luminance(shady));
}

TEST(LightSolver, ChangesNothingFarFromTheObject) {
  // A small box behind a wall: it is invisible from the other side, so the ratio there is exactly
  // 1.
  const auto meshes =
      MakeSolver({Phantom(Ground(6.0, {0.0F, 0.0F, 0.0F})),
                  Phantom(BoxModel({-0.2, -6.5, 0.0}, {0.0, 6.5, 3.0}, {0.4F, 0.4F, 0.4F})),
                  Object(BoxModel({0.5, -0.1, 0.0}, {0.7, 0.1, 0.2}, {0.5F, 0.5F, 0.5F}))})
          ->Solve(ClearDay(), Mat3{});
  int compared = 0;
  int changed = 0;
  for (const LitMesh& mesh : meshes) {
    if (!mesh.is_phantom || mesh.placed_model != 0 || mesh.normals[0][2] < 0.5F) continue;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      if (mesh.positions[i][0] < -0.3F) {
        EXPECT_EQ(mesh.ambient_with[i], mesh.ambient_without[i]);
        ++compared;
      } else if (mesh.ambient_with[i] != mesh.ambient_without[i]) {
        ++changed;
      }
    }
  }
  EXPECT_GT(compared, 50);
  EXPECT_GT(changed, 50);
}

TEST(LightSolver, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto solve = [](int threads) {
    return MakeSolver({Phantom(Ground(3.0, {0.3F, 0.3F, 0.3F})),
                       Object(BoxModel({-0.2, -0.2, 0.1}, {0.2, 0.2, 0.5}, {0.5F, 0.4F, 0.3F}))},
                      {.threads = threads})
        ->Solve(ClearDay(), Mat3{});
  };
  const auto one = solve(1);
  const auto three = solve(3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].positions, three[i].positions);
    EXPECT_EQ(one[i].ambient_with, three[i].ambient_with);
    EXPECT_EQ(one[i].ambient_without, three[i].ambient_without);
  }
}

TEST(LightSolver, LightsTheUpperSideOfGroundWoundDownwards) {
  for (const bool upside_down : {false, true}) {
    const auto meshes = MakeSolver({Phantom(Ground(2.0, {0.3F, 0.3F, 0.3F}, upside_down))})
                            ->Solve(UniformDay({1.0, 1.0, 1.0}), Mat3{});
    ASSERT_EQ(meshes.size(), 2U);
    EXPECT_GT(meshes[0].normals[0][2], 0.99F) << "the side under the sky comes first";
    EXPECT_NEAR(meshes[0].ambient_with[0][1], kPi, 0.01 * kPi);
    EXPECT_LT(meshes[1].normals[0][2], -0.99F);
  }
}

TEST(LightSolver, LightsAPhantomWoundInwardsFromOutside) {
  for (const bool inwards : {false, true}) {
    const auto meshes =
        MakeSolver(
            {Phantom(BoxModel({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}, {0.3F, 0.3F, 0.3F}, inwards))})
            ->Solve(UniformDay({1.0, 1.0, 1.0}), Mat3{});
    ASSERT_EQ(meshes.size(), 1U);
    const FoundVertex top = Nearest(meshes, {0.0, 0.0, 1.0}, kUp);
    EXPECT_LT(top.distance_m, 1.0);
    EXPECT_NEAR(top.with[1], kPi, 0.01 * kPi);
    for (std::size_t t = 0; t < meshes[0].indices.size(); t += 3) {
      std::array<Vec3, 3> p;
      for (int c = 0; c < 3; ++c) {
        const auto& q = meshes[0].positions[meshes[0].indices[t + c]];
        p[c] = {q[0], q[1], q[2]};
      }
      const auto& n = meshes[0].normals[meshes[0].indices[t]];
      EXPECT_GT(Dot(Cross(p[1] - p[0], p[2] - p[0]), Vec3{n[0], n[1], n[2]}), 0.0);
    }
  }
}

TEST(LightSolver, AgreesWithPathsFollowedOneByOne) {
  // Interpolated vertices against a path tracer over the same phantoms, with all bounces.
  const auto solver =
      MakeSolver({Phantom(Ground(4.0, {0.4F, 0.35F, 0.3F})),
                  Phantom(BoxModel({0.5, -2.0, 0.0}, {0.8, 2.0, 1.5}, {0.6F, 0.3F, 0.2F}))},
                 {.rays_per_vertex = 1024});
  const ClearDay day;
  const auto meshes = solver->Solve(day, Mat3{});
  for (const double x : {-2.0, -0.5, 0.0, 0.3}) {
    const FoundVertex vertex = Nearest(meshes, {x, 0.0, 0.0}, kUp);
    ASSERT_LT(vertex.distance_m, 0.2);
  }
  std::vector<Point<Marker>> points;
  std::vector<std::array<float, 3>> at_vertices;
  for (const LitMesh& mesh : meshes) {
    if (mesh.placed_model != 0 || mesh.normals[0][2] < 0.5F) continue;
    for (std::size_t i = 0; i < mesh.positions.size(); i += 7) {
      const auto& p = mesh.positions[i];
      if (std::fabs(p[1]) > 1.5F || p[0] > 0.45F || p[0] < -3.0F) continue;
      points.push_back({{p[0], p[1], p[2]}});
      at_vertices.push_back(mesh.ambient_without[i]);
    }
  }
  ASSERT_GT(points.size(), 3U);
  const auto paths = solver->phantoms().Ambient(points, kUp, day, Mat3{});
  ASSERT_EQ(paths.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(at_vertices[i][0], paths[i].r, 0.03 * paths[i].r);
    EXPECT_NEAR(at_vertices[i][2], paths[i].b, 0.03 * paths[i].b);
  }
}

TEST(LightSolver, SoftensTheSunsEdgeOverItsDisc) {
  // A half plane 10 m above. With u = distance from the shadow's centre over 10 m · tan 0.2666°,
  // the visible share is 1/2 + (u √(1−u²) + asin u)/π.
  Mesh half;
  AddQuad(
      &half,
      {{{-100.0, -100.0, 10.0}, {0.0, -100.0, 10.0}, {0.0, 100.0, 10.0}, {-100.0, 100.0, 10.0}}});
  const auto solver = MakeSolver({Phantom(ModelOf(half, {0.5F, 0.5F, 0.5F}))});
  const double radius = 10.0 * std::tan(959.63 / 3600.0 * kPi / 180.0);
  for (const double u : {-1.2, -0.8, -0.5, 0.0, 0.5, 0.8, 1.2}) {
    const double inside = std::clamp(u, -1.0, 1.0);
    const double expected =
        0.5 + (inside * std::sqrt(1.0 - inside * inside) + std::asin(inside)) / kPi;
    EXPECT_NEAR(solver->phantoms().SunVisibility({{u * radius, 0.0, 0.0}}, kUp), expected, 0.015)
        << u;
  }
}

TEST(LightSolver, AsksThePhantomsAloneForTheSun) {
  const auto solver =
      MakeSolver({Phantom(Ground(2.0, {0.3F, 0.3F, 0.3F})),
                  Object(BoxModel({-0.5, -0.5, 1.0}, {0.5, 0.5, 1.5}, {0.5F, 0.5F, 0.5F}))});
  EXPECT_EQ(solver->phantoms().SunVisibility({{0.0, 0.0, 0.0}}, kUp), 1.0);
}

TEST(LightSolver, RefusesASceneWithoutSurface) {
  EXPECT_FALSE(LightSolver::Create({}, {}));
  const auto model = ModelOf(Mesh{}, {0.5F, 0.5F, 0.5F});
  model->file = "phantoms/wall.obj";
  const auto empty = LightSolver::Create({Phantom(model)}, {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().kind, ErrorKind::kInput);
  EXPECT_EQ(empty.error().where, "phantoms/wall.obj");
}

TEST(LightSolver, RefusesIndicesBeyondAModelsVertices) {
  auto model = Ground(1.0, {0.5F, 0.5F, 0.5F});
  model->meshes[0].indices[3] = 99;
  EXPECT_FALSE(LightSolver::Create({Phantom(model)}, {}));
}

}  // namespace
}  // namespace pleinair::compositor
