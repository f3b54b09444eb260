#pragma once

#include <memory>

#include "base/error.h"
#include "compositor/picture/occluder_mask.h"
#include "scene/marker_reflectance.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"
#include "tracker/marker_pattern.h"
#include "tracker/tracker.h"

namespace pleinair::session {

/// Family of the S-G markers.
inline constexpr const char* kSgFamily = "sg";

/// Tracker options for the marker that a scene describes, in consecutive frames. A target, if
/// given, is the only marker searched for. Otherwise a given number is the only one in use. Without
/// a family, S-G markers and AprilTag's tag36h11 are searched for. Errors: an unknown version of
/// the marker pattern, an unreadable target file.
Result<tracker::TrackerOptions> TrackingOf(const scene::SceneDescription& scene);

/// Bit pattern of a marker; null for families other than ours.
std::shared_ptr<const tracker::MarkerPattern> PatternOf(const MarkerName& marker);

/// Marker reflectance for the light meter. Sizes and reflectances are those of the scene, the width
/// of the black band is that of this marker's pattern.
scene::MarkerReflectance MarkerReflectanceOf(const scene::MarkerDescription& described,
                                             const MarkerName& marker);

/// Visible part of the marker, for objects in front of the virtual ones. Without squares where the
/// tracker cannot measure it (AprilTags).
compositor::MarkerVisibility VisibilityOf(const scene::MarkerDescription& described,
                                          const MarkerName& marker, const Observation& seen);

}  // namespace pleinair::session
