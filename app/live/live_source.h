#pragma once

#include <memory>
#include <optional>

#include "app/live/live_arguments.h"
#include "app/live/live_trajectory.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "devices/cameras/camera_uri.h"
#include "devices/cameras/live_camera.h"
#include "devices/frame_source.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// Frames of a camera or a recording for a live session, with their descriptions.
struct LiveSource {
  std::unique_ptr<devices::FrameSource> frames;
  devices::LiveCamera* camera = nullptr;  ///< Null for a recording.
  CameraModel lens;
  std::optional<scene::SceneDescription> scene;
  CameraResponse response = {};                  ///< By a film's tags.
  std::shared_ptr<LiveTrajectory> trajectory{};  ///< The scene's; null without one.
};

/// Opens the camera, or the recording that is played at its pace. Errors: those of recording, lens
/// and scene; options that do not fit the source. Also a scene with a trajectory, for a camera.
Result<LiveSource> OpenLiveSource(const devices::CameraUri& uri, const LiveArguments& arguments);

/// Returns the time of the first frame, by the options or the scene; nothing: the time of its
/// arrival. Error (input): an option that is no time.
Result<std::optional<UtcTime>> StartOf(const LiveArguments& arguments, const LiveSource& source);

}  // namespace pleinair::app
