// The light among the surfaces of a real scene's size against paths followed one by one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "compositor/light_solver.h"
#include "compositor/model.h"
#include "tests/compositor/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::Phantom;
using testing::UniformDay;

// How far from the object the light on the phantoms is looked at: its shadow is not longer.
constexpr double kReachM = 1.5;

/// Brighter towards the horizon and the sun.
class Day : public UniformDay {
 public:
  Day() : UniformDay({2500, 3500, 6000}, {70e3, 65e3, 55e3}, {-0.2, -0.7, 0.68}) {}
  LinearRgb SkyRadiance(Direction<World> from) const override {
    return UniformDay::SkyRadiance(from) *
           (1.5 - from.xyz.z + std::exp(8 * (Dot(from.xyz, ToSun().xyz) - 1)));
  }
};

TEST(CourtyardLight, AgreesWithPathsFollowedOneByOneToThreePercent) {
  const auto model = LoadModel(PLEINAIR_SOURCE_DIR "/recordings/courtyard_midday/phantom.obj", {});
  ASSERT_TRUE(model) << model.error().Message();
  const auto shared = std::make_shared<const Model>(*model);
  const auto object = LoadModel(PLEINAIR_SOURCE_DIR "/recordings/courtyard_midday/object.obj", {});
  ASSERT_TRUE(object) << object.error().Message();
  const PlacedModel placed{std::make_shared<const Model>(*object), Mat3{}, {}, false};
  Vec3 standing;
  for (const auto& p : object->meshes[0].positions) {
    standing = standing + Vec3{p[0], p[1], p[2]} * (1.0 / object->meshes[0].positions.size());
  }
  const Day day;
  const auto solver = LightSolver::Create({Phantom(shared), placed}, {.rays_per_vertex = 128});
  // The oracle follows paths to their end.
  const auto oracle = LightSolver::Create({Phantom(shared)}, {.bounces = 12, .near_edge_m = 0.5});
  ASSERT_TRUE(solver && oracle);
  const auto traced = (*solver)->Solve(day, Mat3{});
  CoefficientOptions options;
  options.rays_per_vertex = 128;
  const auto relit =
      (*solver)->Relight((*solver)->Coefficients({0, 0, 1}, options, {}), day, Mat3{});
  double traced_square = 0.0, relit_square = 0.0, square = 0.0;
  int count = 0;
  for (std::size_t m = 0; m < traced.size(); ++m) {
    const LitMesh& mesh = traced[m];
    if (!mesh.is_phantom) continue;
    const std::size_t step = 3 * (1 + mesh.indices.size() / 3 / 120);
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += step) {
      // The middle of a triangle, whose corners may lie in the next body.
      Vec3 middle, normal;
      std::array<double, 3> traced_light{}, relit_light{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = mesh.indices[t + k];
        const auto& p = mesh.positions[i];
        const auto& n = mesh.normals[i];
        middle = middle + Vec3{p[0], p[1], p[2]} * (1 / 3.0);
        normal = normal + Vec3{n[0], n[1], n[2]} * (1 / 3.0);
        for (std::size_t c = 0; c < 3; ++c) {
          traced_light[c] += mesh.ambient_without[i][c] / 3.0;
          relit_light[c] += relit[m].ambient_without[i][c] / 3.0;
        }
      }
      normal = Normalized(normal);
      // Where the object changes the light, and open: not the soles of things, nor what lies under
      // or inside other ones (whose back is an odd number).
      const auto above = (*oracle)->FirstPhantom({middle + normal * 1e-3}, normal);
      if (Norm(middle - standing) > kReachM || normal.z < -0.5 ||
          (above && (above->surface % 2 == 1 || Norm(above->point.xyz - middle) < 0.05))) {
        continue;
      }
      const std::array<Point<Marker>, 1> points{{{middle}}};
      const LinearRgb paths = (*oracle)->AmbientPhantomsOnly(points, normal, day, Mat3{})[0];
      const std::array<double, 3> truth{paths.r, paths.g, paths.b};
      for (std::size_t c = 0; c < 3; ++c) {
        traced_square += std::pow(traced_light[c] - truth[c], 2);
        relit_square += std::pow(relit_light[c] - truth[c], 2);
        square += truth[c] * truth[c];
      }
      ++count;
    }
  }
  ASSERT_GT(count, 30);
  const double traced_rms = std::sqrt(traced_square / square);
  const double relit_rms = std::sqrt(relit_square / square);
  std::printf("%d places: traced %.2f %%, by coefficients %.2f %% RMS\n", count, 100 * traced_rms,
              100 * relit_rms);
  EXPECT_LT(traced_rms, 0.03);
  EXPECT_LT(relit_rms, 0.035);
}

}  // namespace
}  // namespace pleinair::compositor
