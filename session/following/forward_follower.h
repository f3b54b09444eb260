#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/changes/light_changes.h"
#include "compositor/photometry/changes/light_probes.h"
#include "compositor/photometry/exposure_filter.h"
#include "scene/marker_reflectance.h"
#include "session/light_follower.h"
#include "sky/sky_model.h"

namespace pleinair::session {

/// The light to which the factors of a live session's frames refer.
struct LightReference {
  std::shared_ptr<const compositor::PhantomRays> phantoms;
  std::shared_ptr<const sky::SkyModel> day;
  Mat3 marker_from_world;
  /// True if its sun-to-sky ratio differs from that of the previous reference, after a new estimate
  /// or an edit.
  bool is_new_ratio = false;
  /// True if phantoms were moved since the previous reference, whose albedos no longer fit.
  bool has_moved_phantoms = false;
};

/// Probes whose light a session has to trace.
struct ProbesToLight {
  std::int64_t reference = 0;  ///< Number of the reference, for AddLights().
  LightReference light;
  std::vector<compositor::LightProbe> probes;
};

/// Follows sun and sky through a live session, frame by frame (compositor::ForwardLight).
///
/// Tracing the light of new probes is slow (about 1 ms each), so the caller does it on another
/// thread: ProbesWithoutLight() returns the probes, AddLights() takes their light. A new reference
/// comes into use when its probes have their light, and only in full sun: albedos estimated under
/// faint sun have large errors. With other phantoms it does not wait for full sun. The factors
/// continue.
///
/// Until a change is detected, all factors are 1. The first change fades in over 0.2 s.
class ForwardFollower {
 public:
  ForwardFollower(const CameraModel& camera, const CameraResponse& response)
      : camera_(camera), response_(response) {}

  /// Sets the reference of frames to come.
  void Use(LightReference reference);

  /// Estimates the light of the next frame. Frames come in order of their stamps. Cost: 1 to 2 ms
  /// for 450 probes.
  void Add(CameraImageView image, const Transform<Camera, Marker>& pose,
           const scene::MarkerReflectance& marker, std::int64_t frame_index,
           std::int64_t timestamp_ns);

  /// The next probes without light, at most 128; nothing if all have theirs.
  std::optional<ProbesToLight> ProbesWithoutLight() const;
  /// Takes the light of probes in the order of ProbesWithoutLight(). Light of a reference that was
  /// replaced meanwhile has no effect.
  void AddLights(std::int64_t reference, const std::vector<compositor::ProbeLight>& lights);

  /// How the last frame's light differs from the reference.
  FollowedLight Newest() const;

  /// True if the last frame's log sun-to-sky ratio is at most 0.1, plus its standard deviation,
  /// below its recent maximum (docs/method/photometry.md#live-changes). Only such frames may serve
  /// a new estimate.
  bool IsInFullSun() const;

  /// Number of the reference of the last frame, in the order of Use(); 0 before the first.
  std::int64_t reference() const;

 private:
  /// A reference with its probes.
  struct Stage;
  struct Deleter {
    void operator()(Stage* stage) const;
  };
  /// Logarithms of sun over sky: the largest lately, and the mean of frames in full sun.
  struct FullSun {
    double largest = 0.0, mean = 0.0;
  };

  void NoteSun(double seconds);
  void StartNext();

  CameraModel camera_;
  CameraResponse response_;
  std::unique_ptr<Stage, Deleter> current_, next_;
  std::int64_t references_ = 0;  // So far.
  compositor::FrameLight newest_;
  FullSun full_sun_;
  std::optional<std::int64_t> followed_since_ns_;  // Empty: no change was proved.
  /// Factors on the marker's light before that, filtered as the exposure scale is.
  compositor::ExposureFilter steady_;
  LinearRgb marker_light_{1.0, 1.0, 1.0};  // That of steady_ at the first change.
};

}  // namespace pleinair::session
