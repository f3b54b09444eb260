#include "compositor/light/reflectance.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/image.h"
#include "base/srgb.h"
#include "base/vector.h"
#include "compositor/models/leaf_material.h"

namespace pleinair::compositor {
namespace {

Vec3 WideCorner(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

/// Coverage of a surface where its texture has this alpha.
double ShareThere(std::uint8_t alpha, const Material& material) {
  if (material.alpha == Material::Alpha::kCutout) {
    return material.opacity * static_cast<float>(alpha) >= 255.0F * material.alpha_cutoff ? 1.0
                                                                                          : 0.0;
  }
  return material.alpha == Material::Alpha::kBlended ? alpha / 255.0 : 1.0;
}

/// Linear mean of a texture, sampled on a grid of at most 256 × 256 pixels. Alpha cut-outs have no
/// weight; glass is weighted by its alpha.
std::array<float, 3> MeanColor(const Image<std::uint8_t>& texture, const Material& material) {
  const auto& linear = LinearFromSrgb8();
  const int step_x = std::max(1, texture.width() / 256);
  const int step_y = std::max(1, texture.height() / 256);
  std::array<double, 3> sum{};
  double count = 0.0;
  for (int y = step_y / 2; y < texture.height(); y += step_y) {
    for (int x = step_x / 2; x < texture.width(); x += step_x) {
      const double share = texture.channels() == 4 ? ShareThere(texture(x, y, 3), material) : 1.0;
      for (int c = 0; c < 3; ++c) {
        sum[c] += share * linear[texture(x, y, texture.channels() > 2 ? c : 0)];
      }
      count += share;
    }
  }
  std::array<float, 3> mean{};
  for (int c = 0; c < 3 && count > 0.0; ++c) mean[c] = static_cast<float>(sum[c] / count);
  return mean;
}

/// Multiplies a color by the mean of a texture, if the model has it.
std::array<float, 3> TimesTexture(std::array<float, 3> color, const Model& model, int texture,
                                  const Material& material) {
  if (texture >= 0 && static_cast<std::size_t>(texture) < model.textures.size() &&
      !model.textures[texture].empty()) {
    const std::array<float, 3> mean = MeanColor(model.textures[texture], material);
    for (int c = 0; c < 3; ++c) color[c] *= mean[c];
  }
  return color;
}

}  // namespace

std::array<float, 3> ReflectanceOf(const Model& model, int material_index) {
  if (material_index < 0 || static_cast<std::size_t>(material_index) >= model.materials.size()) {
    return {Material{}.base_color};
  }
  const Material& material = model.materials[material_index];
  std::array<float, 3> albedo =
      TimesTexture(material.base_color, model, material.base_color_texture, material);
  if (material.detail.leaf) {
    const float share = SurfaceShareOf(*material.detail.leaf);
    for (float& value : albedo) value = share + (1.0F - share) * value;
  }
  // With an albedo of 1 or more, the light would never decay.
  for (float& value : albedo) value = std::clamp(value, 0.0F, 0.98F);
  return albedo;
}

std::array<float, 3> TransmittanceOf(const PlacedModel& placed, int material_index,
                                     const std::array<float, 3>& albedo) {
  const Model& model = *placed.model;
  if (placed.is_phantom || material_index < 0 ||
      static_cast<std::size_t>(material_index) >= model.materials.size()) {
    return {};
  }
  const Material& material = model.materials[material_index];
  if (!material.detail.Transmits()) return {};
  std::array<float, 3> transmittance = TimesTexture(material.detail.transmission.color, model,
                                                    material.detail.transmission.texture, material);
  const float inside = material.detail.leaf ? 1.0F - SurfaceShareOf(*material.detail.leaf) : 1.0F;
  for (int c = 0; c < 3; ++c) {
    transmittance[c] = std::clamp(inside * transmittance[c], 0.0F, 0.98F - albedo[c]);
  }
  return transmittance;
}

std::array<float, 3> MeanVertexColor(const SurfaceMesh& surface) {
  if (surface.details.empty()) return {1.0F, 1.0F, 1.0F};
  std::array<double, 3> sum{};
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const std::uint32_t* corners = &surface.indices[i];
    const Vec3 first = WideCorner(surface.positions[corners[0]]);
    // Twice the triangle's area, over three corners.
    const double weight = Norm(Cross(WideCorner(surface.positions[corners[1]]) - first,
                                     WideCorner(surface.positions[corners[2]]) - first)) /
                          3.0;
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) sum[c] += weight * surface.details[corners[k]].color[c];
    }
    area += 3.0 * weight;
  }
  if (!(area > 0.0)) return {1.0F, 1.0F, 1.0F};
  std::array<float, 3> mean{};
  for (int c = 0; c < 3; ++c) mean[c] = static_cast<float>(sum[c] / area);
  return mean;
}

}  // namespace pleinair::compositor
