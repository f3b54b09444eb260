#include "compositor/models/leaf_material.h"

#include <algorithm>
#include <cstddef>

#include "base/units.h"
#include "compositor/leaf/plate.h"

namespace pleinair::compositor {
namespace {

constexpr double kLobeRefraction = 1.45;  // As in shaders/leaf_gloss.glsl.

/// Colors of a leaf's inside: neither negative nor more than all light.
struct InsideColors {
  std::array<float, 3> base{}, through{};
};

InsideColors InsideOf(const LeafSurface& leaf, const LeafIlluminant& light) {
  const LeafColors colors = ColorsOfLeaf(leaf.leaf, light);
  const std::array reflected{colors.reflectance.r, colors.reflectance.g, colors.reflectance.b};
  const std::array transmitted{colors.transmittance.r, colors.transmittance.g,
                               colors.transmittance.b};
  const double share = SurfaceShareOf(leaf);
  InsideColors inside;
  for (std::size_t c = 0; c < 3; ++c) {
    const double base = std::clamp((reflected[c] - share) / (1.0 - share), 0.0, 1.0);
    const double through = std::clamp(transmitted[c] / (1.0 - share), 0.0, 1.0);
    const double scale = 1.0 / std::max(1.0, base + through);
    inside.base[c] = static_cast<float>(base * scale);
    inside.through[c] = static_cast<float>(through * scale);
  }
  return inside;
}

/// Ratios by channel. Colors below a hundredth count as that, so that none is out of proportion.
std::array<float, 3> RatioOf(const std::array<float, 3>& color, const std::array<float, 3>& to) {
  constexpr float kLeast = 0.01F;
  std::array<float, 3> ratio{};
  for (std::size_t c = 0; c < 3; ++c) {
    ratio[c] = std::max(color[c], kLeast) / std::max(to[c], kLeast);
  }
  return ratio;
}

}  // namespace

float SurfaceShareOf(const LeafSurface& leaf) {
  if (leaf.leaf.model == scene::LeafModel::kPlate) return 0.0F;
  static const auto kReflected =
      static_cast<float>(1.0 - ConeTransmittance(FromDegrees(40.0), kLobeRefraction));
  return std::clamp(leaf.gloss, 0.0F, 1.0F) * kReflected;
}

void ApplyLeaf(const LeafSurface& leaf, Material* material) {
  const InsideColors inside = InsideOf(leaf, LeafIlluminant::D65());
  material->base_color = inside.base;
  material->metallic = 0.0F;
  material->roughness = 1.0F;
  material->coat = {};
  material->metallic_roughness_texture = -1;
  const NormalMap normal_map = material->detail.normal_map;
  material->detail = {};
  material->detail.normal_map = normal_map;
  material->detail.transmission.color = inside.through;
  material->detail.leaf = leaf;
}

LeafTints LeafTintsIn(const LeafSurface& leaf, const LeafIlluminant& sun,
                      const LeafIlluminant& sky) {
  const InsideColors baked = InsideOf(leaf, LeafIlluminant::D65());
  const InsideColors in_sun = InsideOf(leaf, sun), in_sky = InsideOf(leaf, sky);
  return {RatioOf(in_sky.base, baked.base), RatioOf(in_sun.base, in_sky.base),
          RatioOf(in_sky.through, baked.through), RatioOf(in_sun.through, in_sky.through)};
}

}  // namespace pleinair::compositor
