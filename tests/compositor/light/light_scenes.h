#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "compositor/light/light_solver.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/model.h"
#include "compositor/models/placed_model.h"
#include "sky/sky_model.h"

namespace pleinair::compositor::testing {

/// A sky of uniform radiance, and a sun at a chosen position.
class UniformDay : public sky::SkyModel {
 public:
  explicit UniformDay(LinearRgb radiance, LinearRgb sun = {}, Vec3 to_sun = {0.0, 0.0, 1.0})
      : radiance_(radiance), sun_(sun), to_sun_(Normalized(to_sun)) {}
  LinearRgb SkyRadiance(Direction<World> from) const override {
    return from.xyz.z > 0.0 ? radiance_ : LinearRgb{};
  }
  LinearRgb SunNormalIrradiance() const override { return sun_; }
  LinearRgb SkyHorizontalIrradiance() const override { return radiance_ * std::numbers::pi; }
  Direction<World> ToSun() const override { return {to_sun_}; }

 private:
  LinearRgb radiance_, sun_;
  Vec3 to_sun_;
};

using Float3 = std::array<float, 3>;

/// Adds a quadrilateral, counter-clockwise from its front.
inline void AddQuad(Mesh* mesh, std::array<Vec3, 4> corners) {
  const auto base = static_cast<std::uint32_t>(mesh->positions.size());
  const Vec3 normal = Normalized(Cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (const Vec3 c : corners) {
    mesh->positions.push_back(
        {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)});
    mesh->normals.push_back(
        {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)});
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh->indices.push_back(base + i);
}

inline std::shared_ptr<Model> ModelOf(Mesh mesh, Float3 albedo) {
  auto model = std::make_shared<Model>();
  model->materials.push_back({});
  model->materials[0].base_color = albedo;
  model->meshes.push_back(std::move(mesh));
  return model;
}

/// Level square of side 2·half at height z.
inline std::shared_ptr<Model> Ground(double half, Float3 albedo, bool upside_down = false,
                                     double z = 0.0) {
  Mesh mesh;
  std::array<Vec3, 4> corners{
      {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}}};
  if (upside_down) std::swap(corners[1], corners[3]);
  AddQuad(&mesh, corners);
  return ModelOf(std::move(mesh), albedo);
}

/// Box between two corners, with faces outwards or inwards.
inline std::shared_ptr<Model> BoxModel(Vec3 low, Vec3 high, Float3 albedo, bool inwards = false) {
  const auto corner = [&](int i) {
    return Vec3{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                (i & 4) != 0 ? high.z : low.z};
  };
  Mesh mesh;
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces) {
    std::array<Vec3, 4> corners{corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])};
    if (inwards) std::swap(corners[1], corners[3]);
    AddQuad(&mesh, corners);
  }
  return ModelOf(std::move(mesh), albedo);
}

inline PlacedModel Phantom(std::shared_ptr<const Model> model) {
  return {std::move(model), Mat3{}, {}, true};
}
inline PlacedModel Object(std::shared_ptr<const Model> model) {
  return {std::move(model), Mat3{}, {}, false};
}

inline double Green(const Float3& rgb) { return rgb[1]; }

/// The vertex of the lit meshes nearest to a point, among those with a similar normal.
struct FoundVertex {
  Float3 with{}, without{};
  double distance_m = 1e9;
};
inline FoundVertex Nearest(const std::vector<LitMesh>& meshes, Vec3 point, Vec3 normal) {
  FoundVertex found;
  for (const LitMesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto& p = mesh.positions[i];
      const auto& n = mesh.normals[i];
      if (Dot(Vec3{n[0], n[1], n[2]}, normal) < 0.9) continue;
      const double distance = Norm(Vec3{p[0], p[1], p[2]} - point);
      if (distance >= found.distance_m) continue;
      found.distance_m = distance;
      found.with = mesh.ambient_with[i];
      found.without = mesh.is_phantom ? mesh.ambient_without[i] : Float3{};
    }
  }
  return found;
}

inline std::unique_ptr<LightSolver> MakeSolver(const std::vector<PlacedModel>& scene,
                                               LightSolverOptions options = {}) {
  auto solver = LightSolver::Create(scene, options);
  EXPECT_TRUE(solver) << solver.error().Message();
  return solver ? *std::move(solver) : nullptr;
}

}  // namespace pleinair::compositor::testing
