#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene_description.h"
#include "scene/trajectory_description.h"
#include "sky/clouds/cloud_layer.h"

namespace pleinair::scene {

/// Place and time in one scene file, for PlaceTime.
struct PlaceTimeFacts {
  std::optional<double> latitude_deg, longitude_deg, height_m;
  std::optional<UtcTime> start;
  std::optional<bool> above_ellipsoid;
};

/// Where the origin of the marker is from the place, for MarkerDescription.
struct OriginFacts {
  std::optional<Vec3> offset_m;
  std::optional<double> position_sd_m;
};

/// Marker in one scene file, for MarkerDescription.
struct MarkerFacts {
  std::optional<std::string> family;
  std::optional<std::string> target;  ///< Path as in the file, relative to the scene's folder.
  std::optional<int> id, version;
  std::optional<double> size_m, heading_deg, board_size_m;
  /// As heading_deg, but clockwise from magnetic north at the scene's place and time.
  std::optional<double> heading_magnetic_deg;
  std::optional<double> albedo_black, albedo_white;
  std::optional<bool> upright;
  OriginFacts origin;
};

/// Further marker in one scene file, for AnchorDescription.
struct AnchorFacts {
  std::optional<std::string> family;
  std::optional<int> id;
  std::optional<double> size_m;
  std::optional<Vec3> translation_m, rotation_deg;
};

/// Level ground in one scene file.
struct GroundFacts {
  bool is_given = false;        ///< [ground]
  bool may_be_assumed = false;  ///< A scene without any phantom gets it.
  std::optional<double> size_m, height_m;
  std::optional<LinearRgb> color;
};

/// Content of one scene file. Absent values are unset, so that a hand-written scene.toml can leave
/// to the recording what the recording already has. Paths of its content are as in the file,
/// relative to the scene's folder.
struct SceneFacts : SceneContent {
  PlaceTimeFacts place_time;
  MarkerFacts marker;
  std::vector<AnchorFacts> anchors;
  std::optional<TrajectoryDescription> trajectory;
  std::vector<clouds::CloudLayer> cloud_layers;
  GroundFacts ground;
  std::optional<Cloudiness> cloudiness;
  std::optional<double> turbidity;
  CameraDescription camera;

  /// True if place, time and marker, which every scene needs, are all missing.
  bool LacksPlaceTimeAndMarker() const {
    return !place_time.latitude_deg && !place_time.longitude_deg && !place_time.start &&
           !marker.size_m && !marker.target && !marker.heading_deg && !marker.heading_magnetic_deg;
  }
};

/// Parses a scene.json or recording.json. These are foreign files: unknown fields and unknown words
/// for the sky are ignored. Ground truth (poses, sun, light, exposure, directions, key frames, the
/// amounts in `sky`) is never read.
Result<SceneFacts> ParseSceneJson(std::string_view bytes, const std::string& name);

/// Parses a scene.toml, pleinair's own format: unknown keys and words are errors with their line.
Result<SceneFacts> ParseSceneToml(std::string_view bytes, const std::string& name);

/// Parses either format, chosen by content.
Result<SceneFacts> ParseScene(std::string_view bytes, const std::string& name);

/// Checks the range of every value that is present. Call it before WithFallback(), so that the
/// error names the file that holds the value. ParseSceneJson() does so by itself.
Result<void> CheckRanges(const SceneFacts& facts, const std::string& name);

/// Takes missing place, time, marker and sky from `fallback`; never models.
SceneFacts WithFallback(SceneFacts facts, const SceneFacts& fallback);

/// Checks that all required values are present and in range. `file` is the name in messages, and
/// model paths are relative to it. Does not access the disk.
Result<SceneDescription> CompleteScene(const SceneFacts& facts, const std::filesystem::path& file);

/// Checks that every model file and the target file exist.
Result<void> CheckModelsExist(const SceneDescription& scene);

}  // namespace pleinair::scene
