#include <cstddef>
#include <cstdint>
#include <string>

#include "compositor/models/gltf_reader.h"
#include "compositor/models/mesh_normals.h"

// Any bytes give a glTF model, text or binary, or an error. The model's folder does not exist, so
// that buffers and images come from the file itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace compositor = pleinair::compositor;
  const std::string content(reinterpret_cast<const char*>(data), size);
  // The first animation, if there is one, at a moment between its key frames.
  const bool animated = content.find("\"animations\"") != std::string::npos;
  const auto parsed =
      compositor::ParseGltf(content, "/does/not/exist/fuzz.glb", {animated ? "0" : "", 0.7});
  if (!parsed) return 0;
  for (const auto mode : {compositor::NormalsMode::kFromFile, compositor::NormalsMode::kFlat,
                          compositor::NormalsMode::kSmooth}) {
    compositor::Model model = *parsed;
    compositor::ApplyNormals(mode, &model);
    for (const auto& mesh : model.meshes) {
      if (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= model.materials.size() ||
          (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size()) ||
          (!mesh.details.empty() && mesh.details.size() != mesh.positions.size()) ||
          mesh.normals.size() != mesh.positions.size()) {
        __builtin_trap();
      }
      for (const std::uint32_t index : mesh.indices) {
        if (index >= mesh.positions.size()) __builtin_trap();
      }
    }
  }
  return 0;
}
