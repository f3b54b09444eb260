#include "shadows/bench/mesh_shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace pleinair::shadows {
namespace {

// Uniform random numbers in 0…1, the same on every machine (unlike std::uniform_real_distribution).
class Numbers {
 public:
  explicit Numbers(int seed) : engine_(static_cast<unsigned>(seed)) {}
  double Next() { return static_cast<double>(engine_()) / 4294967296.0; }
  glm::dvec3 Direction() {
    const double z = 2.0 * Next() - 1.0, angle = 2.0 * std::numbers::pi * Next();
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937 engine_;
};

void AppendQuad(BenchMesh& mesh, const glm::dvec3& corner, const glm::dvec3& a,
                const glm::dvec3& b) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec3& p : {corner, corner + a, corner + a + b, corner + b}) {
    mesh.positions.emplace_back(p);
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + i);
}

// A straight limb with a square cross-section that tapers towards its end.
void AppendLimb(BenchMesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double radius,
                double end_radius) {
  const glm::dvec3 along = glm::normalize(to - from);
  const glm::dvec3 side = glm::normalize(
      glm::cross(along, std::abs(along.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 other = glm::cross(along, side);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& [point, r] : {std::pair{from, radius}, std::pair{to, end_radius}}) {
    for (int i = 0; i < 8; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 8.0;
      mesh.positions.emplace_back(point + r * (std::cos(angle) * side + std::sin(angle) * other));
    }
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t j = (i + 1) % 8;
    for (const std::uint32_t k : {i, j, j + 8, i, j + 8, i + 8}) mesh.indices.push_back(first + k);
  }
}

}  // namespace

BenchMesh Quad(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b,
               const glm::vec3& albedo) {
  BenchMesh mesh{{}, {}, albedo};
  AppendQuad(mesh, corner, a, b);
  return mesh;
}

BenchMesh Cuboid(const glm::dvec3& low, const glm::dvec3& high, const glm::vec3& albedo) {
  BenchMesh mesh{{}, {}, albedo};
  const glm::dvec3 d = high - low;
  const glm::dvec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  AppendQuad(mesh, low, y, x);
  AppendQuad(mesh, low + z, x, y);
  AppendQuad(mesh, low, x, z);
  AppendQuad(mesh, low + y, z, x);
  AppendQuad(mesh, low, z, y);
  AppendQuad(mesh, low + x, y, z);
  return mesh;
}

BenchMesh Ellipsoid(const glm::dvec3& centre, const glm::dvec3& radii, const glm::vec3& albedo) {
  constexpr int kRings = 12, kSectors = 24;
  BenchMesh mesh{{}, {}, albedo};
  for (int ring = 0; ring <= kRings; ++ring) {
    const double polar = std::numbers::pi * ring / kRings;
    for (int sector = 0; sector <= kSectors; ++sector) {
      const double angle = 2.0 * std::numbers::pi * sector / kSectors;
      const glm::dvec3 d(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                         std::cos(polar));
      mesh.positions.emplace_back(centre + radii * d);
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      const std::uint32_t a = ring * (kSectors + 1) + sector, b = a + kSectors + 1;
      for (const std::uint32_t i : {a, b, a + 1, a + 1, b, b + 1}) mesh.indices.push_back(i);
    }
  }
  return mesh;
}

BenchMesh Trunk(const TreeShape& tree, const glm::vec3& albedo) {
  BenchMesh mesh{{}, {}, albedo};
  Numbers numbers(tree.seed);
  const glm::dvec3 fork = tree.foot + glm::dvec3(0, 0, tree.height - 1.6 * tree.crown);
  const double radius = 0.025 * tree.height;
  AppendLimb(mesh, tree.foot, fork, radius, 0.7 * radius);
  for (int i = 0; i < 7; ++i) {
    glm::dvec3 d = numbers.Direction();
    d.z = 0.5 + 0.5 * std::abs(d.z);
    AppendLimb(mesh, fork, fork + 1.1 * tree.crown * d, 0.4 * radius, 0.1 * radius);
  }
  return mesh;
}

BenchMesh Leaves(const TreeShape& tree, const glm::vec3& albedo) {
  BenchMesh mesh{{}, {}, albedo, true};
  Numbers numbers(1000 + tree.seed);
  const glm::dvec3 centre = tree.foot + glm::dvec3(0, 0, tree.height - tree.crown);
  for (int i = 0; i < tree.leaves; ++i) {
    // Denser towards the surface of the crown.
    const double r = tree.crown * std::pow(numbers.Next(), 0.25);
    const glm::dvec3 place = centre + r * numbers.Direction() * glm::dvec3(1.0, 1.0, 0.8);
    const glm::dvec3 along = numbers.Direction();
    const glm::dvec3 across = glm::normalize(glm::cross(along, numbers.Direction()));
    const glm::dvec3 a = tree.leaf_m * along, b = 0.5 * tree.leaf_m * across;
    AppendQuad(mesh, place - 0.5 * (a + b), a, b);
  }
  return mesh;
}

std::vector<BenchMesh> Body(const glm::dvec3& foot, const glm::vec3& albedo) {
  std::vector<BenchMesh> parts;
  parts.push_back(Ellipsoid(foot + glm::dvec3(0, 0, 0.85), {0.75, 0.42, 0.45}, albedo));
  parts.push_back(Ellipsoid(foot + glm::dvec3(-0.85, 0, 1.05), {0.32, 0.27, 0.3}, albedo));
  for (const double side : {-1.0, 1.0}) {
    parts.push_back(
        Ellipsoid(foot + glm::dvec3(-0.72, 0.33 * side, 1.08), {0.06, 0.2, 0.24}, albedo));
    for (const double x : {-0.45, 0.45}) {
      const glm::dvec3 at = foot + glm::dvec3(x, 0.24 * side, 0.0);
      parts.push_back(Ellipsoid(at + glm::dvec3(0, 0, 0.35), {0.13, 0.13, 0.42}, albedo));
    }
  }
  BenchMesh trunk{{}, {}, albedo};
  AppendLimb(trunk, foot + glm::dvec3(-1.1, 0, 1.0), foot + glm::dvec3(-1.3, 0, 0.25), 0.1, 0.05);
  parts.push_back(std::move(trunk));
  return parts;
}

}  // namespace pleinair::shadows
