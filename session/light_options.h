#pragma once

#include <filesystem>
#include <optional>

#include "base/camera_response.h"
#include "compositor/photometry/light_overrides.h"
#include "scene/scene_description.h"
#include "session/frame_lens.h"
#include "session/motion/frame_exposure.h"

namespace pleinair::session {

/// What is done about light that changes within a recording.
enum class LightChangeMode {
  kFollow,  ///< Sun and sky are estimated in each frame.
  kHold,    ///< One light for the whole recording; only the exposure may change.
  kStated,  ///< Described sun and clear sky, times what the scene's layers of clouds leave of them.
};

/// "follow", "hold", "stated".
const char* NameOf(LightChangeMode mode);

/// In place of the name of a response file.
inline constexpr const char* kSrgbResponse = "srgb";

/// User options for the light and the camera image, for recordings and live sessions.
struct LightOptions {
  compositor::LightOverrides overrides;
  LightChangeMode changes = LightChangeMode::kFollow;
  bool match_look = true;  ///< Drawn pixels receive the frames' blur and noise.
  DefocusOptions defocus = {};
  MotionBlurOptions motion_blur = {};
  /// Objects that cover the marker are in front of the virtual objects.
  bool hands_in_front = false;
  /// Overrides the scene's; empty: as in the scene. kSrgbResponse: sRGB, whatever the frames show.
  std::filesystem::path camera_response;
  /// By the film's tags; used where neither the user states a response nor the frames show another.
  std::optional<CameraResponse> film_response;
  std::filesystem::path cache;  ///< Folder for daylight coefficients; empty: no cache.
  int sky_division = 1;  ///< Subdivision of Tregenza's patches: compositor::CoefficientOptions.
  double convergence = 0.01;  ///< compositor::CoefficientOptions.
};

/// Returns the scene with the heading and the camera response of the options.
scene::SceneDescription WithGiven(const scene::SceneDescription& scene,
                                  const LightOptions& options);

/// What options, scene and recording state of the lens and the exposure, in this order. Nothing
/// where they state nothing.
std::optional<scene::LensDescription> StatedLens(const scene::SceneDescription& scene,
                                                 const LightOptions& options);

}  // namespace pleinair::session
