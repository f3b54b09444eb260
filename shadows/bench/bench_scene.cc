#include "shadows/bench/bench_scene.h"

#include <cmath>
#include <numbers>

#include "base/units.h"
#include "shadows/bench/mesh_shapes.h"

namespace pleinair::shadows {
namespace {

const glm::vec3 kGround{0.35F, 0.33F, 0.27F};
const glm::vec3 kStone{0.55F, 0.53F, 0.5F};
const glm::vec3 kWood{0.3F, 0.2F, 0.12F};

// Unit vector from azimuth (from +y towards +x) and elevation, degrees.
glm::dvec3 ToSun(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kRadiansPerDegree, e = elevation_deg * kRadiansPerDegree;
  return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

// The ground in tiles, so that coarser maps can omit tiles that a finer map contains completely.
void AddGround(BenchScene& scene, double half_side, int tiles) {
  const double side = 2.0 * half_side / tiles;
  for (int y = 0; y < tiles; ++y) {
    for (int x = 0; x < tiles; ++x) {
      scene.meshes.push_back(Quad({-half_side + x * side, -half_side + y * side, 0.0}, {side, 0, 0},
                                  {0, side, 0}, kGround));
    }
  }
}

void AddTree(BenchScene& scene, const TreeShape& shape) {
  scene.meshes.push_back(Trunk(shape, kWood));
  scene.meshes.push_back(Leaves(shape, {0.12F, 0.22F, 0.05F}));
}

}  // namespace

View LookAt(const glm::dvec3& eye, const glm::dvec3& target, double fov_rad, double aspect) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
  const glm::dvec3 down = glm::cross(forward, right);
  glm::dmat4 rows(1.0);
  rows[0] = glm::dvec4(right, -glm::dot(right, eye));
  rows[1] = glm::dvec4(down, -glm::dot(down, eye));
  rows[2] = glm::dvec4(forward, -glm::dot(forward, eye));
  View view;
  view.camera_from_marker = glm::transpose(rows);
  view.tan_left = view.tan_right = std::tan(0.5 * fov_rad);
  view.tan_up = view.tan_down = view.tan_left / aspect;
  return view;
}

BenchScene PoleAndBoxScene(double aspect) {
  BenchScene scene{"pole_and_box", "pole, box and boards", {}, ToSun(155, 48), {}, {}, {}};
  AddGround(scene, 8.0, 2);
  scene.meshes.push_back(Cuboid({-0.5, -0.3, 0}, {0.3, 0.3, 0.8}, kStone));
  scene.meshes.push_back(Cuboid({0.98, 0.18, 0}, {1.02, 0.22, 2.5}, kWood));
  // Boards 1.2 m deep whose southern edges have separate shadows. The sun is in the south.
  double y = -1.5;
  for (const double height : {0.25, 0.5, 1.0, 2.0}) {
    scene.meshes.push_back(Quad({1.8, y, height}, {1.0, 0, 0}, {0, 0.8, 0}, kStone));
    scene.edges.push_back({{2.3, y, height}, 0.4, -1.0});
    y += 1.0;
  }
  scene.contacts.push_back({{-0.1, 0.3, 0.0}, 0.3, 1.0});
  scene.view = LookAt({0.4, -4.2, 2.8}, {0.9, 0.7, 0.2}, 58 * kRadiansPerDegree, aspect);
  scene.view.near_m = 0.5;
  scene.view.far_m = 20.0;
  return scene;
}

BenchScene TreesScene(double aspect) {
  BenchScene scene{"trees", "trees, a body and a wall", {}, ToSun(215, 32), {}, {}, {}};
  AddGround(scene, 14.0, 4);
  AddTree(scene,
          {.foot = {-2.2, -1.6, 0.0}, .height = 4.6, .crown = 1.5, .leaves = 2600, .seed = 1});
  AddTree(scene,
          {.foot = {-5.5, 3.0, 0.0}, .height = 6.0, .crown = 1.9, .leaves = 2600, .seed = 2});
  AddTree(scene, {.foot = {4.6, 4.5, 0.0}, .height = 5.0, .crown = 1.6, .leaves = 2200, .seed = 3});
  for (BenchMesh& part : Body({0.3, 1.0, 0.0}, {0.4F, 0.38F, 0.36F})) {
    scene.meshes.push_back(std::move(part));
  }
  scene.meshes.push_back(Cuboid({-3.0, 2.6, 0}, {4.0, 2.8, 2.4}, kStone));
  scene.view = LookAt({1.6, -6.4, 2.2}, {-0.2, 1.2, 0.9}, 58 * kRadiansPerDegree, aspect);
  scene.view.near_m = 0.5;
  scene.view.far_m = 40.0;
  return scene;
}

BenchScene WideFieldScene(double aspect) {
  BenchScene scene{"wide_field", "a field: 1 m, 10 m, 200 m", {}, ToSun(230, 33), {}, {}, {}};
  AddGround(scene, 300.0, 8);
  // At 1 m: a pillar with a stick on top, and a rail.
  scene.meshes.push_back(Cuboid({-0.5, 0.5, 0}, {-0.1, 0.9, 1.25}, kStone));
  scene.meshes.push_back(Cuboid({-0.4, 0.58, 1.25}, {-0.385, 0.595, 1.55}, kWood));
  scene.meshes.push_back(Cuboid({0.25, 0.6, 0}, {0.28, 0.63, 1.2}, kWood));
  scene.meshes.push_back(Cuboid({0.25, 0.57, 1.2}, {0.8, 0.66, 1.23}, kWood));
  // At 10 m: a hut, a post and a tree.
  scene.meshes.push_back(Cuboid({-4.0, 9.5, 0}, {-1.5, 11.5, 2.2}, kStone));
  scene.meshes.push_back(Cuboid({1.0, 9.0, 0}, {1.1, 9.1, 3.0}, kWood));
  AddTree(scene,
          {.foot = {4.0, 11.0, 0.0}, .height = 4.5, .crown = 1.4, .leaves = 1500, .seed = 4});
  // At 40 m and 200 m: a barn, a row of towers and tall trees.
  scene.meshes.push_back(Cuboid({-22, 38, 0}, {-12, 46, 6}, kStone));
  for (int i = 0; i < 5; ++i) {
    const double x = -80.0 + 38.0 * i;
    scene.meshes.push_back(Cuboid({x, 190, 0}, {x + 12, 202, 14.0 + 5.0 * i}, kStone));
    AddTree(scene, {.foot = {x + 22.0, 170.0 + 4.0 * i, 0.0},
                    .height = 15.0,
                    .crown = 5.0,
                    .leaves = 500,
                    .leaf_m = 0.5,
                    .seed = 10 + i});
  }
  scene.view = LookAt({0.0, -0.6, 1.6}, {0.0, 4.0, 0.75}, 62 * kRadiansPerDegree, aspect);
  scene.view.near_m = 0.2;
  scene.view.far_m = 600.0;
  return scene;
}

}  // namespace pleinair::shadows
