#include "compositor/light/daylight/daylight_coefficients.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

#include "compositor/light/daylight/interreflection.h"
#include "compositor/light/light_solver.h"
#include "compositor/light/patch_scene.h"
#include "compositor/light/sampling.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

namespace fs = std::filesystem;
using testing::AddQuad;
using testing::BoxModel;
using testing::Ground;
using testing::ModelOf;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;
constexpr double kPi = std::numbers::pi;
constexpr Vec3 kUp{0, 0, 1};

PatchScene SceneOf(const std::vector<PlacedModel>& models, double edge_m = 0.1) {
  LightSolverOptions options;
  options.near_edge_m = edge_m;
  auto scene = PatchScene::Create(models, options);
  EXPECT_TRUE(scene.has_value());
  return *std::move(scene);
}

std::vector<std::array<float, 3>> Product(const CoefficientMatrix& matrix,
                                          const std::vector<LinearRgb>& sky,
                                          const std::vector<LinearRgb>& sun) {
  std::vector<std::array<float, 3>> light(matrix.vertices());
  matrix.Multiply(sky, sun, light);
  return light;
}

/// Irradiance under uniform radiance 1, from the land too.
std::vector<std::array<float, 3>> UnderUniformLight(const DaylightCoefficients& coefficients) {
  const int total = coefficients.Patches().total();
  return Product(coefficients.with, std::vector<LinearRgb>(total, {1, 1, 1}),
                 std::vector<LinearRgb>(total));
}

/// Mean over a mesh side, weighted by area.
double MeanOver(const PatchScene& scene, std::size_t mesh_side,
                const std::vector<std::array<float, 3>>& light, double* area_m2 = nullptr) {
  const PatchScene::MeshSide& s = scene.mesh_sides[mesh_side];
  double sum = 0.0, area = 0.0;
  for (std::size_t t = 0; t + 2 < s.mesh.indices.size(); t += 3) {
    std::array<Vec3, 3> p;
    double mean = 0.0;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t i = s.mesh.indices[t + c];
      p[c] = {s.mesh.positions[i][0], s.mesh.positions[i][1], s.mesh.positions[i][2]};
      mean += light[s.first_patch + i][1] / 3.0;
    }
    const double a = Norm(Cross(p[1] - p[0], p[2] - p[0])) / 2;
    sum += mean * a;
    area += a;
  }
  if (area_m2 != nullptr) *area_m2 = area;
  return sum / area;
}

TEST(SkyPatches, AreTregenzas145AndReinhartsFinerOnes) {
  for (const auto& [division, count] : {std::pair{1, 145}, {2, 577}, {3, 1297}, {4, 2305}}) {
    const SkyPatches patches(kUp, division);
    EXPECT_EQ(patches.count(), count);
    double whole = 0.0;
    for (int i = 0; i < count; ++i) whole += patches.SolidAngle(i);
    EXPECT_NEAR(whole, 2 * kPi, 1e-12);
    EXPECT_EQ(patches.At({0, 0, 1}), count - 1);
    EXPECT_EQ(patches.At({1, 0, -0.1}), patches.land());
  }
}

TEST(SkyPatches, HoldTheSharesOfDirectionsThatTheirSolidAnglesSay) {
  const Vec3 up = Normalized({0.3, 0.5, 0.8});
  const TangentFrame frame(up);
  for (const int division : {1, 2, 4}) {
    const SkyPatches patches(up, division);
    std::vector<int> hits(patches.total());
    const int finer = division * division;
    const std::uint32_t directions = 400'000U * finer;
    for (std::uint32_t i = 0; i < directions; ++i) {
      const SamplePoint at = ShiftedHammersley(i, directions, 0);
      const double sine = at.u, cosine = std::sqrt(1 - sine * sine);
      ++hits[patches.At(frame.ToWorld(cosine * std::cos(2 * kPi * at.v),
                                      cosine * std::sin(2 * kPi * at.v), sine))];
    }
    for (int i = 0; i < patches.count(); ++i) {
      EXPECT_NEAR(hits[i] / static_cast<double>(directions), patches.SolidAngle(i) / (2 * kPi),
                  2e-4 / finer)
          << "patch " << i << " of division " << division;
    }
  }
}

TEST(SkyPatches, KeepTheSunsIrradianceWhereverItStands) {
  for (const int division : {1, 2, 4}) {
    const SkyPatches patches(kUp, division);
    for (const double elevation : {0.02, 0.3, 1.2, 1.55}) {
      for (const double azimuth : {0.0, 1.0, 3.1, 6.2}) {
        const UniformDay day({}, {3, 2, 1},
                             {std::cos(elevation) * std::sin(azimuth),
                              std::cos(elevation) * std::cos(azimuth), std::sin(elevation)});
        LinearRgb sum;
        const auto sun = patches.Sun(day, Mat3{});
        for (int i = 0; i < patches.count(); ++i) sum = sum + sun[i] * patches.SolidAngle(i);
        EXPECT_NEAR(sum.r, 3, 1e-9) << division;
        EXPECT_NEAR(sum.b, 1, 1e-9) << division;
      }
    }
  }
}

