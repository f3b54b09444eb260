#pragma once

// Shapes whose meshes are hard to light: coarse, buried, overlapping, split or turned inside out.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/vector.h"
#include "compositor/models/mesh_normals.h"
#include "compositor/models/model.h"

namespace pleinair::compositor::testing {

/// Vertices and triangles, one unit large; models have one or more.
struct Shape {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  Shape Placed(Vec3 at, double scale) const {
    Shape placed = *this;
    for (Vec3& point : placed.points) point = at + point * scale;
    return placed;
  }
  Shape InsideOut() const {
    Shape turned = *this;
    for (auto& triangle : turned.triangles) std::swap(triangle[1], triangle[2]);
    return turned;
  }
  /// No two triangles share a vertex.
  Shape Unshared() const {
    Shape split;
    for (const auto& triangle : triangles) {
      const auto first = static_cast<std::uint32_t>(split.points.size());
      for (const std::uint32_t corner : triangle) split.points.push_back(points[corner]);
      split.triangles.push_back({first, first + 1, first + 2});
    }
    return split;
  }
};

/// A box between two corners, twelve triangles.
inline Shape Box(Vec3 low, Vec3 high) {
  Shape box;
  for (int i = 0; i < 8; ++i) {
    box.points.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                          (i & 4) != 0 ? high.z : low.z});
  }
  constexpr std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    box.triangles.push_back({f[0], f[1], f[2]});
    box.triangles.push_back({f[0], f[2], f[3]});
  }
  return box;
}

/// A sphere of radius 1: an icosahedron, each triangle divided into four `level` times.
inline Shape Icosphere(int level) {
  constexpr double t = std::numbers::phi;
  Shape sphere{{{-1, t, 0},
                {1, t, 0},
                {-1, -t, 0},
                {1, -t, 0},
                {0, -1, t},
                {0, 1, t},
                {0, -1, -t},
                {0, 1, -t},
                {t, 0, -1},
                {t, 0, 1},
                {-t, 0, -1},
                {-t, 0, 1}},
               {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3& point : sphere.points) point = Normalized(point);
  for (; level > 0; --level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(sphere.points.size()));
      if (is_new) sphere.points.push_back(Normalized(sphere.points[a] + sphere.points[b]));
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
      const std::uint32_t x = middle(a, b), y = middle(b, c), z = middle(c, a);
      finer.insert(finer.end(), {{a, x, z}, {x, b, y}, {z, y, c}, {x, y, z}});
    }
    sphere.triangles = std::move(finer);
  }
  return sphere;
}

/// An open sheet: `profile` (radius, height) turned about the vertical axis in `count` steps.
inline Shape Lathe(const std::vector<std::array<double, 2>>& profile, std::uint32_t count) {
  Shape sheet;
  for (const auto& [radius, height] : profile) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / count;
      sheet.points.push_back({radius * std::cos(turn), radius * std::sin(turn), height});
    }
  }
  for (std::uint32_t k = 0; k + 1 < profile.size(); ++k) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = k * count + i, b = k * count + (i + 1) % count;
      if (profile[k][0] > 0.0) sheet.triangles.push_back({a, b, b + count});
      if (profile[k + 1][0] > 0.0) sheet.triangles.push_back({a, b + count, a + count});
    }
  }
  return sheet;
}

