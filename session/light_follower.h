#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/light/light_mix.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/changes/light_changes.h"
#include "compositor/photometry/changes/light_probes.h"
#include "compositor/photometry/response/response_fit.h"
#include "scene/marker_reflectance.h"
#include "session/following/light_on_marker.h"
#include "sky/sky_model.h"

namespace pleinair::session {

/// How the light of a frame differs from the reference light: that of the recording's estimate, or
/// the LightReference of a live session.
struct FollowedLight {
  compositor::LightMix mix;               ///< Sun relative to sky; the sky's is 1.
  LinearRgb exposure{1.0, 1.0, 1.0};      ///< Factor on the exposure scale, brightness of the sky.
  LinearRgb marker_light{1.0, 1.0, 1.0};  ///< Factor on the light that the marker reflects.
  /// Standard deviation of the logarithm of the mix, and what the mix rests on.
  double log_ratio_error = 0.0;
  compositor::FrameLight::Source source = compositor::FrameLight::Source::kHeld;
};

/// Follows sun and sky through a recording: collects the brightness of surfaces in its first pass,
/// then estimates the light of each frame.
class LightFollower {
 public:
  /// `camera`: the lens of the recording's frames. `phantoms` must outlive this object.
  LightFollower(const compositor::PhantomRays& phantoms, const CameraModel& camera,
                const CameraResponse& response)
      : phantoms_(phantoms), probes_(phantoms, camera, response) {}

  /// Adds a frame; frames must come in order.
  void Add(CameraImageView image, const Transform<Camera, Marker>& pose,
           const scene::MarkerReflectance& marker, std::int64_t frame_index,
           std::int64_t timestamp_ns);

  /// Estimates the light of all frames, relative to that of the `reference` frames, whose light is
  /// `day`. Without any, these are the frames with the deepest shadows.
  void Fit(const sky::SkyModel& day, const Mat3& marker_from_world,
           const std::set<std::int64_t>& reference);

  /// Estimates the camera's response from some of the fitted frames, if they were decoded as sRGB.
  compositor::ResponseEstimate EstimateResponse(const std::set<std::int64_t>& frames) const;
  /// Decodes all frames by another response, for further fits.
  void SetResponse(const CameraResponse& response) { probes_.SetResponse(response); }

  /// True if the last fit saw sun over sky change.
  bool changes() const { return changes_.changes; }
  /// All frames of the last fit.
  const std::vector<compositor::FrameLight>& frames() const { return changes_.frames; }
  /// Frames in which the sun is nearly as strong as in any.
  std::set<std::int64_t> FramesInFullSun() const;
  /// The light of a frame by the last fit; a mix of 1 where the recording has one light or the
  /// frame was not added.
  FollowedLight Of(std::int64_t frame_index) const;

 private:
  const compositor::PhantomRays& phantoms_;
  compositor::LightProbes probes_;
  compositor::LightChanges changes_;
  std::vector<compositor::ProbeLight> lights_;  // Of the last fit.
  Vec3 to_sun_;                                 // The same, marker coordinates.
  LightOnMarker on_marker_;                     // The same.
};

}  // namespace pleinair::session
