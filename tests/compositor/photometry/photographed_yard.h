#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "base/camera_response.h"
#include "compositor/light/light_solver.h"
#include "compositor/light/sampling.h"
#include "compositor/light/scaled_sky.h"
#include "scene/marker_reflectance.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor::testing {

/// A yard with a wall, a pole and a step on patterned paving, and photographs of it by an 8-bit
/// camera. The light is adjustable: sky, indirect illumination and the sun's disc.
class PhotographedYard {
 public:
  /// `to_sun`: in marker coordinates.
  explicit PhotographedYard(Vec3 to_sun = {-0.55, -0.6, 0.62}, LinearRgb sky = {3000, 4200, 6500},
                            const Mat3& marker_from_world = {})
      : marker_from_world_(marker_from_world),
        model_(sky, {62e3, 55e3, 44e3}, marker_from_world.Transposed() * to_sun),
        solver_(*LightSolver::Create(Phantoms(), {.rays_per_vertex = 128, .near_edge_m = 0.1})),
        sky_(solver_->Solve(ScaledSky(model_, {1, 1, 1}, {}), marker_from_world)),
        sun_(solver_->Solve(ScaledSky(model_, {}, {1, 1, 1}), marker_from_world)) {
    for (std::size_t m = 0; m < sky_.size(); ++m) {
      for (std::size_t i = 0; i < sky_[m].positions.size(); ++i) {
        const auto& p = sky_[m].positions[i];
        vertices_[Bin({p[0], p[1], p[2]})].push_back({m, i});
      }
    }
  }

  static std::vector<PlacedModel> Phantoms() {
    return {Phantom(Ground(5.0, {0.35F, 0.33F, 0.30F})),
            Phantom(BoxModel({-3.0, 1.2, 0.0}, {3.0, 1.4, 1.2}, {0.35F, 0.20F, 0.15F})),
            Phantom(BoxModel({0.9, -0.9, 0.0}, {0.98, -0.82, 2.2}, {0.25F, 0.25F, 0.25F})),
            Phantom(BoxModel({-1.4, 0.3, 0.0}, {-0.5, 0.8, 0.3}, {0.4F, 0.4F, 0.38F}))};
  }

  /// The prior of the day; estimates are relative to this model.
  const sky::SkyModel& model() const { return model_; }
  const Mat3& marker_from_world() const { return marker_from_world_; }
  Vec3 ToSun() const { return marker_from_world_ * model_.ToSun().xyz; }
  const PhantomRays& phantoms() const { return solver_->phantoms(); }
  const CameraModel& camera() const { return camera_; }
  const scene::MarkerReflectance& marker() const { return marker_; }

  /// True if the point is near a phantom shadow edge, on either side.
  bool IsBesideShadowEdge(Vec3 p) const {
    bool lit = false, shaded = false;
    for (const double reach : {0.0, 0.06, 0.12, 0.2, 0.3, 0.4}) {
      for (int i = 0; i < 12; ++i) {
        const double angle = 2 * std::numbers::pi * i / 12;
        const Vec3 beside =
            p + Vec3{reach * std::cos(angle), reach * std::sin(angle), i % 2 * reach + 1e-3};
        (phantoms().IsUnoccluded({beside}, ToSun()) ? lit : shaded) = true;
      }
    }
    return lit && shaded;
  }

  struct Light {
    LinearRgb sky_radiance_scale{1.0, 1.0, 1.0};
    double sun_scale = 1.0;
    double exposure = 1.0;  ///< Times kExposureScale.
    /// True where an unmodelled object shades the point.
    std::function<bool(Vec3)> shaded = [](Vec3) { return false; };
    /// If true, surfaces have the model's colors and the marker its white. Otherwise all have the
    /// same patterned color.
    bool colors_as_described = false;
    /// Factor on the reflectance at a point.
    std::function<double(Vec3)> brighter = [](Vec3) { return 1.0; };
  };

  /// Camera pose of image 0, 1, …
  static Transform<Camera, Marker> Pose(int picture) {
    const Vec3 eye{-0.8 + 0.5 * picture, -2.6, 1.7 + 0.1 * picture};
    const Vec3 forward = Normalized(Vec3{0.1, 0.4, 0.1} - eye);
    const Vec3 right = Normalized(Cross(forward, {0, 0, 1}));
    const Vec3 down = Cross(forward, right);
    const Mat3 rotation{
        {right.x, right.y, right.z, down.x, down.y, down.z, forward.x, forward.y, forward.z}};
    return {rotation, -(rotation * eye)};
  }

