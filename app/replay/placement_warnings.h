#pragma once

#include <string>
#include <vector>

#include "base/camera_model.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/models/placed_model.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// The camera and its poses in the frames of a recording.
struct RecordedViews {
  const CameraModel& camera;
  const std::vector<session::Observation>& path;
};

/// Warns of models that are probably not placed as meant. A model gets at most one warning: one
/// sentence, with the remedy. The cases are:
/// - The model is in survey coordinates, with the marker more than a kilometre away.
/// - An object is more than 100 times larger than the camera's distance from the marker, or 1,000
///   times smaller. The scene does not state its unit.
/// - An object's box surrounds the camera in at least half of the frames, so that it may cover the
///   whole picture. The scene does not state its unit.
/// - The model is y-up by shape or header (compositor::LooksYUp). The scene does not state its
///   axis.
/// - An object is in view in no frame, or phantoms hide it in every frame.
///
/// `models`: the scene's phantoms, then its objects. `phantoms` may be null: nothing is hidden.
std::vector<std::string> PlacementWarnings(const std::vector<compositor::PlacedModel>& models,
                                           const scene::SceneDescription& scene,
                                           const RecordedViews& views,
                                           const compositor::PhantomRays* phantoms);

}  // namespace pleinair::app
