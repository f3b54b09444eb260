#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "compositor/ink/ink_shape.h"
#include "compositor/models/placed_model.h"
#include "content/draping/draped_layer.h"
#include "content/georeference/vector_layer.h"
#include "scene/scene_description.h"

namespace pleinair::session {
class Pipeline;
}

namespace pleinair::app {

/// A drape as it lies in the pictures, for reports.
struct InkFacts {
  std::string file, crs;
  std::size_t features = 0, shapes = 0;
  content::DrapeReport drape;
  double milliseconds = 0.0;  ///< To place and drape it.
};

/// The maps of a scene as ink on its phantoms.
class SceneInk {
 public:
  /// Reads the maps of the scene. Errors (input): those of ReadMap().
  static Result<std::shared_ptr<SceneInk>> Read(const scene::SceneDescription& scene);

  /// Places and drapes the maps at the marker's heading: a session::InkSource. Errors (input):
  /// those of PlaceMap() and content::DrapeExactly().
  Result<std::vector<compositor::InkShape>> Lay(std::span<const compositor::PlacedModel> phantoms,
                                                const scene::MarkerDescription& marker);

  /// Of the last Lay(), one a drape.
  const std::vector<InkFacts>& facts() const { return facts_; }
  /// Of all calls, each once; they name the file.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void Warn(const std::string& file, const std::string& warning);

  scene::SceneDescription scene_;
  std::vector<std::vector<content::VectorLayer>> maps_;  // One a drape.
  std::vector<InkFacts> facts_;
  std::vector<std::string> warnings_;
};

/// Reads the scene's maps, if there are any, and has the pipeline draw them from its first frame
/// on. They are placed once, so that errors appear here. Returns null for scenes without maps.
/// Errors (input): those of SceneInk.
Result<std::shared_ptr<SceneInk>> DrawMaps(const scene::SceneDescription& scene,
                                           session::Pipeline* pipeline);

}  // namespace pleinair::app
