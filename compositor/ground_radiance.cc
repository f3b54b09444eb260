#include "compositor/ground_radiance.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace pleinair::compositor {

LinearRgb MeanGroundRadiance(const std::vector<LitMesh>& lit, const std::vector<PlacedModel>& scene,
                             LinearRgb sun_normal, Vec3 to_sun) {
  const bool phantoms =
      std::any_of(lit.begin(), lit.end(), [](const LitMesh& mesh) { return mesh.is_phantom; });
  LinearRgb sum;
  std::size_t count = 0;
  for (const LitMesh& mesh : lit) {
    if (mesh.is_phantom != phantoms) continue;
    const auto& color = scene[mesh.placed_model].model->materials[mesh.material].base_color;
    const LinearRgb albedo{color[0], color[1], color[2]};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto& n = mesh.normals[i];
      if (n[2] < 0.5F) continue;
      const auto& ambient = phantoms ? mesh.ambient_without[i] : mesh.ambient_with[i];
      const double cosine = std::max(0.0, n[0] * to_sun.x + n[1] * to_sun.y + n[2] * to_sun.z);
      const LinearRgb light = LinearRgb{ambient[0], ambient[1], ambient[2]} + sun_normal * cosine;
      sum = sum + albedo * light * std::numbers::inv_pi;
      ++count;
    }
  }
  return count > 0 ? sum * (1.0 / static_cast<double>(count)) : sum;
}

}  // namespace pleinair::compositor
