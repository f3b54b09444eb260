#include "session/lens_measurement.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "base/quantile.h"
#include "compositor/picture/side_profile.h"
#include "devices/calibration/response_file.h"
#include "session/light_frames.h"
#include "session/scene_marker.h"
#include "session/scene_renderer.h"

namespace pleinair::session {
namespace {

constexpr std::size_t kMostFrames = 120;

Result<CameraResponse> CameraResponseOf(Pipeline& pipeline, const devices::Recording& recording) {
  if (pipeline.renderer().DrawsObjects()) return pipeline.renderer().response();
  const std::string& stated = pipeline.scene().camera.response;
  if (stated == kSrgbResponse) return CameraResponse();
  if (!stated.empty()) return devices::ReadCameraResponse(stated);
  return devices::ResponseOf(recording.curve);
}

/// The poses around an observation; nothing where they are too far apart to show its motion.
std::optional<compositor::MarkerMotion> MotionAt(const std::vector<Observation>& track,
                                                 std::size_t i) {
  constexpr double kLongest_s = 0.25, kPerNanosecond = 1e-9;
  const Observation& before = track[i > 0 ? i - 1 : i];
  const Observation& after = track[i + 1 < track.size() ? i + 1 : i];
  const double seconds =
      static_cast<double>(after.timestamp_ns - before.timestamp_ns) * kPerNanosecond;
  if (!(seconds > 0.0) || seconds > kLongest_s) return std::nullopt;
  return compositor::MarkerMotion{before.camera_from_marker, after.camera_from_marker, seconds};
}

/// Median time between two frames; 0 without two.
double FrameInterval_s(const std::vector<FrameTime>& times) {
  if (times.size() < 2) return 0.0;
  std::vector<double> intervals_s(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i) {
    intervals_s[i - 1] =
        static_cast<double>(times[i].timestamp_ns - times[i - 1].timestamp_ns) * 1e-9;
  }
  return Median(std::move(intervals_s));
}

}  // namespace

bool MayTellFocus(const Pipeline& pipeline) {
  const std::optional<MarkerName> marker = pipeline.tracks().ReferenceMarker();
  if (!marker || pipeline.scene().marker.target) return false;
  double nearest_m = std::numeric_limits<double>::max(), farthest_m = 0.0;
  for (const Observation& at : pipeline.tracks().TrackOf(*marker)) {
    const double depth_m = at.camera_from_marker.translation_m.z;
    nearest_m = std::min(nearest_m, depth_m);
    farthest_m = std::max(farthest_m, depth_m);
  }
  return farthest_m >= compositor::kLeastDistanceChange * nearest_m;
}

bool MayTellExposure(const Pipeline& pipeline) {
  constexpr double kMoved_px = 2.0;  // By less, an exposure of half the interval is not seen.
  constexpr int kMinFrames = 4;
  const std::optional<MarkerName> marker = pipeline.tracks().ReferenceMarker();
  if (!marker || pipeline.scene().marker.target) return false;
  const std::vector<Observation>& track = pipeline.tracks().TrackOf(*marker);
  int moving = 0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    if (track[i].frame_index != track[i - 1].frame_index + 1) continue;
    double moved_px = 0.0;
    for (std::size_t corner = 0; corner < track[i].corners_px.size(); ++corner) {
      moved_px =
          std::max(moved_px, Norm(track[i].corners_px[corner] - track[i - 1].corners_px[corner]));
    }
    if (moved_px >= kMoved_px) ++moving;
  }
  return moving >= kMinFrames;
}

Result<MeasuredLens> MeasureLens(Pipeline& pipeline, const compositor::KnownLens& known,
                                 devices::Recording recording, const PassMonitor& monitor) {
  MeasuredLens measured;
  measured.fx = recording.camera.fx;
  const std::optional<MarkerName> marker = pipeline.tracks().ReferenceMarker();
  if (!marker) {
    measured.fit.reason = measured.exposure.reason = "no frame shows the marker";
    return measured;
  }
  if (pipeline.scene().marker.target) {
    measured.fit.reason = measured.exposure.reason =
        "an image target has no edges of known contrast";
    return measured;
  }
  PLEINAIR_ASSIGN_OR_RETURN(const CameraResponse response, CameraResponseOf(pipeline, recording));
  const std::vector<Observation>& track = pipeline.tracks().TrackOf(*marker);
  const scene::MarkerReflectance reflectance =
      MarkerReflectanceOf(pipeline.scene().marker, *marker);
  const std::vector<std::size_t> chosen = EvenlySpread(track.size(), kMostFrames);
  const auto count = static_cast<std::int64_t>(chosen.size());
  std::vector<compositor::SideProfile> profiles;
  profiles.reserve(4 * chosen.size());
  std::vector<double> exposures_s;
  exposures_s.reserve(chosen.size());
  std::int64_t done = 0;
  for (auto next = chosen.begin(); next != chosen.end();) {
    const Observation& at = track[*next];
    recording.frames->SkipTo(at.frame_index);
    if (monitor.progress) PLEINAIR_RETURN_IF_ERROR(monitor.progress(done, count));
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame, recording.frames->Next());
    if (!frame) break;
    if (frame->index != at.frame_index) continue;
    const compositor::MarkerInImage in_image(frame->rgb.view(), recording.camera,
                                             at.camera_from_marker, reflectance, response);
    for (compositor::SideProfile& side :
         compositor::ReadSideProfiles(in_image, MotionAt(track, *next))) {
      side.place.frame_index = at.frame_index;
      side.place.timestamp_s = static_cast<double>(at.timestamp_ns) * 1e-9;
      profiles.push_back(std::move(side));
    }
    if (frame->settings.exposure_s) exposures_s.push_back(*frame->settings.exposure_s);
    ++next;
    ++done;
  }
  if (monitor.progress) PLEINAIR_RETURN_IF_ERROR(monitor.progress(done, count));
  compositor::KnownLens known_of_all = known;
  if (!exposures_s.empty() && exposures_s.size() == chosen.size()) {
    known_of_all.exposure_s = Median(std::move(exposures_s));
  }
  measured.fit =
      compositor::MeasureFocus(profiles, recording.camera.fx, known_of_all, &measured.readings);
  measured.exposure = compositor::MeasureExposure(
      profiles, measured.fit.is_measured() ? measured.fit.in_focus_blur_px : 0.0,
      FrameInterval_s(pipeline.tracks().frame_times()));
  return measured;
}

}  // namespace pleinair::session
