#include "compositor/light/sun_visibility.h"

#include <array>
#include <cstddef>

#include "base/parallel_for.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/patch_scene.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

// Barycentric. Corners and edges are moved inwards, because rays from where surfaces meet are
// unreliable.
constexpr std::array<std::array<double, 3>, 10> kPlaces{{
    {0.90, 0.05, 0.05},
    {0.05, 0.90, 0.05},
    {0.05, 0.05, 0.90},
    {0.475, 0.475, 0.05},
    {0.05, 0.475, 0.475},
    {0.475, 0.05, 0.475},
    {1.0 / 3, 1.0 / 3, 1.0 / 3},
    {0.70, 0.15, 0.15},
    {0.15, 0.70, 0.15},
    {0.15, 0.15, 0.70},
}};
constexpr std::array<SamplePoint, 3> kRim{{{1.0, 0.0}, {1.0, 1.0 / 3}, {1.0, 2.0 / 3}}};

Vec3 At(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::vector<SunVisibility> ClassifySunVisibility(const RayScene& rays, const LitMesh& phantom,
                                                 Vec3 to_sun, int threads) {
  std::vector<SunVisibility> reach(phantom.indices.size() / 3, SunVisibility::kNone);
  if (Norm(to_sun) == 0.0) return reach;
  const TangentFrame frame(Normalized(to_sun));
  std::array<Vec3, kRim.size()> rim;
  for (std::size_t i = 0; i < rim.size(); ++i) rim[i] = SunDiscDirection(frame, kRim[i]);
  ParallelFor(reach.size(), threads, [&](std::size_t triangle) {
    std::array<Vec3, 3> corners;
    bool faces = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = phantom.indices[3 * triangle + k];
      corners[k] = At(phantom.positions[vertex]);
      faces = faces || Dot(At(phantom.normals[vertex]), to_sun) > 0.0;
    }
    if (!faces) return;
    bool lit = false, shaded = false;
    for (const auto& [a, b, c] : kPlaces) {
      const Vec3 place = corners[0] * a + corners[1] * b + corners[2] * c;
      for (const Vec3& direction : rim) {
        const bool hidden =
            rays.Occluded(RayTargets::kPhantoms, place + direction * kRayOffset_m, direction);
        (hidden ? shaded : lit) = true;
      }
      if (lit && shaded) break;
    }
    if (lit && shaded) {
      reach[triangle] = SunVisibility::kSome;
    } else if (lit) {
      reach[triangle] = SunVisibility::kAll;
    }
  });
  return reach;
}

}  // namespace pleinair::compositor