TEST(DaylightCoefficients, GiveAnUnoccludedPatchTheSkysHorizontalIlluminance) {
  const PatchScene scene = SceneOf({Phantom(Ground(1.0, {0.3F, 0.3F, 0.3F}))});
  const auto coefficients = ComputeCoefficients(scene, kUp, {}, {});
  // A steep gradient towards the zenith, which no patch resolves.
  class Steep : public UniformDay {
   public:
    Steep() : UniformDay({1, 1, 1}) {}
    LinearRgb SkyRadiance(Direction<World> from) const override {
      const double z = from.xyz.z;
      return LinearRgb{1, 1, 1} * (z > 0.0 ? 0.2 + z * z : 0.0);
    }
    LinearRgb SkyHorizontalIrradiance() const override {
      return LinearRgb{1, 1, 1} * (2 * kPi * (0.1 + 0.25));
    }
  } day;
  const SkyPatches patches = coefficients.Patches();
  const auto light =
      Product(coefficients.with, patches.Radiances(day, Mat3{}, 0.0), patches.Sun(day, Mat3{}));
  EXPECT_NEAR(MeanOver(scene, 0, light), day.SkyHorizontalIrradiance().g,
              0.01 * day.SkyHorizontalIrradiance().g);
}

TEST(DaylightCoefficients, SumToAWholeHemisphereOnAConvexBody) {
  const PatchScene scene =
      SceneOf({Object(BoxModel({-0.3, -0.3, 0.5}, {0.3, 0.3, 1.1}, {0.5F, 0.5F, 0.5F}))});
  const auto light = UnderUniformLight(ComputeCoefficients(scene, kUp, {}, {}));
  for (const auto& value : light) EXPECT_NEAR(value[1], kPi, 0.01 * kPi);
}

TEST(DaylightCoefficients, AreReciprocal) {
  // An upright square of 1 m² at the edge of a level rectangle of 2 m². Both are black, so each
  // lacks the uniform light that the other occludes: E = π (1 − F); A1 F12 = A2 F21. F12 = 0.2329
  // for H = 2, W = 1, upright to level (Howell's catalogue, C-14).
  Mesh upright, level;
  AddQuad(&upright, {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}});
  AddQuad(&level, {{{0, -2, 0}, {1, -2, 0}, {1, 0, 0}, {0, 0, 0}}});
  const PatchScene scene =
      SceneOf({Object(ModelOf(upright, {0, 0, 0})), Object(ModelOf(level, {0, 0, 0}))}, 0.05);
  const auto light =
      UnderUniformLight(ComputeCoefficients(scene, kUp, {.rays_per_vertex = 512}, {}));
  // The side that faces the other surface receives less light.
  double area1 = 0.0, area2 = 0.0, least1 = 1e9, least2 = 1e9;
  for (std::size_t mesh_side = 0; mesh_side < scene.mesh_sides.size(); ++mesh_side) {
    const bool first = scene.mesh_sides[mesh_side].mesh.placed_model == 0;
    const double mean = MeanOver(scene, mesh_side, light, first ? &area1 : &area2);
    (first ? least1 : least2) = std::min(first ? least1 : least2, mean);
  }
  const double f12 = 1 - least1 / kPi, f21 = 1 - least2 / kPi;
  EXPECT_NEAR(area1 * f12, area2 * f21, 0.01 * area1 * f12);
  EXPECT_NEAR(f12, 0.2329, 0.01 * 0.2329);
}

TEST(DaylightCoefficients, KeepAllLightInAWhiteBox) {
  // An open box under uniform light. As its walls approach white every path escapes, and the light
  // is π everywhere (the furnace test). The loss with grey ρ is linear in 1 − ρ near white.
  const auto mean = [](float albedo) {
    Mesh box;
    AddQuad(&box, {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}});
    AddQuad(&box, {{{-1, -1, 0}, {-1, -1, 1}, {1, -1, 1}, {1, -1, 0}}});
    AddQuad(&box, {{{-1, 1, 0}, {1, 1, 0}, {1, 1, 1}, {-1, 1, 1}}});
    AddQuad(&box, {{{-1, -1, 0}, {-1, 1, 0}, {-1, 1, 1}, {-1, -1, 1}}});
    AddQuad(&box, {{{1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0}}});
    const PatchScene scene = SceneOf({Object(ModelOf(box, {albedo, albedo, albedo}))}, 0.3);
    const auto light = UnderUniformLight(
        ComputeCoefficients(scene, kUp, {.rays_per_vertex = 256, .convergence = 1e-4}, {}));
    double sum = 0.0;
    for (const auto& value : light) sum += value[1];
    return sum / static_cast<double>(light.size());
  };
  const double at96 = mean(0.96F), at98 = mean(0.98F);
  EXPECT_LT(at96, at98);
  EXPECT_NEAR(2 * at98 - at96, kPi, 0.01 * kPi);
}

