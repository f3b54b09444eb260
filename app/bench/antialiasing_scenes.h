#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/vector.h"
#include "compositor/models/placed_model.h"

namespace pleinair::app {

/// A made scene whose edges are compared between methods of antialiasing; marker coordinates (z
/// up), metres.
struct AntialiasingScene {
  std::string name;
  std::vector<compositor::PlacedModel> models;
  Transform<Camera, Marker> camera_from_marker;
  double creep_m = 0.0;         ///< Sideways motion of the camera that moves the subject by 0.1 px.
  std::uint8_t background = 0;  ///< 8-bit value of the even camera image.
};

/// boards: random boards, white and unlit before black, so that errors are those of coverage.
/// rails: bars of 0.1 to 2 px, likewise. leaves: cut-out leaves. poles_near, poles_far: shadows of
/// poles on the ground, wide and narrow in the image. torus: glossy. floor: checked, to the
/// horizon.
std::span<const std::string_view> AntialiasingSceneNames();

/// A scene of AntialiasingSceneNames() for this camera.
AntialiasingScene MakeAntialiasingScene(std::string_view name, const CameraModel& camera);

/// The scene's objects in even white light of their own, without phantoms. Before black their image
/// is their coverage.
std::vector<compositor::PlacedModel> CoverageModels(const AntialiasingScene& scene);

}  // namespace pleinair::app
