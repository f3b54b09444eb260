#include "scene/scene_description.h"

#include <string>
#include <system_error>

#include "files/text_file.h"
#include "scene/scene_facts.h"

namespace pleinair::scene {

Result<SceneDescription> ReadSceneDescription(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(file, files::kMaxDescriptionBytes));
  PLEINAIR_ASSIGN_OR_RETURN(const SceneFacts facts, ParseScene(bytes, file.string()));
  PLEINAIR_ASSIGN_OR_RETURN(SceneDescription scene, CompleteScene(facts, file));
  PLEINAIR_RETURN_IF_ERROR(CheckModelsExist(scene));
  return scene;
}

Result<void> CheckModelsExist(const SceneDescription& scene) {
  const auto check = [&](const char* what, const std::filesystem::path& named) -> Result<void> {
    std::error_code error;
    if (std::filesystem::is_regular_file(named, error)) return {};
    return InputError(
        scene.file.string(),
        std::string("names the ") + what + " " + named.string() + ", which is not there",
        "put the file there or correct the name in the scene");
  };
  if (!scene.camera.response.empty()) {
    PLEINAIR_RETURN_IF_ERROR(check("camera response", scene.camera.response));
  }
  for (const std::vector<ModelReference>* models : {&scene.phantoms, &scene.objects}) {
    for (const ModelReference& model : *models) {
      if (model.surface) continue;
      PLEINAIR_RETURN_IF_ERROR(check("model", model.file));
    }
  }
  for (const DrapeDescription& drape : scene.drapes) {
    PLEINAIR_RETURN_IF_ERROR(check("map", drape.source.file));
  }
  return scene.marker.target ? check("target", *scene.marker.target) : Result<void>();
}

}  // namespace pleinair::scene