TEST(DaylightCoefficients, FollowReflectionsUntilTheyHaveConverged) {
  const PatchScene scene =
      SceneOf({Phantom(Ground(1.5, {0.8F, 0.8F, 0.8F})),
               Object(BoxModel({-0.5, 0.2, 0.0}, {0.5, 0.3, 0.8}, {0.8F, 0.8F, 0.8F}))});
  const auto coarse = ComputeCoefficients(scene, kUp, {.convergence = 0.1}, {});
  const auto fine = ComputeCoefficients(scene, kUp, {.convergence = 0.001}, {});
  EXPECT_LT(coarse.reflections, fine.reflections);
  double less = 0.0, more = 0.0;
  const auto a = UnderUniformLight(coarse), b = UnderUniformLight(fine);
  for (std::size_t i = 0; i < a.size(); ++i) {
    less += a[i][1];
    more += b[i][1];
  }
  EXPECT_LT(less, more);
  EXPECT_GT(less, 0.88 * more);
}

class Yard : public ::testing::Test {
 protected:
  static std::vector<PlacedModel> Models() {
    return {Phantom(Ground(3.0, {0.4F, 0.35F, 0.3F})),
            Phantom(BoxModel({0.5, -1.5, 0.0}, {0.7, 1.5, 1.2}, {0.6F, 0.3F, 0.2F})),
            Object(BoxModel({-0.4, -0.3, 0.0}, {0.1, 0.2, 0.5}, {0.5F, 0.5F, 0.6F}))};
  }
};

/// RMS difference of the light with objects, relative to the RMS of the first.
double Difference(const std::vector<LitMesh>& solved, const std::vector<LitMesh>& relit) {
  EXPECT_EQ(solved.size(), relit.size());
  double square = 0.0, total = 0.0;
  for (std::size_t m = 0; m < solved.size(); ++m) {
    EXPECT_EQ(solved[m].placed_model, relit[m].placed_model);
    for (std::size_t i = 0; i < solved[m].positions.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        square += std::pow(solved[m].ambient_with[i][c] - relit[m].ambient_with[i][c], 2);
        total += std::pow(solved[m].ambient_with[i][c], 2);
      }
    }
  }
  return std::sqrt(square / total);
}

TEST_F(Yard, IsRelitAsItIsSolved) {
  auto solver =
      LightSolver::Create(Models(), {.rays_per_vertex = 256, .bounces = 5, .near_edge_m = 0.08});
  ASSERT_TRUE(solver);
  CoefficientOptions options;
  options.rays_per_vertex = 256;
  options.convergence = 0.002;
  const LinearRgb sun{60e3, 54e3, 48e3};
  const Vec3 to_sun{-0.7, -0.3, 0.9};
  const UniformDay overcast({2000, 3000, 5000}), sunny({2000, 3000, 5000}, sun, to_sun);
  std::map<int, double> softened;
  for (const int division : {1, 2, 4}) {
    options.division = division;
    const auto coefficients = (*solver)->Coefficients(kUp, options, {});
    ASSERT_EQ(coefficients.with.patches(), SkyPatches(kUp, division).total());
    const auto off = [&](const sky::SkyModel& day) {
      return Difference((*solver)->Solve(day, Mat3{}),
                        (*solver)->Relight(coefficients, day, Mat3{}));
    };
    // Under the sky alone the same rays give the same light; the rays of the finer patches nearly
    // do. The sun is spread over its patches.
    EXPECT_LT(off(overcast), division == 1 ? 0.005 : 0.01) << division;
    EXPECT_LT(off(sunny), 0.03) << division;
    softened[division] = off(UniformDay({}, sun, to_sun));
  }
  // Finer patches spread the sun less.
  EXPECT_LT(softened[2], 0.65 * softened[1]);
  EXPECT_LT(softened[4], 0.4 * softened[1]);
}

