#include "compositor/light/surface_patches.h"
#include "compositor/light/light_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::Float3;
using testing::Ground;
using testing::ModelOf;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

Float3 ToFloats(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A smooth, wavy, upright ring of `around` × `across` vertices; its foot is at height 0.
Mesh BulgyRing(int around, int across) {
  const auto at = [&](double i, double k) {
    const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * k / across;
    const double thick = 0.16 + 0.02 * std::sin(9.0 * u + 3.0 * v) + 0.012 * std::cos(5.0 * v);
    const double radius = 0.35 + thick * std::cos(v);
    return Vec3{radius * std::cos(u), thick * std::sin(v), 0.53 + radius * std::sin(u)};
  };
  Mesh mesh;
  const auto index = [&](int i, int k) {
    return static_cast<std::uint32_t>(i % around * across + k % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      mesh.positions.push_back(ToFloats(at(i, k)));
      const Vec3 along = at(i + 0.01, k) - at(i - 0.01, k);
      mesh.normals.push_back(ToFloats(Normalized(Cross(at(i, k + 0.01) - at(i, k - 0.01), along))));
      const std::uint32_t a = index(i, k), b = index(i + 1, k), c = index(i + 1, k + 1),
                          d = index(i, k + 1);
      mesh.indices.insert(mesh.indices.end(), {a, c, b, a, d, c});
    }
  }
  return mesh;
}

std::vector<SurfaceMesh> SurfacesOf(const PlacedModel& placed) {
  return OrientedSurfaces(placed, 0);
}

/// Light `of` position and normal, averaged over each patch.
template <typename Light>
std::vector<Float3> PatchMeans(const SurfaceMesh& mesh, const SurfacePatches& patches,
                               const Light& of) {
  std::vector<Float3> sums(patches.count);
  std::vector<float> counts(patches.count);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (float& value : sums[patches.patch_of[v]]) value += of(mesh.positions[v], mesh.normals[v]);
    ++counts[patches.patch_of[v]];
  }
  for (std::uint32_t p = 0; p < patches.count; ++p) {
    for (float& value : sums[p]) value /= counts[p];
  }
  return sums;
}

TEST(SurfacePatches, AreAsManyAsAllowedAndHoldEachVertexOnce) {
  const auto surfaces = SurfacesOf(Object(ModelOf(BulgyRing(150, 80), {0.5F, 0.5F, 0.5F})));
  ASSERT_EQ(surfaces.size(), 1U);
  for (const std::size_t most : {500U, 2000U}) {
    const SurfacePatches patches = DividedIntoPatches(surfaces, {}, most, 1)[0];
    EXPECT_LE(patches.count, most);
    EXPECT_GT(patches.count, most / 2);
    std::vector<std::uint32_t> members = patches.members;
    std::sort(members.begin(), members.end());
    for (std::uint32_t v = 0; v < members.size(); ++v) EXPECT_EQ(members[v], v);
    EXPECT_EQ(members.size(), surfaces[0].positions.size());
  }
  EXPECT_EQ(DividedIntoPatches(surfaces, {}, 20'000, 1)[0].count, 0U) << "few enough as they are";
}

TEST(SurfacePatches, GiveLightThatChangesLinearlyBackAsItWas) {
  const auto surfaces = SurfacesOf(Object(ModelOf(BulgyRing(300, 160), {0.5F, 0.5F, 0.5F})));
  const SurfaceMesh& mesh = surfaces[0];
  const SurfacePatches patches = DividedIntoPatches(surfaces, {}, 3000, 1)[0];
  ASSERT_GT(patches.count, 0U);
  const auto light = [](const Float3& p, const Float3& n) {
    return 3.0F + 1.0F * p[0] - 0.5F * p[1] + 0.8F * p[2] + 0.4F * n[0] + 1.2F * n[2];
  };
  const auto values = patches.Interpolate(PatchMeans(mesh, patches, light));
  double squares = 0.0, worst = 0.0, steps = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const double off = values[v][0] - light(mesh.positions[v], mesh.normals[v]);
    squares += off * off;
    worst = std::max(worst, std::fabs(off));
  }
  // A patch boundary would appear as a step between neighbouring vertices.
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto off = [&](std::uint32_t v) {
      return values[v][0] - light(mesh.positions[v], mesh.normals[v]);
    };
    steps = std::max<double>(steps, std::fabs(off(mesh.indices[i]) - off(mesh.indices[i + 1])));
  }
  const double rms = std::sqrt(squares / static_cast<double>(values.size()));
  std::printf("linear light of about 3: off by %.4f RMS, %.4f at most, steps of %.4f\n", rms, worst,
              steps);
  EXPECT_LT(rms, 0.03);
  EXPECT_LT(worst, 0.1);
  EXPECT_LT(steps, 0.06);
}

