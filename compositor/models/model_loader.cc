#include <new>
#include <utility>

#include "compositor/models/alpha_cutout.h"
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

Result<Model> ParseByContent(std::string content, const std::filesystem::path& file,
                             const ModelPose& pose) {
  if (LooksLikeGltf(content)) return ParseGltf(std::move(content), file, pose);
  if (!pose.animation.empty()) {
    return InputError(file.string(), "is an OBJ file, which has no animations",
                      "leave animation out");
  }
  return ParseObj(content, file, {ReadWholeFile, ReadTexture});
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
    ApplyNormals(options.normals, &model);
    if (model.meshes.empty()) {
      return InputError(file.string(), "all its triangles are degenerate", "export it again");
    }
    for (Material& material : model.materials) {
      if (options.opaque_glass && material.alpha == Material::Alpha::kBlended) {
        material.alpha = Material::Alpha::kIgnored;
      }
    }
    ApplyAlphaCutout(&model);
    if (model.meshes.empty()) {
      return InputError(file.string(), "nothing of it can be seen: its textures are transparent",
                        "check their alpha");
    }
    return model;
  } catch (const std::bad_alloc&) {
    return SystemError(file.string(), "not enough memory for this model", "use a simpler one");
  }
}

}  // namespace pleinair::compositor
