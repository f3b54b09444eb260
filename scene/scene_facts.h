#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene_description.h"

namespace pleinair::scene {

/// What one file says of the scene; absent is what it does not say, so that a hand-written
/// scene.toml can leave to the recording what the recording knows.
struct SceneFacts {
  std::optional<double> latitude_deg, longitude_deg, height_m;
  std::optional<UtcTime> start;
  std::optional<std::string> marker_family;
  std::optional<std::string> marker_target;  ///< File as written, relative to the scene's.
  std::optional<int> marker_id, marker_version;
  std::optional<double> marker_size_m, marker_heading_deg, marker_board_size_m;
  std::optional<double> albedo_black, albedo_white;
  std::optional<bool> marker_upright;
  std::vector<ModelReference> phantoms, objects;  ///< Files as written, relative to the scene's.
  std::optional<Cloudiness> cloudiness;
  std::optional<double> turbidity;
  std::optional<LinearRgb> exposure_scale;
  std::filesystem::path camera_response;  ///< Beside the file that names it; empty: not said.

  /// Says nothing of place, time and marker, which a scene cannot do without.
  bool LacksPlaceTimeAndMarker() const {
    return !latitude_deg && !longitude_deg && !start && !marker_size_m && !marker_target &&
           !marker_heading_deg;
  }
};

/// The facts in a scene.json or recording.json. Foreign files: unknown fields and unknown sky
/// words are passed over; ground truth (poses, sun, light, exposure, directions, key frames, the
/// amounts in `sky`) is never looked at.
Result<SceneFacts> ParseSceneJson(std::string_view bytes, const std::string& name);

/// The facts in a scene.toml. Our own form: unknown keys and words are errors with their line.
Result<SceneFacts> ParseSceneToml(std::string_view bytes, const std::string& name);

/// Either of the two, by content.
Result<SceneFacts> ParseScene(std::string_view bytes, const std::string& name);

/// Takes place, time, marker and sky from `fallback` where `facts` lacks them; never models.
SceneFacts WithFallback(SceneFacts facts, const SceneFacts& fallback);

/// Checks that all that is needed is there and in range; `file` stands in messages and is what
/// model files are relative to. Does not look at the disk.
Result<SceneDescription> CompleteScene(const SceneFacts& facts, const std::filesystem::path& file);

/// Checks that every model file and the target are there.
Result<void> CheckModelsExist(const SceneDescription& scene);

}  // namespace pleinair::scene
