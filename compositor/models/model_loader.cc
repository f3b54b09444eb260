#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "base/little_endian.h"
#include "compositor/models/alpha_cutout.h"
#include "compositor/models/animation/model_animation.h"
#include "compositor/models/gltf_pose.h"
#include "compositor/models/gltf_reader.h"
#include "compositor/models/mesh_normals.h"
#include "compositor/models/model.h"
#include "compositor/models/model_files.h"
#include "compositor/models/model_frame.h"
#include "compositor/models/obj_parser.h"
#include "compositor/models/texture_decoder.h"

namespace pleinair::compositor {
namespace {

tl::unexpected<Error> NotAnimated(const std::filesystem::path& file) {
  return InputError(file.string(), "is an OBJ file, which has no animations",
                    "leave animation out");
}

tl::unexpected<Error> TooLarge(const std::filesystem::path& file) {
  return SystemError(file.string(), "not enough memory for this model", "use a simpler one");
}

/// The name of a format that is not read, by its content; empty: none that is known.
std::string OtherFormat(std::string_view content) {
  constexpr std::size_t kHead = 84, kTriangle = 50;  // Bytes in binary STL.
  struct Start {
    std::string_view bytes;
    const char* name;
  };
  for (const Start& start : {Start{"ply\n", "a PLY model"},
                             {"ply\r", "a PLY model"},
                             {"Kaydara FBX", "an FBX model"},
                             {"; FBX", "an FBX model"},
                             {"BLENDER", "a Blender file"},
                             {"PK\x03\x04", "an archive (USDZ, 3MF or ZIP)"},
                             {"<?xml", "XML (Collada or X3D)"},
                             {"%PDF", "a PDF document"},
                             {"\x89PNG", "a PNG image"},
                             {"\xFF\xD8\xFF", "a JPEG image"}}) {
    if (content.starts_with(start.bytes)) return start.name;
  }
  if (content.starts_with("solid") && content.find("facet") != std::string_view::npos) {
    return "an STL model";
  }
  if (content.size() > kHead) {
    LittleEndianReader count(content.substr(kHead - 4, 4));
    if (count.Get<std::uint32_t>() * std::uint64_t{kTriangle} + kHead == content.size()) {
      return "an STL model";
    }
  }
  return "";
}

Result<Model> ParseByContent(std::string content, const std::filesystem::path& file,
                             const ModelPose& pose) {
  if (content.empty()) return InputError(file.string(), "is empty", "get a whole copy of it");
  if (LooksLikeGltf(content)) return ParseGltf(std::move(content), file, pose);
  if (const std::string format = OtherFormat(content); !format.empty()) {
    return InputError(file.string(), "is " + format + ", which is not read",
                      "export it as glTF or OBJ");
  }
  if (!pose.animation.empty()) return NotAnimated(file);
  const std::filesystem::path folder = file.parent_path();
  const auto text = [&](const std::filesystem::path& named) -> Result<std::string> {
    PLEINAIR_RETURN_IF_ERROR(CheckBelongsToModel(named, folder));
    return ReadWholeFile(named);
  };
  const auto texture = [&](const std::filesystem::path& named) -> Result<Image<std::uint8_t>> {
    PLEINAIR_RETURN_IF_ERROR(CheckBelongsToModel(named, folder));
    return ReadTexture(named);
  };
  return ParseObj(content, file, {text, texture});
}

/// Applies the normals and the opacity of `options`. Returns the sources of the vertices.
Result<std::vector<VertexSources>> GiveNormals(const ModelOptions& options,
                                               const std::filesystem::path& file, Model* model) {
  std::vector<VertexSources> sources = ApplyNormals(options.normals, model);
  if (model->meshes.empty()) {
    return InputError(file.string(), "all its triangles are degenerate", "export it again");
  }
  for (Material& material : model->materials) {
    if (options.opaque_glass && material.alpha == Material::Alpha::kBlended) {
      material.alpha = Material::Alpha::kIgnored;
    }
  }
  return sources;
}

}  // namespace

Result<Model> LoadModel(const std::filesystem::path& file, const ModelOptions& options) {
  return LoadModel(file, options, ModelPose{});
}

Result<Model> LoadModel(const std::filesystem::path& file, const ModelOptions& options,
                        const ModelPose& pose) {
  try {
    PLEINAIR_ASSIGN_OR_RETURN(std::string content, ReadWholeFile(file));
    PLEINAIR_ASSIGN_OR_RETURN(Model model, ParseByContent(std::move(content), file, pose));
    ApplyFrame(options.frame, &model);
    PLEINAIR_ASSIGN_OR_RETURN(const auto sources, GiveNormals(options, file, &model));
    ApplyAlphaCutout(&model);
    if (model.meshes.empty()) {
      return InputError(file.string(), "nothing of it can be seen: its textures are transparent",
                        "check their alpha");
    }
    return model;
  } catch (const std::bad_alloc&) {
    return TooLarge(file);
  }
}

Result<AnimatedModel> LoadAnimatedModel(const std::filesystem::path& file,
                                        const ModelOptions& options, const std::string& animation) {
  try {
    PLEINAIR_ASSIGN_OR_RETURN(std::string content, ReadWholeFile(file));
    if (!LooksLikeGltf(content)) return NotAnimated(file);
    PLEINAIR_ASSIGN_OR_RETURN(MovingGltf moving,
                              ParseMovingGltf(std::move(content), file, animation));
    const FrameMap map = ApplyFrame(options.frame, &moving.model);
    moving.rig->SetFrame({map.linear, map.translation_m});
    PLEINAIR_ASSIGN_OR_RETURN(std::vector<VertexSources> sources,
                              GiveNormals(options, file, &moving.model));
    PLEINAIR_RETURN_IF_ERROR(
        moving.rig->SetVertices(options.normals, std::move(sources), file.string()));
    return AnimatedModel{std::move(moving.model), std::move(moving.rig)};
  } catch (const std::bad_alloc&) {
    return TooLarge(file);
  }
}

}  // namespace pleinair::compositor
