#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "scene/marker_reflectance.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// A point on a real surface whose brightness is followed from frame to frame. Marker coordinates.
struct LightProbe {
  Point<Marker> point;
  Vec3 normal;
  int surface = 0;           ///< As in PhantomSurface, or of the marker.
  LinearRgb albedo;          ///< As described.
  double width_m = 0.0;      ///< Of the marker's black band; 0 elsewhere.
  double footprint_m = 0.0;  ///< Of a pixel, where the probe was first seen.
};

/// LightProbe::surface of the marker's white and of its black.
inline constexpr int kMarkerWhite = -1, kMarkerBlack = -2;

/// Brightness of the probes that one frame shows, neither covered nor clipped.
struct ProbedFrame {
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
  std::vector<std::uint32_t> probes;
  std::vector<std::array<float, 3>> linear;  ///< Display-linear, per entry of `probes`.
};

/// Follows probes through the frames of a recording: some hundred per frame on the phantoms and on
/// the marker's white. In long recordings each frame keeps a part of its probes, so that memory is
/// bounded.
class LightProbes {
 public:
  /// `phantoms` must outlive this object. `max_readings` bounds the memory, at about 80 bytes each
  /// with the fit.
  LightProbes(const PhantomRays& phantoms, const CameraModel& camera,
              const CameraResponse& response, std::size_t max_readings = 2'000'000);

  /// Adds a frame; new surfaces in view get new probes. Frames must come in order.
  void AddFrame(CameraImageView image, const Transform<Camera, Marker>& pose,
                const scene::MarkerReflectance& marker, std::int64_t frame_index,
                std::int64_t timestamp_ns);

  /// Decodes the readings, and those of frames to come, by another response.
  void SetResponse(const CameraResponse& response);

  /// Removes the last frame and returns it: for sessions without an end, which need no earlier one.
  /// Call it after each AddFrame().
  ProbedFrame TakeFrame();

  const std::vector<LightProbe>& probes() const { return probes_; }
  const std::vector<ProbedFrame>& frames() const { return frames_; }

 private:
  /// Halves the readings of all frames, and of those to come.
  void ThinOut();
  /// True if a frame keeps its reading of this probe: at random, so that all probes meet all
  /// others.
  bool Keeps(std::uint32_t probe, std::size_t frame) const;
  void AddMarker(const scene::MarkerReflectance& marker);
  /// Returns whether the probe's pixel lies in the image, and appends its brightness if it is
  /// visible and not clipped.
  bool Observe(CameraImageView image, const Transform<Camera, Marker>& pose, std::uint32_t probe,
               Vec2* pixel, ProbedFrame* frame) const;

  const PhantomRays& phantoms_;
  CameraModel camera_;
  CameraResponse response_;
  std::vector<LightProbe> probes_;
  std::vector<ProbedFrame> frames_;
  std::size_t max_readings_;
  std::size_t readings_ = 0;  // Of all frames.
  std::size_t thinning_ = 1;  // A frame keeps one of so many readings.
};

/// How a light would fall on a probe, lux, linear Rec.709.
struct ProbeLight {
  LinearRgb direct;             ///< Of the sun where nothing occludes it.
  double sun_visibility = 0.0;  ///< Share of `direct` that the phantoms transmit.
  LinearRgb reflected;          ///< Sunlight by way of other surfaces.
  LinearRgb sky;                ///< Skylight, direct and reflected.

  /// True if the phantoms let most of the sun through to it.
  bool IsSunlit() const { return direct.g > 0.0 && sun_visibility > 0.5; }
};

/// The light of `day` on each probe, by 256 paths of skylight and as many of reflected sunlight.
/// `marker_from_world` has the heading in use.
std::vector<ProbeLight> LightOn(std::span<const LightProbe> probes, const PhantomRays& phantoms,
                                const sky::SkyModel& day, const Mat3& marker_from_world);

}  // namespace pleinair::compositor
