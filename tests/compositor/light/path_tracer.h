#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/models/model.h"
#include "sky/sky_model.h"

namespace pleinair::compositor::testing {

/// A textbook path tracer (Kajiya 1986, "The Rendering Equation") for diffuse models with one color
/// per material. It is an independent reference: it shares only models and Embree with the code
/// under test. Russian roulette ends each path. The path samples the sun at each surface and the
/// sky where it leaves the scene. Surfaces are two-sided, and may transmit diffusely. The marker
/// and world frames coincide.
class PathTracer {
 public:
  PathTracer(const std::vector<const Model*>& models, const sky::SkyModel& day)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())), day_(day) {
    for (const Model* model : models) {
      for (const Mesh& mesh : model->meshes) {
        const Material& material = model->materials[mesh.material];
        const auto& [r, g, b] = material.base_color;
        const auto& [u, v, w] = material.detail.transmission.color;
        Add(mesh, {{r, g, b}, {u, v, w}});
      }
    }
    rtcCommitScene(scene_.get());
    // Beyond the models there is level land.
    constexpr double kLandAlbedo = 0.2;
    const LinearRgb level = day.SkyHorizontalIrradiance() +
                            day.SunNormalIrradiance() * std::fmax(0.0, day.ToSun().xyz.z);
    land_ = level * (kLandAlbedo / std::numbers::pi);
  }

  /// Returns whether the sun's ray from `to_sun` reaches the point.
  bool IsLitFrom(Vec3 to_sun, Vec3 point) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = Ray(point, to_sun);
    rtcOccluded1(scene_.get(), &context, &ray);
    return ray.tfar > 0.0F;
  }

  /// Irradiance of a surface element at `point` with `normal`, without direct sun: the mean over
  /// `strata`² paths. Each starts in its own stratum of the hemisphere.
  LinearRgb Irradiance(Point<Marker> point, Vec3 normal, int strata, std::uint32_t seed) const {
    Random random{std::mt19937(seed)};
    LinearRgb sum;
    for (int i = 0; i < strata; ++i) {
      for (int k = 0; k < strata; ++k) {
        const double u = (i + random()) / strata, v = (k + random()) / strata;
        sum = sum + Radiance(point.xyz + normal * kOffsetM, Leaving(normal, u, v), &random);
      }
    }
    return sum * (std::numbers::pi / (strata * strata));
  }

 private:
  struct Random {
    std::mt19937 engine;
    double operator()() { return std::uniform_real_distribution<double>()(engine); }
  };
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  static constexpr double kOffsetM = 1e-4;

  struct Leaf {
    LinearRgb reflectance, transmittance;
  };

  void Add(const Mesh& mesh, const Leaf& leaf) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<std::array<float, 3>*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(std::array<float, 3>), mesh.positions.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), corners);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.indices.size() / 3));
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    leaves_.push_back(leaf);
  }

  /// A cosine-distributed direction around `normal` (Malley's method).
  static Vec3 Leaving(Vec3 normal, double u, double v) {
    const Vec3 aside = std::fabs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 s = Normalized(Cross(aside, normal)), t = Cross(normal, s);
    const double angle = 2.0 * std::numbers::pi * v;
    return Normalized(s * (std::sqrt(u) * std::cos(angle)) + t * (std::sqrt(u) * std::sin(angle)) +
                      normal * std::sqrt(1.0 - u));
  }

  static RTCRay Ray(Vec3 from, Vec3 way) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x);
    ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(way.x);
    ray.dir_y = static_cast<float>(way.y);
    ray.dir_z = static_cast<float>(way.z);
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0U;
    return ray;
  }

  LinearRgb Radiance(Vec3 from, Vec3 way, Random* random) const {
    LinearRgb sum, share{1.0, 1.0, 1.0};
    while (true) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit hit{};
      hit.ray = Ray(from, way);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_.get(), &context, &hit);
      if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return sum + share * (way.z > 0.0 ? day_.SkyRadiance({way}) : land_);
      }
      Vec3 normal = Normalized(Vec3{hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z});
      if (Dot(normal, way) > 0.0) normal = -normal;
      const Vec3 at = from + way * hit.ray.tfar;
      const auto& [reflectance, transmittance] = leaves_[hit.hit.geomID];
      const double cosine = Dot(normal, day_.ToSun().xyz);
      const LinearRgb to_sun = cosine > 0.0 ? reflectance : transmittance;
      if (Luminance(to_sun) > 0.0 &&
          IsLitFrom(day_.ToSun().xyz, at + normal * (cosine > 0.0 ? kOffsetM : -kOffsetM))) {
        sum = sum + share * to_sun * day_.SunNormalIrradiance() *
                        (std::fabs(cosine) * std::numbers::inv_pi);
      }
      // The path goes on at one side, more often where more light comes from.
      const double through =
          Luminance(transmittance) / std::fmax(1e-9, Luminance(reflectance + transmittance));
      if (through > 0.0 && (*random)() < through) {
        share = share * transmittance * (1.0 / through);
        normal = -normal;
      } else {
        share = share * reflectance * (1.0 / (1.0 - through));
      }
      from = at + normal * kOffsetM;
      // Russian roulette: surviving paths are weighted for the ended ones.
      const double goes_on = std::fmin(0.9, std::fmax(std::fmax(share.r, share.g), share.b));
      if ((*random)() >= goes_on) return sum;
      share = share * (1.0 / goes_on);
      const double u = (*random)(), v = (*random)();
      way = Leaving(normal, u, v);
    }
  }

  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
  const sky::SkyModel& day_;
  std::vector<Leaf> leaves_;  // By geometry.
  LinearRgb land_;
};

}  // namespace pleinair::compositor::testing
