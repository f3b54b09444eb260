#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "base/vector.h"
#include "content/georeference/local_frame.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// Options that state where the marker is, as the user typed them.
struct MarkerPlaceArguments {
  std::string at, scene, height_reference;
};

/// Where the marker is.
struct MarkerPlace {
  content::Place place;
  /// Rotation to marker coordinates, of the scene; unset: no scene is given.
  std::optional<Mat3> marker_from_world;
};

/// The origin of a scene's marker: its [place], moved by the offset of its [marker].
content::Place PlaceOfMarker(const scene::SceneDescription& scene);

/// Adds --at, --scene and --height-reference.
void AddMarkerPlaceOptions(CLI::App& command, MarkerPlaceArguments* arguments);

/// The place, and the heading if a scene is given. `command`: its name. Errors (input): no place,
/// --at that is none, those of ReadSceneDescription().
Result<MarkerPlace> ReadMarkerPlace(const MarkerPlaceArguments& arguments,
                                    const std::string& command);

}  // namespace pleinair::app
