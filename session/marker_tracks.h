#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/frames.h"
#include "scene/scene_description.h"
#include "tracker/observation.h"

namespace pleinair::session {

/// Family and number of a marker; files are named "tag36h11_0" after it.
struct MarkerName {
  std::string family;
  int id = 0;
  auto operator<=>(const MarkerName&) const = default;
  std::string ToString() const { return family + "_" + std::to_string(id); }
};

/// Whether a scene that declares this may stand on that marker.
bool MayBeReferenceMarker(const MarkerName& marker, const scene::MarkerDescription& declared);

/// What is kept of one sighting of one marker: bounded, whatever the picture's size.
struct Observation {
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
  Transform<Camera, Marker> camera_from_marker;
  double reprojection_rms_px = 0.0;
  double ambiguity_ratio = 0.0;   ///< Near 1: two planar poses fit equally well.
  double visible_fraction = 1.0;  ///< Share of the print that was seen, 0…1.
  tracker::DetectionPath path = tracker::DetectionPath::kFast;  ///< How it was found.
  /// Squares a side of the print, and which of them are seen, 0…255; empty where unknown.
  int visibility_side = 0;
  std::vector<std::uint8_t> visibility{};
};

/// What is known of a recording's markers across its frames: which one reference markers the scene
/// and where the camera stood in each frame.
class MarkerTracks {
 public:
  explicit MarkerTracks(const scene::MarkerDescription& declared) : declared_(declared) {}

  /// Adds the sightings of one frame; frames come in order. Where a marker is seen more than once,
  /// or its planar pose is ambiguous, what lies nearest to its last pose counts.
  void AddFrame(std::int64_t frame_index, std::int64_t timestamp_ns,
                const std::vector<tracker::MarkerObservation>& marker_observations);

  /// Forgets all but the last `observations` of each marker: for sessions without an end.
  void ForgetAllBut(std::size_t observations);

  /// Of the markers that have the family and the number that the scene declares, or any where it
  /// does not say, the one that is seen most (the first by name of equals); nothing where there is
  /// none.
  std::optional<MarkerName> ReferenceMarker() const;

  /// All that was seen of a marker, in order of frames.
  const std::vector<Observation>& TrackOf(const MarkerName& marker) const;
  const std::map<MarkerName, std::vector<Observation>>& tracks() const { return tracks_; }

  std::int64_t frames() const { return frames_; }
  /// Frames in which some marker was seen twice or more.
  std::int64_t frames_with_duplicates() const { return frames_with_duplicates_; }

 private:
  scene::MarkerDescription declared_;
  std::map<MarkerName, std::vector<Observation>> tracks_;
  std::int64_t frames_ = 0;
  std::int64_t frames_with_duplicates_ = 0;
};

/// Angle between two rotations, radians, 0…π.
double RotationAngle(const Mat3& a, const Mat3& b);

}  // namespace pleinair::session
