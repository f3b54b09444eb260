#include "devices/scene_description.h"

#include "devices/scene_facts.h"
#include "files/text_file.h"

namespace pleinair::devices {

Result<SceneDescription> ReadSceneDescription(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(file, files::kMaxDescriptionBytes));
  PLEINAIR_ASSIGN_OR_RETURN(const SceneFacts facts, ParseScene(bytes, file.string()));
  PLEINAIR_ASSIGN_OR_RETURN(SceneDescription scene, CompleteScene(facts, file));
  PLEINAIR_RETURN_IF_ERROR(CheckModelsExist(scene));
  return scene;
}

}  // namespace pleinair::devices