TEST_F(Yard, ComesOutOfTheCacheAsItWentIn) {
  const fs::path folder = fs::temp_directory_path() / "pleinair_daylight_coefficients_test";
  fs::remove_all(folder);
  auto solver = LightSolver::Create(Models(), {.near_edge_m = 0.2});
  ASSERT_TRUE(solver);
  CoefficientOptions options;
  options.rays_per_vertex = 32;
  options.cache = folder;
  std::vector<double> steps;
  const auto made = (*solver)->Coefficients(kUp, options, [&](double s) { steps.push_back(s); });
  EXPECT_FALSE(made.from_cache);
  EXPECT_EQ(steps.front(), 0.0);
  EXPECT_EQ(steps.back(), 1.0);
  const auto found = (*solver)->Coefficients(kUp, options, {});
  EXPECT_TRUE(found.from_cache);
  EXPECT_EQ(found.with.codes(), made.with.codes());
  EXPECT_EQ(found.without.scales(), made.without.scales());
  // Another geometry, color or up direction is another entry.
  auto models = Models();
  models[0] = Phantom(Ground(3.0, {0.4F, 0.35F, 0.31F}));
  auto other = LightSolver::Create(models, {.near_edge_m = 0.2});
  EXPECT_FALSE((*other)->Coefficients(kUp, options, {}).from_cache);
  EXPECT_FALSE((*solver)->Coefficients({0, 1, 0}, options, {}).from_cache);
  // A damaged file is rejected.
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(5000);
    file.put('\x7F');
    file.put('\x01');
  }
  EXPECT_FALSE((*solver)->Coefficients(kUp, options, {}).from_cache);
  fs::remove_all(folder);
}

TEST(AddInterreflections, AddsWithVectorUnitsAsOneByOne) {
  std::vector<ChunkLight> light(9);
  for (std::uint32_t v = 0; v < light.size(); ++v) {
    for (std::uint32_t i = 0; i < light[v].size(); ++i) {
      light[v][i] = static_cast<float>(UnitFromHash(Hash(v, i)));
    }
  }
  std::vector<ReflectingPlace> places;
  for (std::size_t i = 0; i < 7; ++i) {
    const float u = 0.1F * static_cast<float>(i), v = 0.3F;
    places.push_back(
        {{&light[i], &light[i + 1], &light[i + 2]}, {1 - u - v, u, v}, {0.5F, 0.1F, 0.03F}});
  }
  ChunkLight fast = light[0], slow = light[0];
  AddInterreflections(places, &fast);
  AddInterreflectionsScalar(places, &slow);
  EXPECT_GT(slow[0], light[0][0]);
  for (std::size_t i = 0; i < slow.size(); ++i) EXPECT_NEAR(fast[i], slow[i], 1e-5 * slow[i]) << i;
}

TEST(CoefficientMatrix, MultipliesWithVectorUnitsAsOneByOne) {
  constexpr std::size_t kVertices = 77;  // Not a multiple of any vector width.
  CoefficientMatrix matrix(kVertices, 146);
  for (std::size_t v = 0; v < kVertices; ++v) {
    for (int chunk = 0; chunk < matrix.chunks(); ++chunk) {
      for (int plane = 0; plane < CoefficientMatrix::kPlanes; ++plane) {
        std::array<float, CoefficientMatrix::kPatches> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
          values[i] = static_cast<float>(
              UnitFromHash(Hash(static_cast<std::uint32_t>(v * 977 + i),
                                static_cast<std::uint32_t>(chunk * 31 + plane))));
        }
        matrix.Set(v, chunk, plane, values);
        EXPECT_NEAR(matrix.At(v, chunk * CoefficientMatrix::kPatches, plane), values[0], 1 / 500.0);
      }
    }
  }
  std::vector<LinearRgb> sky(146), sun(146);
  for (int i = 0; i < 146; ++i) {
    sky[i] = {1.0 + i % 7, 2.0 + i % 3, 3.0};
    sun[i] = {i == 20 ? 500.0 : 0.0, i == 21 ? 400.0 : 0.0, 0.0};
  }
  std::vector<std::array<float, 3>> fast(kVertices), slow(kVertices);
  matrix.Multiply(sky, sun, fast);
  matrix.MultiplyScalar(sky, sun, slow);
  for (std::size_t v = 0; v < kVertices; ++v) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(fast[v][c], slow[v][c], 1e-5 * slow[v][c]);
  }
  // A range of the vertices with any begin and end.
  for (const std::size_t first : {0U, 1U, 15U, 16U, 30U}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kVertices - first}) {
      std::vector<std::array<float, 3>> part(count);
      matrix.Multiply(sky, sun, part, first);
      EXPECT_TRUE(
          std::equal(part.begin(), part.end(), fast.begin() + static_cast<std::ptrdiff_t>(first)));
    }
  }
}

}  // namespace
}  // namespace pleinair::compositor
