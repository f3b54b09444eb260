#include "app/bench/antialiasing_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

namespace pleinair::app {
namespace {

using compositor::Material;
using compositor::Mesh;
using compositor::Model;
using compositor::PlacedModel;

constexpr std::array<std::string_view, 7> kSceneNames{"boards",    "rails", "leaves", "poles_near",
                                                      "poles_far", "torus", "floor"};
constexpr double kCreep_px = 0.1;

std::array<float, 3> Floats(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A quadrilateral that faces along u × v, with texture coordinates from 0 to `repeats`.
void AddFace(Vec3 origin, Vec3 u, Vec3 v, Mesh* mesh, float repeats = 1.0F) {
  const auto normal = Floats(Normalized(Cross(u, v)));
  const auto first = static_cast<std::uint32_t>(mesh->positions.size());
  for (const Vec3 p : {origin, origin + u, origin + u + v, origin + v}) {
    mesh->positions.push_back(Floats(p));
    mesh->normals.push_back(normal);
  }
  for (const auto& uv :
       {std::array<float, 2>{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}}) {
    mesh->uvs.push_back(uv);
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh->indices.push_back(first + i);
}

/// A box with three edges from one corner, right-handed.
void AddBox(Vec3 origin, Vec3 u, Vec3 v, Vec3 w, Mesh* mesh) {
  AddFace(origin + w, u, v, mesh);
  AddFace(origin, v, u, mesh);
  AddFace(origin, u, w, mesh);
  AddFace(origin + u, v, w, mesh);
  AddFace(origin + u + v, u * -1.0, w, mesh);
  AddFace(origin + v, v * -1.0, w, mesh);
}

PlacedModel Placed(Mesh mesh, Material material, bool is_phantom,
                   std::vector<Image<std::uint8_t>> textures = {}) {
  auto model = std::make_shared<Model>();
  model->materials.push_back(std::move(material));
  model->meshes.push_back(std::move(mesh));
  model->textures = std::move(textures);
  return {std::move(model), Mat3{}, {}, is_phantom};
}

Material Even(float albedo) {
  Material material;
  material.base_color = {albedo, albedo, albedo};
  return material;
}

Material White() {
  Material material = Even(1.0F);
  material.detail.unlit = true;
  return material;
}

PlacedModel Ground(double half_m) {
  Mesh mesh;
  AddFace({-half_m, -half_m, 0}, {2 * half_m, 0, 0}, {0, 2 * half_m, 0}, &mesh);
  return Placed(std::move(mesh), Even(0.3F), true);
}

/// A camera whose x axis is level.
Transform<Camera, Marker> LookAt(Vec3 eye, Vec3 target) {
  const Vec3 forward = Normalized(target - eye);
  const Vec3 right = Normalized(Cross(forward, {0, 0, 1}));
  const Vec3 down = Cross(forward, right);
  const Mat3 rotation{right.x, right.y,   right.z,   down.x,   down.y,
                      down.z,  forward.x, forward.y, forward.z};
  return {rotation, -(rotation * eye)};
}

// All scenes of boards and bars are 4 m in front of a camera that looks north.
constexpr double kDistance_m = 4.0;
const Vec3 kEye{0, 0, 1.5};

Vec3 InView(double x_px, double y_px, double depth_m, const CameraModel& camera) {
  return kEye + Vec3{(x_px - camera.cx) / camera.fx * depth_m, depth_m,
                     -(y_px - camera.cy) / camera.fy * depth_m};
}

/// Uniform random numbers, the same with every standard library.
class UniformNumbers {
 public:
  explicit UniformNumbers(unsigned seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }

 private:
  std::mt19937 random_;
};

PlacedModel Boards(const CameraModel& camera) {
  UniformNumbers uniform(7);
  Mesh mesh;
  for (int i = 0; i < 24; ++i) {
    const double angle = uniform(0, std::numbers::pi), tilt = uniform(-0.6, 0.6);
    const double metres_px = kDistance_m / camera.fx;
    const double length = uniform(0.15, 0.35) * camera.width * metres_px;
    const double width = uniform(0.015, 0.06) * camera.width * metres_px;
    const Vec3 along{std::cos(angle), std::sin(tilt) * 0.4, std::sin(angle)};
    const Vec3 u = Normalized(along) * length;
    const Vec3 v = Normalized(Cross({0, 1, 0}, u)) * width;
    const Vec3 w = Normalized(Cross(u, v)) * (0.2 * width);
    const double x_px = uniform(0.1, 0.9) * camera.width, y_px = uniform(0.1, 0.9) * camera.height;
    const Vec3 middle = InView(x_px, y_px, kDistance_m + uniform(-0.5, 0.5), camera);
    AddBox(middle - (u + v) * 0.5, u, v, w, &mesh);
  }
  return Placed(std::move(mesh), White(), false);
}

PlacedModel Rails(const CameraModel& camera) {
  constexpr std::array<double, 12> kWidths_px{0.1,  0.15, 0.2, 0.28, 0.35, 0.5,
                                              0.65, 0.8,  0.9, 1.2,  1.5,  2.0};
  const double metres_px = kDistance_m / camera.fx;
  Mesh mesh;
  for (std::size_t i = 0; i < kWidths_px.size(); ++i) {
    const double share = (static_cast<double>(i) + 0.5) / kWidths_px.size();
    const double width = kWidths_px[i] * metres_px;
    // Nearly level, then nearly upright.
    const Vec3 u =
        InView(0.95 * camera.width, (0.9 * share + 0.06) * camera.height, kDistance_m, camera) -
        InView(0.05 * camera.width, 0.9 * share * camera.height, kDistance_m, camera);
    const Vec3 v =
        InView((0.9 * share + 0.06) * camera.width, 0.95 * camera.height, kDistance_m, camera) -
        InView(0.9 * share * camera.width, 0.05 * camera.height, kDistance_m, camera);
    const Vec3 across_u = Normalized(Cross(u, {0, 1, 0})) * width;
    const Vec3 across_v = Normalized(Cross(v, {0, 1, 0})) * width;
    AddFace(InView(0.05 * camera.width, 0.9 * share * camera.height, kDistance_m, camera), u,
            across_u, &mesh);
    AddFace(InView(0.9 * share * camera.width, 0.05 * camera.height, kDistance_m, camera), v,
            across_v, &mesh);
  }
  return Placed(std::move(mesh), White(), false);
}

/// A disc with five notches; alpha is 0 outside.
Image<std::uint8_t> LeafTexture() {
  constexpr int kSide = 128;
  Image<std::uint8_t> texture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double u = (x + 0.5) / kSide * 2 - 1, v = (y + 0.5) / kSide * 2 - 1;
      const double edge = 0.95 - 0.45 * std::pow(std::abs(std::cos(2.5 * std::atan2(v, u))), 6.0);
      const double inside = (edge - std::hypot(u, v)) * kSide / 2 + 0.5;
      for (int c = 0; c < 3; ++c) texture(x, y, c) = 255;
      texture(x, y, 3) = static_cast<std::uint8_t>(std::lround(255 * std::clamp(inside, 0.0, 1.0)));
    }
  }
  return texture;
}

PlacedModel LeavesOfTwig(const CameraModel& camera) {
  UniformNumbers uniform(11);
  Mesh mesh;
  for (int i = 0; i < 60; ++i) {
    const double side = uniform(0.03, 0.09) * camera.width * kDistance_m / camera.fx;
    const double angle = uniform(0, 2 * std::numbers::pi), tilt = uniform(-0.8, 0.8);
    const Vec3 u{std::cos(angle) * side, std::sin(tilt) * side * 0.5, std::sin(angle) * side};
    const Vec3 v = Normalized(Cross({0, 1, 0}, u)) * side;
    const double x_px = uniform(0.15, 0.85) * camera.width;
    const double y_px = uniform(0.15, 0.85) * camera.height;
    AddFace(InView(x_px, y_px, kDistance_m + uniform(-0.5, 0.5), camera), u, v, &mesh);
  }
  Material material = White();
  material.base_color_texture = 0;
  material.alpha = Material::Alpha::kCutout;
  return Placed(std::move(mesh), material, false, {LeafTexture()});
}

PlacedModel Poles() {
  Mesh mesh;
  for (int i = -3; i <= 3; ++i) {
    constexpr double kSide_m = 0.02;
    const double turn = 0.3 * i;
    const Vec3 u{kSide_m * std::cos(turn), kSide_m * std::sin(turn), 0};
    const Vec3 v{-kSide_m * std::sin(turn), kSide_m * std::cos(turn), 0};
    AddBox({0.3 * i, 0.05 * i, 0.001}, u, v, {0.02 * i, 0, 0.9}, &mesh);
  }
  return Placed(std::move(mesh), Even(0.5F), false);
}

PlacedModel Torus() {
  constexpr int kAround = 64, kAcross = 32;
  constexpr double kRing_m = 0.5, kTube_m = 0.18;
  Mesh mesh;
  for (int i = 0; i <= kAround; ++i) {
    const double a = 2 * std::numbers::pi * i / kAround;
    for (int j = 0; j <= kAcross; ++j) {
      const double b = 2 * std::numbers::pi * j / kAcross;
      const Vec3 normal{std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)};
      mesh.positions.push_back(Floats(
          Vec3{kRing_m * std::cos(a), kRing_m * std::sin(a), kTube_m + 0.001} + normal * kTube_m));
      mesh.normals.push_back(Floats(normal));
      mesh.uvs.push_back({0, 0});
      if (i == kAround || j == kAcross) continue;
      const auto at = static_cast<std::uint32_t>(i * (kAcross + 1) + j), next = at + kAcross + 1;
      for (const std::uint32_t k : {at, next, at + 1, at + 1, next, next + 1}) {
        mesh.indices.push_back(k);
      }
    }
  }
  Material material = Even(0.4F);
  material.roughness = 0.2F;
  material.coat.f0 = compositor::kDielectricF0;
  return Placed(std::move(mesh), material, false);
}

/// The floor of Figure 6 of Chiu, Chen, Chang & Lee: Subpixel reconstruction antialiasing for ray
/// tracing (WSCG 2012).
PlacedModel Floor() {
  constexpr int kSide = 64, kSquares = 4;
  Image<std::uint8_t> texture(kSide, kSide, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool is_dark = (x * kSquares / kSide + y * kSquares / kSide) % 2 != 0;
      for (int c = 0; c < 3; ++c) texture(x, y, c) = is_dark ? 60 : 220;
    }
  }
  Mesh mesh;
  AddFace({-20, -2, 0.001}, {40, 0, 0}, {0, 40, 0}, &mesh, 20.0F);
  Material material = Even(0.8F);
  material.alpha = Material::Alpha::kIgnored;
  material.base_color_texture = 0;
  return Placed(std::move(mesh), material, false, {texture});
}

}  // namespace

