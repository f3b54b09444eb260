#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "shadows/bench/bench_scene.h"

namespace pleinair::shadows {

BenchMesh Quad(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b,
               const glm::vec3& albedo);
BenchMesh Cuboid(const glm::dvec3& low, const glm::dvec3& high, const glm::vec3& albedo);
BenchMesh Ellipsoid(const glm::dvec3& centre, const glm::dvec3& radii, const glm::vec3& albedo);

/// A trunk with a few branches and a crown of separate leaves; deterministic for a seed.
struct TreeShape {
  glm::dvec3 foot{0.0};
  double height = 5.0;
  double crown = 1.5;  ///< Radius of the crown.
  int leaves = 2000;
  double leaf_m = 0.11;  ///< Length of a leaf; it is half as wide.
  int seed = 1;
};
BenchMesh Trunk(const TreeShape& tree, const glm::vec3& albedo);
BenchMesh Leaves(const TreeShape& tree, const glm::vec3& albedo);

/// A four-legged body with head and ears, 1.6 m long, facing −x.
std::vector<BenchMesh> Body(const glm::dvec3& foot, const glm::vec3& albedo);

}  // namespace pleinair::shadows
