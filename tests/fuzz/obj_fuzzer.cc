#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "compositor/models/mesh_normals.h"
#include "compositor/models/obj_parser.h"
#include "compositor/models/texture_decoder.h"

// Any bytes give an OBJ model or an error. The text after a line "#mtl" is its material library, so
// that one input reaches both parsers. Textures are the library's own bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace compositor = pleinair::compositor;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t split = input.find("#mtl\n");
  const std::string_view obj = input.substr(0, split);
  const std::string library(split == std::string_view::npos ? "" : input.substr(split + 5));
  const compositor::ObjCompanions companions{
      [&](const std::filesystem::path&) -> pleinair::Result<std::string> { return library; },
      [&](const std::filesystem::path& path) {
        return compositor::DecodeTexture(std::as_bytes(std::span(library)), path.string());
      }};
  for (const auto mode : {compositor::NormalsMode::kFromFile, compositor::NormalsMode::kFlat,
                          compositor::NormalsMode::kSmooth}) {
    auto model = compositor::ParseObj(obj, "fuzz.obj", companions);
    if (!model) return 0;
    compositor::ApplyNormals(mode, &*model);
    for (const auto& mesh : model->meshes) {
      for (const std::uint32_t index : mesh.indices) {
        if (index >= mesh.positions.size() || mesh.normals.size() != mesh.positions.size()) {
          __builtin_trap();
        }
      }
    }
  }
  return 0;
}
