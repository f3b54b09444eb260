
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "compositor/light/light_solver_options.h"
#include "compositor/light/patch_scene.h"
#include "compositor/light/tessellation.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Object;
using testing::Phantom;

std::vector<SurfaceMesh> Scene() {
  std::vector<SurfaceMesh> surfaces = OrientedSurfaces(Phantom(Ground(5.0, {0.5F, 0.5F, 0.5F})), 0);
  for (SurfaceMesh& surface : OrientedSurfaces(
           Object(BoxModel({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.5}, {0.5F, 0.5F, 0.5F})), 1)) {
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

double Length(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(Tessellation, KeepsEdgesShortNearObjectsAndLongFarAway) {
  std::vector<SurfaceMesh> surfaces = Scene();
  Tessellate({}, &surfaces);
  for (const SurfaceMesh& surface : surfaces) {
    for (std::size_t i = 0; i < surface.indices.size(); ++i) {
      const auto& a = surface.positions[surface.indices[i]];
      const auto& b = surface.positions[surface.indices[i % 3 == 2 ? i - 2 : i + 1]];
      const double x = std::max(0.0, std::fabs(a[0] + b[0]) / 2.0 - 0.2);
      const double y = std::max(0.0, std::fabs(a[1] + b[1]) / 2.0 - 0.2);
      EXPECT_LE(Length(a, b), 0.04 + 0.25 * std::hypot(x, y) + 1e-5);
    }
  }
  EXPECT_LT(surfaces[0].positions.size(), 5000U);
}

TEST(Tessellation, KeepsEdgesShorterWherePhantomsMeet) {
  // The object is 4 m from a wall. The edge length is 1.04 m on open ground and a third of that at
  // the wall's foot.
  std::vector<SurfaceMesh> surfaces = Scene();
  for (SurfaceMesh& surface : OrientedSurfaces(
           Phantom(BoxModel({4.2, -5.0, 0.0}, {4.5, 5.0, 2.0}, {0.5F, 0.5F, 0.5F})), 2)) {
    surfaces.push_back(std::move(surface));
  }
  Tessellate({}, &surfaces);
  double at_foot = 0.0, in_sunlight = 0.0;
  const SurfaceMesh& ground = surfaces[0];
  for (std::size_t i = 0; i < ground.indices.size(); ++i) {
    const auto& a = ground.positions[ground.indices[i]];
    const auto& b = ground.positions[ground.indices[i % 3 == 2 ? i - 2 : i + 1]];
    const float x = (a[0] + b[0]) / 2.0F, y = (a[1] + b[1]) / 2.0F;
    if (std::fabs(y) > 0.5F) continue;
    if (std::fabs(x - 4.2F) < 0.05F) at_foot = std::max(at_foot, Length(a, b));
    if (std::fabs(x + 4.2F) < 0.3F) in_sunlight = std::max(in_sunlight, Length(a, b));
  }
  EXPECT_GT(at_foot, 0.1);
  EXPECT_LT(at_foot, 0.42);
  EXPECT_GT(in_sunlight, 0.5);
}

TEST(Tessellation, KeepsAreaAndLeavesNoGaps) {
  std::vector<SurfaceMesh> surfaces = Scene();
  Tessellate({}, &surfaces);
  double area = 0.0;
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
  const SurfaceMesh& ground = surfaces[0];
  for (std::size_t i = 0; i < ground.indices.size(); i += 3) {
    std::array<std::array<float, 3>, 3> p;
    for (int c = 0; c < 3; ++c) p[c] = ground.positions[ground.indices[i + c]];
    area +=
        ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) /
        2.0;
    for (int c = 0; c < 3; ++c) {
      auto edge = std::make_pair(p[c], p[(c + 1) % 3]);
      if (edge.second < edge.first) std::swap(edge.first, edge.second);
      ++edges[edge];
    }
  }
  EXPECT_NEAR(area, 100.0, 1e-3);
  for (const auto& [edge, uses] : edges) {
    const bool border = (std::fabs(edge.first[0]) == 5.0F && edge.first[0] == edge.second[0]) ||
                        (std::fabs(edge.first[1]) == 5.0F && edge.first[1] == edge.second[1]);
    EXPECT_EQ(uses, border ? 1 : 2) << "a vertex lies on a neighbour's edge";
  }
}

TEST(Tessellation, InterpolatesAllAttributesWhereverEdgesAreSplit) {
  const auto box = BoxModel({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.5}, {0.5F, 0.5F, 0.5F});
  Mesh& mesh = box->meshes[0];
  const auto uv_at = [](const std::array<float, 3>& p) { return std::array{p[0] + p[2], p[1]}; };
  const auto detail_at = [](const std::array<float, 3>& p) {
    return VertexDetail{{p[1], p[2] - p[0]}, {0.5F + p[0], 0.5F + p[1], p[2], 1.0F - p[2]}};
  };
  for (const auto& position : mesh.positions) {
    mesh.uvs.push_back(uv_at(position));
    mesh.details.push_back(detail_at(position));
  }
  // A low wall covers the lower part of the box.
  const std::vector<PlacedModel> models{
      Phantom(BoxModel({0.21, -1.0, 0.0}, {0.3, 1.0, 0.2}, {0.5F, 0.5F, 0.5F})), Object(box)};
  std::vector<SurfaceMesh> surfaces = OrientedSurfaces(models[0], 0);
  surfaces.push_back(OrientedSurfaces(models[1], 1).at(0));
  Tessellate({}, &surfaces);
  const auto scene = PatchScene::Create(models, LightSolverOptions{});
  ASSERT_TRUE(scene) << scene.error().Message();
  const SurfaceMesh& refined = scene->mesh_sides.back().mesh;
  ASSERT_FALSE(refined.is_phantom);
  // The light at the wall's edge needs more vertices than the tessellation has.
  ASSERT_GT(refined.positions.size(), surfaces[1].positions.size());
  ASSERT_EQ(refined.uvs.size(), refined.positions.size());
  ASSERT_EQ(refined.details.size(), refined.positions.size());
  for (std::size_t v = 0; v < refined.positions.size(); ++v) {
    const auto uv = uv_at(refined.positions[v]);
    const VertexDetail detail = detail_at(refined.positions[v]);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(refined.uvs[v][i], uv[i], 1e-6);
      EXPECT_NEAR(refined.details[v].uv[i], detail.uv[i], 1e-6);
    }
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_NEAR(refined.details[v].color[c], detail.color[c], 1e-6);
    }
  }
}

