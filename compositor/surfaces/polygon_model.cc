#include "compositor/surfaces/polygon_model.h"

#include <cstddef>
#include <cstdint>

#include "compositor/models/mesh_normals.h"

namespace pleinair::compositor {

Model PolygonModel(const std::string& name, const std::vector<std::vector<Vec3>>& polygons,
                   LinearRgb reflectance) {
  Model model;
  model.file = name;
  Material& material = model.materials.emplace_back();
  material.name = name;
  material.base_color = {static_cast<float>(reflectance.r), static_cast<float>(reflectance.g),
                         static_cast<float>(reflectance.b)};
  Mesh& mesh = model.meshes.emplace_back();
  mesh.name = name;
  for (const std::vector<Vec3>& polygon : polygons) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& corner : polygon) {
      mesh.positions.push_back({static_cast<float>(corner.x), static_cast<float>(corner.y),
                                static_cast<float>(corner.z)});
    }
    for (std::uint32_t i = 1; i + 1 < polygon.size(); ++i) {
      mesh.indices.insert(mesh.indices.end(), {first, first + i, first + i + 1});
    }
  }
  mesh.normals.resize(mesh.positions.size());
  ApplyNormals(NormalsMode::kFlat, &model);
  return model;
}

}  // namespace pleinair::compositor
