#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "scene/scene_description.h"
#include "tracker/observation.h"

namespace pleinair::session {

/// Family and number of a marker. File names use the form "tag36h11_0".
struct MarkerName {
  std::string family;
  int id = 0;
  auto operator<=>(const MarkerName&) const = default;
  std::string ToString() const { return family + "_" + std::to_string(id); }
};

/// Name of a detected marker; unset if its number could not be decoded.
std::optional<MarkerName> NameOfDetected(const tracker::MarkerDetection& detection);

/// True if this marker may be the reference marker of a scene with this declaration.
bool MayBeReferenceMarker(const MarkerName& marker, const scene::MarkerDescription& declared);

/// What a pose rests on.
enum class PoseSource {
  kMarker,     ///< The marker itself, and others beside it.
  kAnchors,    ///< Other markers of the scene alone (session/anchors.h).
  kMotion,     ///< The camera's motion before and after (session/path_gaps.h).
  kTrajectory  ///< A given trajectory (session/trajectory/follow_trajectory.h).
};

/// Time stamp of a frame.
struct FrameTime {
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
};

/// Observation of one marker in one frame. Its size is bounded for any image size.
struct Observation {
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
  Transform<Camera, Marker> camera_from_marker;
  double reprojection_rms_px = 0.0;
  double ambiguity_ratio = 0.0;   ///< Near 1: two planar poses fit equally well.
  double visible_fraction = 1.0;  ///< Visible share of the marker, 0…1; 0: not seen.
  tracker::DetectionPath path = tracker::DetectionPath::kFast;  ///< Detection method.
  /// Squares per side of the marker, and their visibility, 0…255; empty where unknown.
  int visibility_side = 0;
  std::vector<std::uint8_t> visibility{};
  std::array<Vec2, 4> corners_px{};  ///< Clockwise from top-left on the upright marker.
  PoseSource source = PoseSource::kMarker;
  /// Standard deviation of the marker's centre as the camera sees it, by the alignment of a given
  /// trajectory, metres; 0 for other sources.
  double centre_deviation_m = 0.0;
};

/// True if the frame shows the reference marker itself.
inline bool ShowsReferenceMarker(const Observation& seen) {
  return seen.source == PoseSource::kMarker ||
         (seen.source == PoseSource::kTrajectory && seen.visible_fraction > 0.0);
}

/// Observations of a recording's markers across its frames. They determine the reference marker and
/// the camera trajectory.
class MarkerTracks {
 public:
  explicit MarkerTracks(const scene::MarkerDescription& declared) : declared_(declared) {}

  /// Adds the observations of one frame; frames must come in order. If a marker has several
  /// observations or an ambiguous planar pose, the pose nearest to its last one counts.
  void AddFrame(std::int64_t frame_index, std::int64_t timestamp_ns,
                const std::vector<tracker::MarkerObservation>& marker_observations);

  /// Keeps only the last `observations` of each marker, for sessions without an end.
  void ForgetAllBut(std::size_t observations);

  /// The most observed marker with the family and number that the scene declares, or of all markers
  /// where it declares none. Equal counts: the first by name. Returns nothing where there is no
  /// such marker.
  std::optional<MarkerName> ReferenceMarker() const;

  /// All observations of a marker, in order of frames.
  const std::vector<Observation>& TrackOf(const MarkerName& marker) const;
  const std::map<MarkerName, std::vector<Observation>>& tracks() const { return tracks_; }

  std::int64_t frames() const { return frames_; }
  /// Times of all frames, with and without markers.
  const std::vector<FrameTime>& frame_times() const { return frame_times_; }
  /// Frames with two or more observations of one marker.
  std::int64_t frames_with_duplicates() const { return frames_with_duplicates_; }

 private:
  scene::MarkerDescription declared_;
  std::map<MarkerName, std::vector<Observation>> tracks_;
  std::int64_t frames_ = 0;
  std::vector<FrameTime> frame_times_;
  std::int64_t frames_with_duplicates_ = 0;
};

/// Angle between two rotations, radians, 0…π.
double RotationAngle(const Mat3& a, const Mat3& b);

}  // namespace pleinair::session
