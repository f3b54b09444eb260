#include <cstddef>

#include "compositor/models/model.h"

namespace pleinair::compositor {

std::set<std::string> UnsupportedFeatures(const Model& model) {
  std::set<std::string> words = model.unsupported_features;
  for (const Mesh& mesh : model.meshes) {
    const auto& of_material =
        model.materials[static_cast<std::size_t>(mesh.material)].unsupported_features;
    words.insert(of_material.begin(), of_material.end());
  }
  return words;
}

}  // namespace pleinair::compositor