  RgbImage Photograph(int picture, const Light& light, const CameraResponse& response = {}) const {
    const auto marker_from_camera = Pose(picture).Inverse();
    const TangentFrame sun(ToSun());
    RgbImage image(camera_.width, camera_.height, 3);
    for (int y = 0; y < camera_.height; ++y) {
      for (int x = 0; x < camera_.width; ++x) {
        const Vec2 ray = UndistortPixel(camera_, {static_cast<double>(x), static_cast<double>(y)});
        const auto seen =
            phantoms().First({marker_from_camera.translation_m},
                             Normalized(marker_from_camera.rotation * Vec3{ray.x, ray.y, 1}));
        if (!seen) continue;
        const LinearRgb e = Irradiance(*seen, light, sun);
        const LinearRgb albedo = (light.colors_as_described ? StatedAlbedo(*seen) : Albedo(*seen)) *
                                 light.brighter(seen->point.xyz);
        const LinearRgb radiance = e * albedo * (light.exposure / std::numbers::pi);
        image(x, y, 0) = response.Encoded8(radiance.r * kExposureScale, 0);
        image(x, y, 1) = response.Encoded8(radiance.g * kExposureScale, 1);
        image(x, y, 2) = response.Encoded8(radiance.b * kExposureScale, 2);
      }
    }
    return image;
  }

  /// Linear value per radiance.
  static constexpr double kExposureScale = 2.0e-5;

 private:
  static std::array<int, 3> Bin(Vec3 p) {
    const auto step = [](double v) { return static_cast<int>(std::floor(v / 0.25)); };
    return {step(p.x), step(p.y), step(p.z)};
  }

  /// Slabs of 0.4 m in different greys, with finer mottling.
  static LinearRgb Albedo(const PhantomSurface& at) {
    const auto tile = [&](double size) {
      const auto step = [&](double v) {
        return static_cast<std::uint32_t>(static_cast<int>(std::floor(v / size + 0.37)) + 1000);
      };
      return UnitFromHash(
          Hash(Hash(step(at.point.xyz.x), step(at.point.xyz.y)), step(at.point.xyz.z)));
    };
    const double grey = 0.25 + 0.12 * tile(0.4) + 0.08 * tile(0.03);
    return {grey, 0.95 * grey, 0.85 * grey};
  }

  LinearRgb StatedAlbedo(const PhantomSurface& at) const {
    const Vec3 p = at.point.xyz;
    const bool on_marker =
        std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) < marker_.board_size_m / 2;
    return on_marker ? LinearRgb{1, 1, 1} * marker_.albedo_white : at.albedo;
  }

  LinearRgb Irradiance(const PhantomSurface& at, const Light& light,
                       const TangentFrame& sun) const {
    // Ambient light of the nearest vertex with a similar normal.
    const auto bin = Bin(at.point.xyz);
    double least = 1e9;
    LinearRgb ambient;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found = vertices_.find({bin[0] + dx, bin[1] + dy, bin[2] + dz});
          if (found == vertices_.end()) continue;
          for (const auto& [m, i] : found->second) {
            const auto& n = sky_[m].normals[i];
            if (Dot({n[0], n[1], n[2]}, at.normal) < 0.9) continue;
            const auto& p = sky_[m].positions[i];
            const double distance = Norm(Vec3{p[0], p[1], p[2]} - at.point.xyz);
            if (distance >= least) continue;
            least = distance;
            const auto& s = sky_[m].ambient_without[i];
            const auto& b = sun_[m].ambient_without[i];
            ambient = LinearRgb{s[0], s[1], s[2]} * light.sky_radiance_scale +
                      LinearRgb{b[0], b[1], b[2]} * light.sun_scale;
          }
        }
      }
    }
    const double cosine = std::max(0.0, Dot(at.normal, sun.normal));
    if (cosine == 0.0 || light.sun_scale == 0.0 || light.shaded(at.point.xyz)) return ambient;
    constexpr int kRays = 12;
    int sun_visible = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
      sun_visible +=
          phantoms().IsUnoccluded(at.point, SunDiscDirection(sun, ShiftedHammersley(i, kRays, 1)))
              ? 1
              : 0;
    }
    return ambient +
           model_.SunNormalIrradiance() * (light.sun_scale * cosine * sun_visible / kRays);
  }

  Mat3 marker_from_world_;
  UniformDay model_;
  std::unique_ptr<LightSolver> solver_;
  std::vector<LitMesh> sky_, sun_;
  std::map<std::array<int, 3>, std::vector<std::pair<std::size_t, std::size_t>>> vertices_;
  CameraModel camera_{.width = 400, .height = 300, .fx = 330, .fy = 330, .cx = 200, .cy = 150};
  scene::MarkerReflectance marker_{.size_m = 0.2, .board_size_m = 0.25, .black_band_m = 0.02};
};

}  // namespace pleinair::compositor::testing
