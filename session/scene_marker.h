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

/// How to look for the marker that a scene describes in consecutive frames. Where it names no
/// family, S-G markers and AprilTag's tag36h11 are looked for; a number that it names is the only
/// one in use; a target is all that is looked for. Errors: a version of the print that this program
/// does not know, a target's file that cannot be read.
Result<tracker::TrackerOptions> TrackingOf(const scene::SceneDescription& scene);

/// What the print of a marker looks like; null where the family is not one of ours.
std::shared_ptr<const tracker::MarkerPattern> PatternOf(const MarkerName& marker);

/// The print as a light meter wants to know it: sizes and reflectances as the scene states them,
/// and the black band as wide as it is in this marker's print.
scene::MarkerReflectance MarkerReflectanceOf(const scene::MarkerDescription& described,
                                             const MarkerName& marker);

/// Which part of the print was seen, for what is to be put before the virtual objects; without
/// squares where the tracker cannot tell (AprilTags).
compositor::MarkerVisibility VisibilityOf(const scene::MarkerDescription& described,
                                          const MarkerName& marker, const Observation& seen);

}  // namespace pleinair::session