std::span<const std::string_view> AntialiasingSceneNames() { return kSceneNames; }

AntialiasingScene MakeAntialiasingScene(std::string_view name, const CameraModel& camera) {
  AntialiasingScene scene;
  scene.name = name;
  Vec3 eye = kEye, target = kEye + Vec3{0, kDistance_m, 0};
  if (name == "boards") scene.models = {Boards(camera)};
  if (name == "rails") scene.models = {Rails(camera)};
  if (name == "leaves") scene.models = {LeavesOfTwig(camera)};
  if (name == "poles_near" || name == "poles_far") {
    scene.models = {Ground(40.0), Poles()};
    const double away = name == "poles_near" ? 1.0 : 4.0;
    eye = Vec3{0.7, -1.6, 1.2} * away;
    target = {0, 0.3, 0.2};
    scene.background = 128;
  }
  if (name == "torus") {
    scene.models = {Ground(40.0), Torus()};
    eye = {0.9, -2.2, 1.4};
    target = {0, 0, 0.1};
    scene.background = 128;
  }
  if (name == "floor") {
    scene.models = {Floor()};
    eye = {0.3, -1.5, 0.8};
    target = {0, 8, 0};
  }
  scene.camera_from_marker = LookAt(eye, target);
  scene.creep_m = kCreep_px * Norm(target - eye) / camera.fx;
  return scene;
}

std::vector<PlacedModel> CoverageModels(const AntialiasingScene& scene) {
  std::vector<PlacedModel> objects;
  for (const PlacedModel& placed : scene.models) {
    if (placed.is_phantom) continue;
    auto model = std::make_shared<Model>(*placed.model);
    for (Material& material : model->materials) {
      material.detail.unlit = true;
      material.base_color = {1, 1, 1};
      if (material.alpha == Material::Alpha::kIgnored) material.base_color_texture = -1;
    }
    objects.push_back(placed);
    objects.back().model = std::move(model);
  }
  return objects;
}

}  // namespace pleinair::app
