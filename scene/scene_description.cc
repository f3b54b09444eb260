#include "scene/scene_description.h"

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

}  // namespace pleinair::scene