TEST(PatchScene, ReflectsTheMeanOfVertexColorsByArea) {
  // A white square, and beside it a small red one with most of the vertices.
  auto object = testing::Ground(0.02, {0.5F, 0.5F, 0.5F}, false, 0.3);
  Mesh& mesh = object->meshes[0];
  mesh.details.resize(4);
  for (int i = 0; i < 16; ++i) {
    const double x = 0.03 + 0.001 * (i % 4), y = 0.001 * static_cast<double>(i / 4);
    testing::AddQuad(
        &mesh,
        {{{x, y, 0.3}, {x + 0.001, y, 0.3}, {x + 0.001, y + 0.001, 0.3}, {x, y + 0.001, 0.3}}});
  }
  mesh.details.resize(mesh.positions.size(), VertexDetail{{}, {1.0F, 0.0F, 0.0F, 1.0F}});
  const auto scene = PatchScene::Create({Object(object)}, LightSolverOptions{});
  ASSERT_TRUE(scene) << scene.error().Message();
  ASSERT_EQ(scene->mesh_sides.size(), 2U);  // Front and back.
  // 16 mm² of red, 1,600 mm² of white.
  EXPECT_NEAR(scene->mesh_sides[0].albedo[0], 0.5F, 1e-4);
  EXPECT_NEAR(scene->mesh_sides[0].albedo[1], 0.5 / 1.01, 5e-4);
}

TEST(Tessellation, StaysBelowItsLimit) {
  std::vector<SurfaceMesh> surfaces = Scene();
  Tessellate({.near_edge_m = 0.002, .growth_per_m = 0.01, .max_vertices = 3000}, &surfaces);
  std::size_t count = 0;
  for (const SurfaceMesh& surface : surfaces) count += surface.positions.size();
  EXPECT_LE(count, 3000U);
  EXPECT_GT(count, 500U);
}

TEST(Tessellation, IsNotMadeCoarserByContacts) {
  // The wall's foot needs more vertices than the limit allows. It is not refined, and nothing else
  // changes.
  std::vector<SurfaceMesh> apart = Scene(), touching = Scene();
  const auto count = [](const std::vector<SurfaceMesh>& surfaces) {
    std::size_t vertices = 0;
    for (const SurfaceMesh& surface : surfaces) vertices += surface.positions.size();
    return vertices;
  };
  for (auto* scene : {&apart, &touching}) {
    const double gap = scene == &apart ? 0.05 : 0.0;
    for (SurfaceMesh& surface : OrientedSurfaces(
             Phantom(BoxModel({1.2, -5.0, gap}, {1.5, 5.0, 2.0}, {0.5F, 0.5F, 0.5F})), 2)) {
      scene->push_back(std::move(surface));
    }
  }
  std::vector<SurfaceMesh> whole = touching, limited = touching;
  Tessellate({}, &apart);
  Tessellate({}, &whole);
  ASSERT_GT(count(whole), count(apart) + 500);
  Tessellate({.max_vertices = count(whole) - 100}, &limited);
  EXPECT_EQ(limited[0].positions, apart[0].positions);
}

TEST(Tessellation, LeavesFineSurfacesAlone) {
  std::vector<SurfaceMesh> surfaces = Scene();
  Tessellate({}, &surfaces);
  const std::vector<std::uint32_t> before = surfaces[0].indices;
  Tessellate({}, &surfaces);
  EXPECT_EQ(surfaces[0].indices, before);
}

}  // namespace
}  // namespace pleinair::compositor