/// A torus about the z axis: ring radius 1, tube radius 0.45, about `faces` triangles.
inline Shape Torus(double faces) {
  constexpr double kTube = 0.45;
  const auto around = static_cast<std::uint32_t>(std::lround(std::sqrt(faces * 1.25)));
  const auto across = static_cast<std::uint32_t>(std::lround(faces / (2.0 * around)));
  Shape ring;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double turn = 2.0 * std::numbers::pi * i / around;
      const double tube = 2.0 * std::numbers::pi * k / across;
      const double radius = 1.0 + kTube * std::cos(tube);
      ring.points.push_back(
          {radius * std::cos(turn), radius * std::sin(turn), kTube * std::sin(tube)});
      const std::uint32_t next = (i + 1) % around, beside = (k + 1) % across;
      const std::uint32_t a = i * across + k, b = next * across + k, c = next * across + beside,
                          d = i * across + beside;
      ring.triangles.insert(ring.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  return ring;
}

/// Loose leaves in a ball of radius 1: `leaves` rhombs of two triangles, evenly distributed, any
/// way up. Their area is four times that of the ball's shadow.
inline Shape Crown(std::uint32_t leaves) {
  const double half = 2.0 * std::sqrt(std::numbers::pi / leaves);  // Half of a leaf's length.
  Shape crown;
  for (std::uint32_t i = 0; i < leaves; ++i) {
    // Additive recurrence in five dimensions, by the powers of the root of x⁶ = x + 1.
    std::array<double, 5> u{};
    for (int k = 0; k < 5; ++k) {
      const double next = (i + 0.5) * std::pow(1.0 / 1.1347241384015194, k + 1);
      u[k] = next - std::floor(next);
    }
    const auto along = [](double height, double turn) {
      const double flat = std::sqrt(1.0 - height * height);
      return Vec3{flat * std::cos(2.0 * std::numbers::pi * turn),
                  flat * std::sin(2.0 * std::numbers::pi * turn), height};
    };
    const Vec3 centre = along(2.0 * u[0] - 1.0, u[1]) * std::cbrt(u[2]);
    const Vec3 normal = along(2.0 * u[3] - 1.0, u[4]);
    const Vec3 side = Normalized(Cross(normal, along(0.0, u[1])));
    const Vec3 length = Cross(side, normal) * half, width = side * (0.5 * half);
    const auto first = static_cast<std::uint32_t>(crown.points.size());
    crown.points.insert(crown.points.end(),
                        {centre - length, centre + width, centre + length, centre - width});
    crown.triangles.insert(crown.triangles.end(),
                           {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  }
  return crown;
}

inline std::shared_ptr<Model> ModelOf(std::span<const Shape> shapes, NormalsMode normals) {
  auto model = std::make_shared<Model>();
  model->materials.push_back({});
  model->materials[0].base_color = {0.55F, 0.5F, 0.45F};
  Mesh mesh;
  for (const Shape& shape : shapes) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : shape.points) {
      mesh.positions.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    for (const auto& triangle : shape.triangles) {
      for (const std::uint32_t corner : triangle) mesh.indices.push_back(first + corner);
    }
  }
  model->meshes.push_back(std::move(mesh));
  ApplyNormals(normals, model.get());
  return model;
}

struct NamedModel {
  std::string name;
  std::shared_ptr<const Model> model;
};

/// About 20 cm large, standing on the ground at the origin.
inline std::vector<NamedModel> HardShapes() {
  constexpr NormalsMode kSmooth = NormalsMode::kSmooth, kFlat = NormalsMode::kFlat;
  std::vector<NamedModel> models;
  const auto add = [&](const char* name, NormalsMode normals, std::vector<Shape> shapes,
                       double scale) {
    for (Shape& shape : shapes) shape = shape.Placed({0.0, 0.0, 0.001}, scale);
    models.push_back({name, ModelOf(shapes, normals)});
  };
  const Shape ball = Icosphere(1).Placed({0.0, 0.0, 1.0}, 1.0);
  add("cube", kFlat, {Box({-1, -1, 0}, {1, 1, 2})}, 0.08);
  add("sphere of 80 faces", kSmooth, {ball}, 0.09);
  add("inside out", kSmooth, {ball.InsideOut()}, 0.09);
  add("no shared vertices", kSmooth, {ball.Unshared()}, 0.09);
  add("slivers", kSmooth, {Lathe({{0.5, 0}, {0.5, 2}}, 48), Lathe({{0.5, 2}, {0, 2}}, 48)}, 0.09);
  add("overlapping parts", kFlat,
      {Box({-1, -1, 0}, {0.4, 0.4, 1.2}), Box({-0.3, -0.3, 0.5}, {1, 1, 1.8}),
       Icosphere(1).Placed({0.3, -0.5, 0.3}, 0.7)},
      0.09);
  add("bowl in a box", kFlat,
      {Box({-1, -1, 0}, {1, 1, 0.1}), Box({-1, -1, 0}, {-0.9, 1, 0.7}),
       Box({0.9, -1, 0}, {1, 1, 0.7}), Box({-1, -1, 0}, {1, -0.9, 0.7}),
       Box({-1, 0.9, 0}, {1, 1, 0.7}),
       Lathe({{0, -0.02}, {0.3, 0}, {0.6, 0.15}, {0.8, 0.5}, {0.85, 0.9}}, 10)},
      0.09);
  add("lid on a pot", kSmooth,
      {Lathe({{0, 0}, {0.6, 0}, {0.9, 0.3}, {1, 0.7}, {0.9, 1.1}, {0.7, 1.25}}, 14),
       Lathe({{0, 1.12}, {0.5, 1.15}, {0.78, 1.22}, {0.5, 1.35}, {0.15, 1.43}, {0, 1.45}}, 14),
       Icosphere(1).Placed({0, 0, 1.5}, 0.14)},
      0.09);
  return models;
}

}  // namespace pleinair::compositor::testing