TEST(SurfacePatches, KeepLayersApart) {
  // Two sheets, the lower 3 mm below the upper, both facing up.
  Mesh mesh;
  for (const double z : {0.0, 0.003}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t i = 0; i < 60; ++i) {
      for (std::uint32_t k = 0; k < 60; ++k) {
        mesh.positions.push_back(ToFloats({0.01 * i, 0.01 * k, z}));
        mesh.normals.push_back({0.0F, 0.0F, 1.0F});
        if (i == 59 || k == 59) continue;
        const std::uint32_t a = first + 60 * i + k;
        mesh.indices.insert(mesh.indices.end(), {a, a + 60, a + 61, a, a + 61, a + 1});
      }
    }
  }
  const auto surfaces = SurfacesOf(Object(ModelOf(mesh, {0.5F, 0.5F, 0.5F})));
  const SurfacePatches patches = DividedIntoPatches(surfaces, {}, 800, 1)[0];
  ASSERT_GT(patches.count, 0U);
  std::vector<float> height(patches.count, -1.0F);
  for (std::size_t v = 0; v < surfaces[0].positions.size(); ++v) {
    const float z = surfaces[0].positions[v][2];
    float& of_patch = height[patches.patch_of[v]];
    if (of_patch < 0.0F) of_patch = z;
    EXPECT_EQ(of_patch, z);
  }
}

TEST(SurfacePatches, AreBoundedForACrownOfLooseLeaves) {
  Mesh mesh;
  for (int leaf = 0; leaf < 3000; ++leaf) {
    const double u = std::fmod(leaf * 0.618034, 1.0), v = std::fmod(leaf * 0.414214, 1.0);
    const Vec3 at{u, v, 1.0 + std::fmod(leaf * 0.732051, 1.0)};
    testing::AddQuad(&mesh, {at, at + Vec3{0.02, 0, 0}, at + Vec3{0.02, 0.02, 0.01 * u},
                             at + Vec3{0, 0.02, 0.01 * v}});
  }
  const auto surfaces = SurfacesOf(Object(ModelOf(mesh, {0.1F, 0.3F, 0.1F})));
  const SurfacePatches patches = DividedIntoPatches(surfaces, {}, 1000, 1)[0];
  ASSERT_GT(patches.count, 0U);
  EXPECT_LE(patches.count * 2, 1000U) << "both sides";
}

TEST(SurfacePatches, LightADenseBodyAsItsVerticesWould) {
  const std::vector<PlacedModel> scene{Phantom(Ground(2.0, {0.3F, 0.25F, 0.2F}, false, -0.004)),
                                       Object(ModelOf(BulgyRing(180, 100), {0.6F, 0.4F, 0.3F}))};
  const UniformDay day({3e3, 4e3, 6e3}, {7e4, 6.5e4, 6e4}, {0.4, -0.6, 0.7});
  LightSolverOptions options;
  options.rays_per_vertex = 192;
  options.bounces = 1;
  options.near_edge_m = 0.08;
  const auto solve = [&](std::size_t most, bool share_dense) {
    options.max_patches = most;
    options.share_dense = share_dense;
    auto solver = LightSolver::Create(scene, options);
    EXPECT_TRUE(solver);
    return (*solver)->Solve(day, Mat3{});
  };
  const auto full = solve(1'000'000, false);
  const std::map<std::string, std::vector<LitMesh>> divided{{"8,000 patches", solve(8'000, false)},
                                                            {"as dense", solve(1'000'000, true)}};
  for (const auto& [name, light] : divided) {
    ASSERT_EQ(full.size(), light.size());
    for (std::size_t m = 0; m < full.size(); ++m) {
      ASSERT_EQ(full[m].positions, light[m].positions);
      double squares = 0.0, sum = 0.0;
      for (std::size_t v = 0; v < full[m].positions.size(); ++v) {
        for (int c = 0; c < 3; ++c) {
          squares += std::pow(full[m].ambient_with[v][c] - light[m].ambient_with[v][c], 2);
          sum += full[m].ambient_with[v][c];
        }
      }
      if (sum == 0.0) continue;  // The ground's lower side.
      const auto count = static_cast<double>(3 * full[m].positions.size());
      const double relative = std::sqrt(squares / count) / (sum / count);
      std::printf("%s, %s of %zu vertices: %.2f %% RMS\n", name.c_str(),
                  full[m].is_phantom ? "ground" : "ring", full[m].positions.size(), 100 * relative);
      // Most of the ring's error is the noise of the reference's 192 rays.
      EXPECT_LT(relative, full[m].is_phantom ? 0.002 : 0.04) << name;
    }
  }
}

TEST(SurfacePatches, AreSharedByTheVerticesOfTheFileWhereTheyAreDense) {
  const auto surfaces = SurfacesOf(Object(ModelOf(BulgyRing(150, 80), {0.5F, 0.5F, 0.5F})));
  const std::size_t vertices = surfaces[0].positions.size(), in_file = vertices - 100;
  const auto divide = [&](LightPlaces places) {
    return DividedWhereDense(surfaces, {places}, 1)[0];
  };
  const SurfacePatches patches = divide({0.03, in_file});
  ASSERT_GT(patches.count, 100U);
  EXPECT_LE(2 * patches.count, vertices);
  EXPECT_EQ(PatchCount(surfaces, {patches}), patches.count);
  for (std::size_t v = in_file; v < vertices; ++v) {
    const std::uint32_t patch = patches.patch_of[v];
    EXPECT_EQ(std::count(patches.patch_of.begin(), patches.patch_of.end(), patch), 1)
        << "the light needed this vertex";
  }
  EXPECT_EQ(divide({0.005, vertices}).count, 0U) << "not denser than the light needs";
  EXPECT_EQ(divide({0.03, vertices / 2}).count, 0U) << "the light needed most of them";
  EXPECT_EQ(divide({}).count, 0U) << "a phantom";
  EXPECT_EQ(PatchCount(surfaces, {SurfacePatches{}}), vertices);
}

}  // namespace
}  // namespace pleinair::compositor
